"""What is simulated for the inference: which shapes, at which fills, with which springs, how long."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from drumrs.config import Config, baseline
from drumrs.paper.baffle.evidence import TABLE_1, Observable
from drumrs.paper.baffle.sentences import FILLS, SIZE_FILL, SIZES, WATCHED_FILLS
from drumrs.paper.cases import cost
from drumrs.paper.shape import MARKED, TRIANGLE, Shape, shapes_in_region

_BASELINE = baseline()
_SAMPLE_EVERY = 0.02
# A 28th of a turn.
_FRAME_EVERY = 0.04
# A twentieth of a collision's duration instead of Table 1's 51st: power and N/T stay what they are (docs/accuracy.md).
_TIME_STEP = _BASELINE.derived.bundle.collision_time / 20.0
# Shapes of the scan lie on a grid of a millimeter.
_MILLIMETER = 1e-3


@dataclass(frozen=True)
class Plan:
    """How many shapes and seeds, and how long.

    Attributes
    ----------
    shapes
        Shapes of the scan, which is run with softer springs and one seed.
    softer
        By how much springs are softer in the scan.
    confirmed
        Shapes that are run at full stiffness.
    seeds
        Seeds at full stiffness.
    bare_seeds
        Seeds of the bare drum.
    duration
        Simulated time of every run [s].
    window
        Interval of the averages [s, s].
    """

    shapes: int = 64
    softer: float = 100.0
    confirmed: int = 16
    seeds: tuple[int, ...] = (1, 2, 3)
    bare_seeds: tuple[int, ...] = (1, 2, 3)
    duration: float = 8.0
    window: tuple[float, float] = (4.0, 8.0)

    def scan(self) -> list[Shape]:
        """Return the shapes of the scan: spread evenly over the region, and those that have names."""
        spread = shapes_in_region(self.shapes)
        rounded = [Shape(*(round(x / _MILLIMETER) * _MILLIMETER for x in row)) for row in spread.tolist()]
        return list(dict.fromkeys([*rounded, *MARKED.values()]))

    def soft(self, shapes: Iterable[Shape]) -> "dict[Point, Config]":
        """Return the cases of shapes with softer springs, sizes of bundles included."""
        return self._cases(shapes, self.softer, self.seeds[:1])

    def stiff(self, shapes: Iterable[Shape]) -> "dict[Point, Config]":
        """Return the cases of shapes at full stiffness.

        Without those of other sizes: they tell a change of power alone, which needs no stiff springs.
        """
        return self._cases(shapes, 1.0, self.seeds)

    def bare(self) -> "dict[Point, Config]":
        """Return the cases of the bare drum, at full stiffness."""
        return self._cases([None], 1.0, self.bare_seeds)

    @property
    def cost(self) -> int:
        """Particle-steps of it all."""
        confirmed = {**self.soft([TRIANGLE]), **self.stiff([TRIANGLE])}
        first = {**self.bare(), **self.soft(self.scan())}
        return cost(first.values()) + (self.confirmed + 1) * cost(confirmed.values())

    def _cases(
        self, shapes: Iterable[Shape | None], softer: float, seeds: Sequence[int]
    ) -> "dict[Point, Config]":
        points = [
            Point(shape, softer, seed, observed)
            for shape in shapes
            for seed in seeds
            for observed in _observed(with_sizes=shape is not None and softer > 1.0)
        ]
        return {point: point.config(self) for point in points}


class Point(NamedTuple):
    """Where a case belongs: shape (`None` for the bare drum), softness of springs, seed, fill and D/d."""

    shape: Shape | None
    softer: float
    seed: int
    place: tuple[float, float]

    def config(self, plan: Plan) -> Config:
        """Return the case's configuration."""
        fill, size = self.place
        watched = fill in WATCHED_FILLS and size == TABLE_1
        run = {
            "duration": plan.duration,
            "window": plan.window,
            "sample_every": _SAMPLE_EVERY,
            "frame_every": _FRAME_EVERY if watched else plan.duration,
            "seed": self.seed,
            "record": ["gross_work"],
            # The duration of a contact goes with the root of the mass, and so with d.
            "time_step": _TIME_STEP * TABLE_1 / size,
        }
        keys = {"load.fill": fill, "load.diameter": _BASELINE.drum.diameter / size, "run": run}
        return _BASELINE.replace(keys | (self.shape.keys if self.shape else {})).softer(self.softer)

    def observable(self, quantity: str) -> Observable:
        """Return what a mean of this case tells."""
        fill, size = self.place
        return Observable(quantity, fill, size, baffles=self.shape is not None)


def _observed(*, with_sizes: bool) -> Iterator[tuple[float, float]]:
    yield from ((fill, TABLE_1) for fill in FILLS)
    if with_sizes:
        yield from ((SIZE_FILL, size) for size in SIZES)
