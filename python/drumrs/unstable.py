"""`UnstableRun`: what a run leaves that ended unstable; `output` writes its folder."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.config import Config
from drumrs.errors import ConfigError, UnstableError
from drumrs.files import read_object
from drumrs.frames import Frames
from drumrs.result import UNSTABLE, Summary
from drumrs.simulation import Simulation

if TYPE_CHECKING:
    import polars as pl

# A time step that is a collision's duration over at least this resolves it.
_RESOLVED = 49.0


@dataclass(frozen=True, eq=False)
class UnstableRun:
    """A run that ended unstable, up to its end.

    Attributes
    ----------
    config
        The configuration, seed included.
    error
        The message of the error.
    step, time
        When it ended [1, s].
    summary
        Averages over the part of the window that was simulated; `None` where there is none.
    series
        What was recorded.
    frames
        Frames to be shown; the last is the end.
    """

    config: Config
    error: str
    step: int
    time: float
    summary: Summary | None
    series: "pl.DataFrame"
    frames: Frames

    @classmethod
    def of(
        cls, simulation: Simulation, error: UnstableError, series: "pl.DataFrame", frames: Frames
    ) -> "UnstableRun":
        """Take what a simulation has recorded until it raised `error`; of the frames, those to be shown."""
        return cls(
            config=simulation.config,
            error=str(error),
            step=simulation.step,
            time=simulation.time,
            summary=_summary(simulation),
            series=series,
            frames=frames,
        )


def _summary(simulation: Simulation) -> Summary | None:
    start, end = simulation.config.run.averaging_window
    end = min(end, simulation.time)
    try:
        return simulation.summary((start, end)) if start < end else None
    except ConfigError:
        # Too few samples for a mean.
        return None


def refuse_to_repeat(folder: Path, simulation: Simulation) -> None:
    """Say how a run ended that is to be resumed, and what to do instead, where it ended unstable.

    Raises
    ------
    ConfigError
        Where it did.
    """
    ended = read_object(folder / UNSTABLE)
    if ended is None:
        return
    settings = "--set run.time_step=auto"
    if simulation.time_step <= min(simulation.collision_time.values()) / _RESOLVED:
        # The steps are as short as "auto": it is the springs that are too soft.
        contact = simulation.config.contact
        for side, law in (("bundle", contact.bundle), ("drum", contact.drum)):
            settings += f" --set contact.{side}.normal_stiffness={10.0 * law.normal_stiffness:.3g}"
    raise ConfigError(
        folder,
        problem=f"holds a run that ended unstable, and going on would repeat that: {ended.get('error')}",
        hint=f"look at its end with: drumrs view {folder}; start it anew, changed, with, for instance: "
        f"drumrs run {folder / 'config.toml'} {settings} --out OTHER",
    )
