"""`Inference`: what is known of the baffle once everything is run."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from drumrs.decide.emulator import Emulator
from drumrs.paper.baffle.design import Plan
from drumrs.paper.baffle.evidence import Means, Observable
from drumrs.paper.baffle.posterior import Array, Corrections, Posterior, predict
from drumrs.paper.shape import Shape
from drumrs.sweep import Failure

if TYPE_CHECKING:
    import polars as pl


@dataclass(frozen=True, eq=False)
class Inference:
    """What is known of the paper's baffle.

    Attributes
    ----------
    plan
        What was run.
    table
        Means of all runs, one row a case and quantity.
    emulators
        An emulator of every observable with softer springs.
    bare
        The bare drum at full stiffness.
    corrections
        What full stiffness changes about observables with softer springs.
    posteriors
        Posterior by factor of the tolerances.
    known
        What is predicted at the posterior's shapes.
    confirmed
        What is known at full stiffness of each shape that was run so, the likeliest first.
    failures
        Cases without results; their shapes are left out.
    """

    plan: Plan
    table: "pl.DataFrame"
    emulators: Mapping[Observable, Emulator]
    bare: Means
    corrections: Corrections
    posteriors: Mapping[float, Posterior]
    known: Means
    confirmed: Mapping[Shape, Means]
    failures: tuple[Failure, ...] = ()

    @property
    def best(self) -> Shape:
        """The confirmed shape that fits the sentences best: the inferred one."""
        return next(iter(self.confirmed))

    @property
    def scanned(self) -> list[Shape]:
        """The shapes that were run with softer springs."""
        rows = self.table.filter(self.table["softer"] > 1.0).drop_nulls("height")
        return [
            Shape(*row) for row in rows.select("height", "base", "tip").unique(maintain_order=True).rows()
        ]

    def predicted_at(self, shapes: Array) -> Means:
        """Return what the emulators predict at full stiffness, for rows of height, base and tip [m]."""
        return predict(self.emulators, shapes, self.bare, self.corrections)
