"""`Result`: what a finished run leaves, in memory and in a folder."""

import io
import json
import math
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.config import Config
from drumrs.contact_records import COLUMNS, read_contact_tables
from drumrs.datasets import dataset
from drumrs.errors import ConfigError
from drumrs.files import read_object, read_plain, require_plain, write_whole
from drumrs.folders import require_format
from drumrs.frames import Frames
from drumrs.notebook import table
from drumrs.registry import known, metadata, quantity, recorded, require
from drumrs.tables import write_table

if TYPE_CHECKING:
    from collections.abc import Mapping

    import polars as pl
    import xarray

# What a run leaves instead of summary.json where it ended unstable.
UNSTABLE = "unstable.json"
_FINISHED = "the folder of a finished run"


def ended_unstable(time: float) -> str:
    """Say in a title that a run ended unstable, and when [s]."""
    return f"ended unstable at t = {time:.4g} s"


@dataclass(frozen=True)
class Summary:
    """Averages over a window of the run; powers, torques and forces are per meter of drum depth.

    A power is the change of the energy that the series holds, over the window's length, and so exact; other means are
    over the samples within the window. ``energy_residual`` is the greatest of the whole run. What is not defined is
    `None`.
    """

    bundle_count: int
    fill: float
    steps: int
    time_step: float
    window_start: float
    window_end: float
    drum_torque: float
    drum_power: float
    drum_specific_power: float
    drum_specific_power_error: float | None
    normal_power: float
    tangential_power: float
    dissipation_ratio: float | None
    work_ratio: float | None
    gross_work_ratio: float | None
    center_of_mass_x: float
    center_of_mass_y: float
    coordination: float
    max_overlap_ratio: float
    energy_residual: float
    power_disagreement: float
    energy_balance_power: float
    moment_balance_power: float
    drum_force_x: float
    drum_force_y: float
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
        return cls(**{field.name: _finite(values[field.name]) for field in fields(cls)})

    def to_json(self) -> str:
        """Return one JSON object; what is not defined is null."""
        return json.dumps(asdict(self), indent=2, allow_nan=False)

    def rows(self) -> dict[str, str]:
        """Return the main numbers as texts, by label."""
        shown = {
            "bundle_count": str(self.bundle_count),
            "window_start": f"{self.window_start:.4g}",
            "window_end": f"{self.window_end:.4g}",
            "drum_specific_power": with_error(self.drum_specific_power, self.drum_specific_power_error),
            "drum_power": number(self.drum_power),
            "drum_torque": number(self.drum_torque),
            "dissipation_ratio": number(self.dissipation_ratio),
            "work_ratio": number(self.work_ratio),
            "gross_work_ratio": number(self.gross_work_ratio),
            "center_of_mass_x": number(self.center_of_mass_x),
            "center_of_mass_y": number(self.center_of_mass_y),
            "coordination": number(self.coordination),
            "max_overlap_ratio": number(self.max_overlap_ratio),
            "energy_residual": f"{self.energy_residual:.1e}",
            "power_disagreement": f"{self.power_disagreement:.1e}",
            "wall_time": f"{self.wall_time:.1f}",
            "particle_steps_per_second": number(self.particle_steps_per_second),
        }
        return {quantity(name).label: text for name, text in shown.items()}

    def _repr_html_(self) -> str:
        """Show the main numbers in a notebook."""
        return table(f"averages over t = {self.window_start:.6g} to {self.window_end:.6g} s", self.rows())


# Each number says what it is, as the registry has it.
Summary.__doc__ = "\n".join(
    [
        *((Summary.__doc__ or "").rstrip(), "", "    Attributes", "    ----------"),
        *(f"    {one.name}\n        {one.text}." for one in map(quantity, Summary.__annotations__)),
    ]
)


