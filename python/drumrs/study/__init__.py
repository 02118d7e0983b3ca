"""The paper by number: the cases of its figures, the figures, and a verdict on each of its claims.

>>> from drumrs import study
>>> len(study.cases("default")) > 300
True

Nothing here runs a simulation: `cases` says what to run, and everything else reads tables and frames.
"""

from drumrs.study.cases import cases, cost
from drumrs.study.scales import SCALES, Scale

__all__ = ["SCALES", "Scale", "cases", "cost"]
