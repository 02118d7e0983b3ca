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


def with_speed(
    knots: Sequence[tuple[float, float]], rpm: float, earliest: float, ramp: float
) -> tuple[tuple[float, float], ...]:
    """Return the knots of a program that changes to another speed and stays there.

    What comes before the change is not touched, to the bit: a change that is asked for within a ramp begins at its end.

    Parameters
    ----------
    knots
        The program so far [s, rpm].
    rpm
        The new speed [rpm].
    earliest
        Time at which the change may begin [s].
    ramp
        How long it takes [s].

    Examples
    --------
    >>> from drumrs.config.program import with_speed
    >>> with_speed([(0.0, 54.0)], 60.0, earliest=2.0, ramp=0.1)
    ((0.0, 54.0), (2.0, 54.0), (2.1, 60.0))
    >>> with_speed([(0.0, 0.0), (5.0, 54.0), (9.0, 0.0)], 60.0, earliest=2.0, ramp=0.1)
    ((0.0, 0.0), (5.0, 54.0), (5.1, 60.0))
    """
    before = [knot for knot in knots if knot[0] <= earliest]
    after = [knot for knot in knots if knot[0] > earliest]
    if before and after and before[-1][1] != after[0][1]:
        # Within a ramp: a shorter one to the speed of that moment would have other last digits.
        before.append(after[0])
    elif not before or before[-1][0] < earliest:
        before.append((earliest, (before or after)[-1 if before else 0][1]))
    begin = before[-1][0]
    return (*before, (begin + ramp, rpm))


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
