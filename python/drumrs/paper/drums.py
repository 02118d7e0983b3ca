"""The drums of the study: bare, with its baffles, and with the triangles that were first assumed."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

from drumrs.config import Config, baseline
from drumrs.paper.shape import TRIANGLE, Shape

if TYPE_CHECKING:
    import polars as pl

_BAFFLES = "drum.baffles"


@dataclass(frozen=True)
class Drum:
    """A drum by its name, and what makes it of the bare one.

    Attributes
    ----------
    name
        As figures and sentences have it, such as ``"with baffles"``.
    changes
        Keys of a configuration and their values, laid over the baseline.
    """

    name: str
    changes: Mapping[str, str | float] = field(default_factory=lambda: MappingProxyType({}), hash=False)

    def config(self, fill: float = 0.25) -> Config:
        """Return Table 1 with this drum."""
        return baseline(fill).replace(self.changes)

    @cached_property
    def rows(self) -> "pl.Expr":
        """The condition by which rows of a table are of this drum."""
        import polars as pl

        baffles = self.config().drum.baffles
        if not baffles.count:
            return pl.col(f"{_BAFFLES}.count") == 0
        shaped = ("count", "shape", "height", "base", *(("tip",) if baffles.shape == "trapezoid" else ()))
        return pl.all_horizontal(pl.col(f"{_BAFFLES}.{key}") == getattr(baffles, key) for key in shaped)

    @property
    def baffles_share(self) -> float:
        """Part of the drum's area that its three baffles take."""
        baffles = self.config().drum.baffles
        return Shape(
            baffles.height, baffles.base, baffles.tip if baffles.shape == "trapezoid" else 0.0
        ).share_of_drum


BARE = Drum("without baffles")
# The configuration's defaults, inferred from the paper's text: docs/study/baffle.md.
BAFFLED = Drum("with baffles", MappingProxyType({f"{_BAFFLES}.count": 3}))
TRIANGLES = Drum("with triangles", MappingProxyType(TRIANGLE.keys))
