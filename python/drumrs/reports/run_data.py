"""`RunData`: a finished run, with measurements that several sections of a page share, each made once."""

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from drumrs import measures
from drumrs.errors import ConfigError
from drumrs.measures.frame_window import within

if TYPE_CHECKING:
    import polars as pl

    from drumrs.analysis import Mean
    from drumrs.analysis.blocks import Array
    from drumrs.config import Config
    from drumrs.frames import Frames
    from drumrs.measures import Fields, FreeSurface
    from drumrs.result import Result, Summary

# Frames that are plenty for a mean field.
_MAX_FRAMES = 100


@dataclass(frozen=True, eq=False)
class RunData:
    """A finished run, and what is measured of it in the window of its averages.

    Attributes
    ----------
    result
        The run.
    """

    result: "Result"

    @property
    def config(self) -> "Config":
        """Its configuration."""
        return self.result.config

    @property
    def summary(self) -> "Summary":
        """Its averages."""
        return self.result.summary

    @property
    def frames(self) -> "Frames":
        """Its frames."""
        return self.result.frames

    @property
    def window(self) -> tuple[float, float]:
        """Start and end of the averages [s]."""
        return self.config.run.averaging_window

    @cached_property
    def span(self) -> tuple[float, float]:
        """Start and end of the time in which motion is measured [s].

        The window; where the drum's speed changes, the longest time at one speed instead, if there is any, the last
        of several: a mean over both directions would be of neither.
        """
        if self.config.derived.angular_velocity is not None:
            return self.window
        return max(
            reversed(self._spans_of_one_speed), key=lambda each: each[1] - each[0], default=self.window
        )

    @property
    def other_way(self) -> tuple[float, float] | None:
        """Start and end [s] of the longest time in which the drum turns in reverse; `None` where it does not."""
        turned = self._turned(self.span)
        reverse = [each for each in self._spans_of_one_speed if self._turned(each) * turned < 0.0]
        return max(reversed(reverse), key=lambda each: each[1] - each[0], default=None)

    def _turned(self, span: tuple[float, float]) -> float:
        times, angles = (self.result.series[name].to_numpy() for name in ("time", "drum_angle"))
        return float(np.diff(np.interp(span, times, angles))[0])

    @cached_property
    def _spans_of_one_speed(self) -> list[tuple[float, float]]:
        """Start and end of the times at one speed [s]."""
        knots = self.config.rotation.knots
        last = (float(self.result.series["time"][-1]), knots[-1][1])
        return [
            (start, min(end, last[0]))
            for (start, speed), (end, other) in pairwise((*knots, last))
            if speed == other and speed
        ]

    @property
    def duration(self) -> float:
        """Time that was run [s], over which contacts are recorded."""
        return float(self.summary.steps * self.summary.time_step)

    @cached_property
    def turns(self) -> float:
        """Turns of the drum in that time, to and fro both counted."""
        angles = self.result.series["drum_angle"].to_numpy()
        return float(np.abs(np.diff(angles)).sum() / (2.0 * math.pi))

    @cached_property
    def masses(self) -> "Array":
        """Masses of the discs [kg/m]."""
        return measures.disc_masses(self.config, self.frames)

    @property
    def mass(self) -> float:
        """Mass of the load [kg/m]."""
        return float(self.masses.sum())

    @property
    def gravity(self) -> float:
        """Gravity in the plane [m/s²]."""
        return math.hypot(*self.config.plane_gravity)

    @cached_property
    def flights(self) -> "pl.DataFrame":
        """Flights within the span."""
        return measures.flights(self.frames, self.span, self.gravity)

    @cached_property
    def charge(self) -> "dict[str, Mean]":
        """The shape of the charge."""
        return measures.charge(self.frames, self.span, self.surface)

    @cached_property
    def surface(self) -> "FreeSurface":
        """The free surface of the load."""
        return measures.free_surface(self.frames, self.span)

    @property
    def sums_fields(self) -> bool:
        """Whether fields are sums of the run: of a drum that turns at one speed, where they were recorded."""
        return self.result.fields is not None and bool(self.config.derived.angular_velocity)

    @cached_property
    def fields(self) -> "Fields":
        """Fields of density and velocity, from sums where these are recorded, else from frames that are plenty."""
        if self.sums_fields:
            speed = self.config.derived.angular_velocity or 0.0
            return measures.recorded_fields(self.result.fields, clockwise=speed < 0.0)
        inside = within(self.frames, self.span)
        few = inside.picked(slice(None, None, max(1, len(inside) // _MAX_FRAMES)))
        return measures.fields(few, self.span, self.masses)

    def require_speed(self) -> float:
        """Return the drum's angular velocity [rad/s] without its sign, where it is one and not zero.

        Raises
        ------
        ConfigError
            Where the speed changes, or the drum rests.
        """
        speed = self.config.derived.angular_velocity
        if not speed:
            problem = "lets the drum rest or change its speed, but models of mills are of one speed"
            raise ConfigError("rotation", problem=problem)
        return abs(speed)
