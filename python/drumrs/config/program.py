"""The phases of a program one after the other: groups unrolled, repeats counted, turned into knots."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Protocol

# The most phases that a program may unroll to: three hours of a washer that reverses every tenth of a second.
MOST_PHASES = 100_000


class Phase(Protocol):
    """What is read of a phase or group, as the table of keys has it."""

    @property
    def name(self) -> str | None:
        """Its name."""

    @property
    def duration(self) -> float | None:
        """Its duration [s]; none of a group."""

    @property
    def rpm(self) -> float | None:
        """Its speed [rpm]."""

    @property
    def ramp(self) -> tuple[float, float] | None:
        """Its speeds at both ends [rpm], instead of one."""

    @property
    def phase(self) -> "Sequence[Phase] | None":
        """The phases of a group."""

    @property
    def repeat(self) -> int:
        """How often a group is gone through."""

    @property
    def reversing(self) -> bool:
        """Whether every second time it turns the other way round."""


@dataclass(frozen=True)
class Interval:
    """A phase as the drum goes through it.

    Attributes
    ----------
    name
        Name of the phase.
    start, end
        Times [s].
    speeds
        Speeds at both ends, between which it changes evenly [rpm].
    """

    name: str
    start: float
    end: float
    speeds: tuple[float, float]


def count_phases(phases: Sequence[Phase]) -> int:
    """Return the number of phases that a program unrolls to."""
    return sum(phase.repeat * count_phases(phase.phase) if phase.phase else 1 for phase in phases)


def unrolled(phases: Sequence[Phase]) -> list[Interval]:
    """Return the phases of a program in the order of time."""
    intervals: list[Interval] = []
    time = 0.0
    for name, duration, speeds in _in_order(phases, 1.0):
        intervals.append(Interval(name, time, time + duration, speeds))
        time += duration
    return intervals


def knots_of(intervals: Sequence[Interval]) -> tuple[tuple[float, float], ...]:
    """Return knots [s, rpm] of the same program; two of one time are a jump of the speed."""
    ends = (((each.start, each.speeds[0]), (each.end, each.speeds[1])) for each in intervals)
    # Where a phase goes on at the speed of the one before, their common knot counts once.
    return tuple(dict.fromkeys(chain.from_iterable(ends)))


def _in_order(
    phases: Sequence[Phase], sign: float, at: str = ""
) -> Iterator[tuple[str, float, tuple[float, float]]]:
    for number, phase in enumerate(phases, 1):
        name = phase.name or f"{at}{number}"
        if phase.phase:
            for turn in range(phase.repeat):
                way = -sign if phase.reversing and turn % 2 else sign
                yield from _in_order(phase.phase, way, f"{name}.")
        else:
            first, last = phase.ramp or (phase.rpm or 0.0, phase.rpm or 0.0)
            # Adding 0 makes a standstill 0, not −0, whichever way the drum goes.
            yield name, phase.duration or 0.0, (sign * first + 0.0, sign * last + 0.0)
