"""The paper by number: the cases of its figures, the figures, and a verdict on each of its claims.

>>> from drumrs import paper
>>> len(paper.cases("default")) > 300
True

`Reproduction` runs it all. Nothing else here runs a simulation: `cases` says what to run, and everything else reads
tables and frames.
"""

from drumrs.paper.baffle import infer_baffle
from drumrs.paper.cases import cases, cost
from drumrs.paper.claims import CLAIMS, Claim, judge
from drumrs.paper.data import StudyData
from drumrs.paper.figures import FIGURES, PaperFigure
from drumrs.paper.measure import measure
from drumrs.paper.reproduction import Reproduction, ReproductionResult
from drumrs.paper.scales import SCALES, Scale
from drumrs.paper.verdict import MissingError, Number, Verdict

__all__ = [
    "CLAIMS",
    "FIGURES",
    "SCALES",
    "Claim",
    "MissingError",
    "Number",
    "PaperFigure",
    "Reproduction",
    "ReproductionResult",
    "Scale",
    "StudyData",
    "Verdict",
    "cases",
    "cost",
    "infer_baffle",
    "judge",
    "measure",
]
