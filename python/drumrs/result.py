"""`Result`: what a finished run leaves, in memory and in a folder."""

import io
import json
import math
from dataclasses import asdict, dataclass, fields
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.config import Config
from drumrs.errors import ConfigError
from drumrs.files import read_object, read_plain, require_plain, write_whole
from drumrs.frames import Frames
from drumrs.tables import write_table

if TYPE_CHECKING:
    from collections.abc import Mapping

    import polars as pl

# What a run leaves instead of summary.json where it ended unstable.
UNSTABLE = "unstable.json"
_FINISHED = "the folder of a finished run"


def ended_unstable(time: float) -> str:
    """Say in a title that a run ended unstable, and when [s]."""
    return f"ended unstable at t = {time:.4g} s"


@dataclass(frozen=True)
class Summary:
    """Averages over a window of the run; powers, torques and forces are per meter of drum depth.

    Attributes
    ----------
    bundle_count
        Number of bundles N.
    fill
        Fill N d²/D².
    steps
        Steps since t = 0.
    time_step
        Time step [s].
    window_start, window_end
        The window [s].
    drum_torque
        Mean torque of the drum on the load about its axis [N m/m].
    drum_power
        Power of the drum [W/m], positive where it does work on the load.
    specific_power
        Drum power over the load's mass [W/kg].
    specific_power_error
        Standard error of `specific_power` [W/kg], from block averages; `None` where the window is too short.
    normal_power, tangential_power
        Work into normal and tangential contacts, springs and dissipation together, per time [W/m].
    normal_tangential_ratio
        `normal_power` over `tangential_power`; `None` where that is 0.
    center_of_mass
        Center of mass of the load [m, m].
    coordination
        Contacts per bundle.
    max_overlap_ratio
        Greatest overlap over the smaller radius.
    energy_residual
        What the energy ledger fails to account for, relative, over the whole run.
    power_disagreement
        Largest difference of the three powers over the largest of them, or over the stored energy by the window's
        length where that is more.
    power_torque, power_ledger, power_balance
        The three powers [W/m]: torque times speed; energy stored and dissipated; gravity and angular momentum.
    force_x, force_y
        Force of the load on the drum [N/m].
    kinetic_energy
        Kinetic energy of the load [J/m].
    dissipated_normal_power, dissipated_sliding_power, dissipated_tangential_power, dissipated_rolling_power
        Dissipation by normal damping, by sliding, by tangential damping and by rolling [W/m].
    numerical_power
        Power that the finite time step takes [W/m].
    correlation_time
        Integral correlation time of the drum's power [s].
    wall_time
        Time of the wall clock spent stepping in this process [s].
    particle_steps_per_second
        Bundles times steps per second of `wall_time` [1/s].
    """

    bundle_count: int
    fill: float
    steps: int
    time_step: float
    window_start: float
    window_end: float
    drum_torque: float
    drum_power: float
    specific_power: float
    specific_power_error: float | None
    normal_power: float
    tangential_power: float
    normal_tangential_ratio: float | None
    center_of_mass: tuple[float, float]
    coordination: float
    max_overlap_ratio: float
    energy_residual: float
    power_disagreement: float
    power_torque: float
    power_ledger: float
    power_balance: float
    force_x: float
    force_y: float
    kinetic_energy: float
    dissipated_normal_power: float
    dissipated_sliding_power: float
    dissipated_tangential_power: float
    dissipated_rolling_power: float
    numerical_power: float
    correlation_time: float | None
    wall_time: float
    particle_steps_per_second: float | None

    @classmethod
    def from_mapping(cls, values: "Mapping[str, Any]") -> "Summary":
        """Build a summary from the core's mapping or from JSON; further keys are left out, NaN becomes `None`."""
        values = dict(values)
        if "center_of_mass" not in values:
            values["center_of_mass"] = (values["center_of_mass_x"], values["center_of_mass_y"])
        known = {field.name: _finite(values[field.name]) for field in fields(cls)}
        return cls(**{**known, "center_of_mass": tuple(known["center_of_mass"])})

    def to_json(self) -> str:
        """Return one JSON object; what is not defined is null."""
        return json.dumps(asdict(self), indent=2, allow_nan=False)

    def rows(self) -> dict[str, str]:
        """Return the main numbers as texts, by name with unit."""
        window = f"{self.window_start:.4g}–{self.window_end:.4g}"
        x, y = (f"{1e3 * value:.1f}" for value in self.center_of_mass)
        return {
            "bundles": str(self.bundle_count),
            "averages over t = [s]": window,
            "specific power [W/kg]": with_error(self.specific_power, self.specific_power_error),
            "drum power [W/m]": number(self.drum_power),
            "torque [N m/m]": number(self.drum_torque),
            "normal / tangential power": number(self.normal_tangential_ratio),
            "center of mass [mm]": f"({x}, {y})",
            "contacts per bundle": number(self.coordination),
            "greatest overlap / radius": number(self.max_overlap_ratio),
            "energy residual": f"{self.energy_residual:.1e}",
            "disagreement of three powers": f"{self.power_disagreement:.1e}",
            "wall time [s]": f"{self.wall_time:.1f}",
            "million particle-steps per second": number(self.particle_steps_per_second, 1e-6),
        }