def number(value: float | None) -> str:
    """Show a value to four digits, a dash where there is none."""
    return "–" if value is None else f"{value:.4g}"


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
        Polars table, one row a sample; `drumrs.quantities` has the meanings and units of its columns.
    frames
        Positions, angles, velocities and numbers of contacts of the bundles at the frames' times.
    contacts
        Every contact from first touch to opening, one row each; where `run.record` has "contacts", `None` elsewhere.
    wall_profile
        What contacts did along the outline of the drum, one row a bin; where it has "wall_profile".
    ledger_split
        What contacts took, one row a pair of species, or species and part of the drum; where it has "ledger_split".
    discs
        What each bundle received, and its flights, one row each; where it has "discs".
    fields
        Means of density, momentum and stress, one row a cell, over the averages' window; where it has "fields".
    zone_visits
        How the bundles visited the zones of ``run.zone``, one row a zone and bundle, likewise.
    dissipated
        What contacts took from t = 0 to the end of the run [J/m], by column of the series: what each of these tables
        adds up to. The last row of the series is up to one `run.sample_every` older.

    Notes
    -----
    The first four are polars tables over the whole run from t = 0; docs/reference/records.md has the columns of all.
    """

    config: Config
    summary: Summary
    series: "pl.DataFrame"
    frames: Frames
    contacts: "pl.DataFrame | None" = None
    wall_profile: "pl.DataFrame | None" = None
    ledger_split: "pl.DataFrame | None" = None
    discs: "pl.DataFrame | None" = None
    fields: "pl.DataFrame | None" = None
    zone_visits: "pl.DataFrame | None" = None
    dissipated: "dict[str, float] | None" = None

    def __repr__(self) -> str:
        """Say what was run, and its main number."""
        summary = self.summary
        window = f"t = {summary.window_start:.6g} to {summary.window_end:.6g} s"
        return f"<Result of {summary.bundle_count} bundles: {summary.drum_specific_power:.4g} W/kg over {window}>"

    def contact_tables(self) -> dict[str, Any]:
        """Return what was recorded of contacts by name, and with it "dissipated"."""
        told = {name: getattr(self, name) for name in (*COLUMNS, "dissipated")}
        return {name: value for name, value in told.items() if value is not None}

    def to_xarray(self) -> "xarray.Dataset":
        """Return frames and series as labelled arrays with units; needs xarray, of the extra `export`.

        The series lies over `sample`. Its columns that frames have too begin with ``sample_``.

        Raises
        ------
        ConfigError
            Where xarray is not installed.

        Examples
        --------
        >>> import drumrs
        >>> config = drumrs.baseline(fill=0.1).replace({"run.duration": 0.1})
        >>> run = drumrs.run(config, progress=False).to_xarray()
        >>> run.drum_power.dims, run.drum_power.units, run.attrs["title"]
        (('sample',), 'W/m', '40 bundles (10 % fill), no baffles, 54 rpm, seed 1')
        """
        return to_xarray(self.config, self.frames, self.series)

    def _repr_html_(self) -> str:
        """Show the summary in a notebook."""
        return table(self.config.title, self.summary.rows())


def to_xarray(config: Config, frames: Frames, series: "pl.DataFrame") -> "xarray.Dataset":
    """Return a run's frames and series as labelled arrays, as `Result.to_xarray` tells."""
    made = frames.to_xarray(
        {"title": config.title, "digest": config.digest, "configuration": config.to_toml()}
    )
    shared = {name: f"sample_{name}" for name in series.columns if name in made.variables}
    columns = dataset({name: (("sample",), series[name].to_numpy()) for name in series.columns}, {})
    return made.merge(columns.rename(shared).set_coords("sample_time"))


def write_tables(folder: Path, config: Config, series: "pl.DataFrame") -> list[Path]:
    """Write config.toml and series.parquet; return their paths."""
    write_whole(folder / "config.toml", config.to_toml().encode())
    write_table(folder / "series.parquet", series, metadata(known(series.columns)))
    return [folder / name for name in ("config.toml", "series.parquet")]


def read_series(path: Path) -> "pl.DataFrame":
    """Read a series.parquet.

    Raises
    ------
    ConfigError
        Where another version of drumrs wrote it, whose columns have other names.
    """
    import polars as pl

    series = pl.read_parquet(io.BytesIO(read_plain(path)))
    require(path, series.columns, (column.name for column in recorded(["rim"])))
    return series


def load(folder: str | Path) -> Result:
    """Read what `save` wrote.

    Raises
    ------
    ConfigError
        Where the folder does not hold a finished run of this version.
    """
    import polars as pl

    folder = Path(folder)
    require_format(folder, "run")
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
        require_plain(folder / "frames.parquet")
        summary = read_object(folder / "summary.json") or {}
        require(folder / "summary.json", summary, Summary.__annotations__)
        return Result(
            config=Config.read(folder / "config.toml"),
            summary=Summary.from_mapping(summary),
            series=read_series(folder / "series.parquet"),
            frames=Frames.load(folder / "frames.parquet"),
            **read_contact_tables(folder),
        )
    except ConfigError:
        raise
    # Whatever a damaged table makes of itself; polars may even panic, which is no `Exception`.
    except (Exception, pl.exceptions.PanicException) as error:  # noqa: BLE001
        raise ConfigError(folder, problem=f"is damaged, but must be {_FINISHED}: {error!r:.200}") from None
