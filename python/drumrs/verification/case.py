"""`Case`: one row of the verification, and `Trial`, what came of it."""

import inspect
import time
from collections.abc import Callable
from dataclasses import dataclass

from drumrs import DrumrsError
from drumrs.verification.evidence import Evidence


@dataclass(frozen=True)
class Case:
    """A law, an identity or a promise that the simulation must keep.

    Attributes
    ----------
    name
        Short name, for the command line.
    title
        What it is about, in a line.
    source
        Where the expected values come from.
    formula
        What is expected, in symbols.
    tolerance
        Why measured and expected values may differ, and by how much.
    cost
        About how many particle-steps it takes.
    examine
        Runs it.
    """

    name: str
    title: str
    source: str
    formula: str
    tolerance: str
    cost: float
    examine: Callable[[], Evidence]

    def run(self) -> "Trial":
        """Run the case; what cannot be simulated is a failure of it."""
        began = time.perf_counter()
        try:
            evidence, error = self.examine(), None
        except DrumrsError as refusal:
            evidence, error = None, str(refusal)
        return Trial(self, evidence, time.perf_counter() - began, error)


@dataclass(frozen=True)
class Trial:
    """A case that was run.

    Attributes
    ----------
    case
        The case.
    evidence
        What it found, `None` where the simulation gave up.
    wall_time
        Time it took [s].
    error
        Why the simulation gave up.
    """

    case: Case
    evidence: Evidence | None
    wall_time: float
    error: str | None = None

    @property
    def passed(self) -> bool:
        """Whether the case ran and all its checks passed."""
        return self.evidence is not None and self.evidence.passed


def case(
    name: str, *, source: str, formula: str, cost: float = 3e6
) -> Callable[[Callable[[], Evidence]], Case]:
    """Make a case of a function: its docstring's first line is the title, the rest says where the tolerance is from.

    Parameters
    ----------
    name, source, formula, cost
        As in `Case`.
    """

    def make(examine: Callable[[], Evidence]) -> Case:
        title, _, rest = (inspect.getdoc(examine) or name).partition("\n")
        return Case(name, title.rstrip("."), source, formula, " ".join(rest.split()), cost, examine)

    return make