def number(value: float | None, scale: float = 1.0) -> str:
    """Show a value to four digits, a dash where there is none."""
    return "–" if value is None else f"{scale * value:.4g}"


def with_error(value: float, error: float | None) -> str:
    """Show a value with its standard error, both to the error's second digit."""
    if not error:
        return number(value)
    digits = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


@dataclass(frozen=True, eq=False, repr=False)
class Result:
    """A finished run.

    Attributes
    ----------
    config
        The configuration, seed included.
    summary
        Averages over the window.
    series
        Polars table, one row a sample; `units` has the columns' units.
    frames
        Positions, angles and speeds of the bundles at the frames' times.
    units
        Unit of each column of `series`.
    """

    config: Config
    summary: Summary
    series: "pl.DataFrame"
    frames: Frames
    units: "Mapping[str, str]"

    def __repr__(self) -> str:
        """Say what was run, and its main number."""
        summary = self.summary
        window = f"t = {summary.window_start:.6g} to {summary.window_end:.6g} s"
        return f"<Result of {summary.bundle_count} bundles: {summary.specific_power:.4g} W/kg over {window}>"

    def _repr_html_(self) -> str:
        """Show the summary as a table in a notebook."""
        rows = (
            f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>"
            for name, value in self.summary.rows().items()
        )
        return f"<table>{''.join(rows)}</table>"


def write_tables(
    folder: Path, config: Config, series: "pl.DataFrame", units: "Mapping[str, str]"
) -> list[Path]:
    """Write config.toml and series.parquet; return their paths."""
    write_whole(folder / "config.toml", config.to_toml().encode())
    write_table(folder / "series.parquet", series, {"units": json.dumps(dict(units))})
    return [folder / name for name in ("config.toml", "series.parquet")]


def load(folder: str | Path) -> Result:
    """Read what `save` wrote.

    Raises
    ------
    ConfigError
        Where the folder does not hold a finished run.
    """
    import polars as pl

    folder = Path(folder)
    if not (folder / "summary.json").is_file():
        ended = read_object(folder / UNSTABLE)
        if ended is not None:
            raise ConfigError(
                folder,
                problem=f"holds a run that ended unstable, but must be {_FINISHED}: {ended.get('error')}",
                hint="its series.parquet, frames.parquet and player.html show it to the end",
            )
        raise ConfigError(folder, problem=f"holds no summary.json, but must be {_FINISHED}")
    try:
        series = io.BytesIO(read_plain(folder / "series.parquet"))
        require_plain(folder / "frames.parquet")
        return Result(
            config=Config.read(folder / "config.toml"),
            summary=Summary.from_mapping(read_object(folder / "summary.json") or {}),
            series=pl.read_parquet(series),
            frames=Frames.load(folder / "frames.parquet"),
            units=json.loads(pl.read_parquet_metadata(series)["units"]),
        )
    except ConfigError:
        raise
    # Whatever a damaged table makes of itself; polars may even panic, which is no `Exception`.
    except (Exception, pl.exceptions.PanicException) as error:  # noqa: BLE001
        raise ConfigError(folder, problem=f"is damaged, but must be {_FINISHED}: {error!r:.200}") from None
