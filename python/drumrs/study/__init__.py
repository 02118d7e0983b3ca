"""The paper by number: the cases of its figures, the figures, and a verdict on each of its claims.

>>> from drumrs import study
>>> len(study.cases("default")) > 300
True

Nothing here runs a simulation: `cases` says what to run, and everything else reads tables and frames.
"""

from drumrs.study.cases import cases, cost
from drumrs.study.claims import CLAIMS, Claim, judge
from drumrs.study.figures import FIGURES, Material, StudyFigure
from drumrs.study.measure import measure
from drumrs.study.scales import SCALES, Scale
from drumrs.study.verdict import MissingError, Number, Verdict

__all__ = [
    "CLAIMS",
    "FIGURES",
    "SCALES",
    "Claim",
    "Material",
    "MissingError",
    "Number",
    "Scale",
    "StudyFigure",
    "Verdict",
    "cases",
    "cost",
    "judge",
    "measure",
]
