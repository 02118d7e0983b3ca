"""`PublishedDrum`: a drum that others measured or computed; what is simulated of it, and what is compared."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from drumrs.analysis import Mean
from drumrs.config import Config
from drumrs.measures.frame_window import FrameWindow
from drumrs.validation.cases import Scale
from drumrs.validation.check import Check
from drumrs.validation.results import Results

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class PublishedDrum:
    """A drum of the literature; what is said of it on the page is ``NAME.md`` beside this module.

    Attributes
    ----------
    name
        Its name for the command line.
    cases
        Return the configurations of a scale.
    measures
        Return what the frames of a case tell, by name of the registry; not asked of a case without frames.
    checks
        Compare.
    draw
        Draw the figure.
    """

    name: str
    cases: Callable[[Scale], list[Config]]
    measures: Callable[[Config, FrameWindow], Mapping[str, Mean]]
    checks: Callable[[Results], list[Check]]
    draw: "Callable[[Results], Figure]"
