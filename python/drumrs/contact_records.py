"""Tables of what is recorded on request: their columns, with units and meanings, and how they are made.

`run.record` names them, and `run.zone` the zones of "zone_visits". Those of contacts cover the whole run from t = 0,
contacts that are still open included, and split the same energies: those that contacts took, `Result.dissipated`, of
which the series' columns of these names are samples. Fields and visits are those of the averages' window.
"""

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drumrs.files import read_plain
from drumrs.registry import Quantity, metadata
from drumrs.tables import write_table

if TYPE_CHECKING:
    import polars as pl

    from drumrs.config.tables import Run

# The energies that contacts take, as the core adds them up.
FLOWS = ("dissipated_normal", "dissipated_sliding", "dissipated_tangential", "dissipated_rolling")
# What stands in the core's arrays for a body or a part that is not there.
_NONE = np.iinfo(np.uint32).max


def _columns(*rows: tuple[str, str, str]) -> tuple[Quantity, ...]:
    return tuple(Quantity(name, "", unit, "run", "", meaning) for name, unit, meaning in rows)


_NORMAL = ("dissipated_normal", "J/m", "energy taken by normal damping")
_ROLLING = ("dissipated_rolling", "J/m", "energy taken by rolling")
_ALL_TANGENTIAL = ("dissipated_tangential", "J/m", "energy taken by sliding and by tangential damping")
_SPLIT_TANGENTIAL = (
    ("dissipated_sliding", "J/m", "energy taken by sliding"),
    ("dissipated_tangential", "J/m", "energy taken by tangential damping"),
)

CONTACTS = _columns(
    ("opened", "s", "time of the first step at whose end the bodies touched; 0 where they did at the start"),
    (
        "duration",
        "s",
        "time until the first step at whose end they no longer touched, or until the end of the run",
    ),
    (
        "particle",
        "1",
        "number of the bundle, of two the smaller one; none in the last row, of contacts below the floor",
    ),
    ("other", "1", "number of the other bundle; none at the drum"),
    ("part", "1", "part of the drum; none between bundles"),
    _NORMAL,
    _ALL_TANGENTIAL,
    _ROLLING,
    (
        "normal_speed",
        "m/s",
        "speed of approach along the normal at first touch; none where a state brought the contact",
    ),
    ("tangential_speed", "m/s", "speed of slip at first touch, spins included; likewise"),
    ("greatest_force", "N/m", "greatest normal force"),
    ("x", "m", "horizontal place of first touch from the axis; none where a state brought the contact"),
    ("y", "m", "vertical place of first touch from the axis; likewise"),
    ("drum_angle", "rad", "angle by which the drum had turned at first touch"),
    ("is_open", "1", "whether the contact was still open at the end of the run"),
    ("count", "1", "number of contacts in the row: 1, but for the last row where run.contact_floor is set"),
)
WALL_PROFILE = _columns(
    ("part", "1", "part of the drum"),
    ("arc_start", "m", "where the bin begins, along the part's outline"),
    ("arc_end", "m", "where it ends"),
    ("x", "m", "middle of the bin in the drum's frame"),
    ("y", "m", "middle of the bin in the drum's frame"),
    (
        "normal_x",
        "1",
        "normal there into the drum, in the drum's frame; of a wall to the right as it is drawn",
    ),
    ("normal_y", "1", "normal there into the drum, in the drum's frame; likewise"),
    _NORMAL,
    _ALL_TANGENTIAL,
    _ROLLING,
    ("normal_impulse", "N s/m", "∫ Fₙ dt"),
    ("normal_force_slip", "J/m", "∫ Fₙ ds over the sliding distance, as Archard's law of wear has it"),
    ("finnie", "J/m", "∫ 2 |v| |F| f(γ) dt while bundles approach, as Finnie's law of wear has it"),
)
LEDGER_SPLIT = _columns(
    ("body", "1", "species of a bundle; 'bundle' where the load has no species"),
    ("other", "1", "species of the other bundle, or part of the drum"),
    _NORMAL,
    *_SPLIT_TANGENTIAL,
    _ROLLING,
)
DISCS = _columns(
    ("id", "1", "number of the bundle"),
    ("species", "1", "its species; 'bundle' where the load has no species"),
    ("radius", "m", "radius"),
    ("mass", "kg/m", "mass per meter of depth"),
    (
        "received_normal",
        "J/m",
        "energy taken by normal damping at its contacts, half of it at those with bundles",
    ),
    ("received_tangential", "J/m", "energy taken by sliding and tangential damping, likewise"),
    ("received_rolling", "J/m", "energy taken by rolling, likewise"),
    ("flights", "1", "spells without contact that have begun, one from the start on included"),
    ("flight_time", "s", "time without contact"),
    (
        "falls",
        "1",
        "flights longer than half the time in which a body falls by a diameter, and deeper than a diameter",
    ),
    ("drum_landings", "1", "flights that ended at the drum"),
    ("load_landings", "1", "flights that ended at another bundle"),
)
FIELDS = _columns(
    ("x", "m", "middle of the cell, in the laboratory's frame"),
    ("y", "m", "middle of the cell"),
    ("density", "kg/m³", "mass of the discs whose centers are in the cell over its area, on average"),
    ("solid_fraction", "1", "area of these discs over that of the cell, on average"),
    ("momentum_x", "kg/(m² s)", "their momentum over the area, on average"),
    ("momentum_y", "kg/(m² s)", "likewise"),
    ("momentum_flux_xx", "Pa", "Σ m vₓ vₓ over the area, on average"),
    ("momentum_flux_xy", "Pa", "Σ m vₓ v_y over the area, on average"),
    ("momentum_flux_yy", "Pa", "Σ m v_y v_y over the area, on average"),
    (
        "contact_stress_xx",
        "Pa",
        "Σ Fₓ lₓ over the area: force on the other body, part of the branch in the cell",
    ),
    ("contact_stress_xy", "Pa", "Σ Fₓ l_y over the area"),
    ("contact_stress_yx", "Pa", "Σ F_y lₓ over the area"),
    ("contact_stress_yy", "Pa", "Σ F_y l_y over the area; pressure is positive"),
)
ZONE_VISITS = _columns(
    ("zone", "1", "name of the zone"),
    ("id", "1", "number of the bundle"),
    ("species", "1", "its species; 'bundle' where the load has no species"),
    ("entries", "1", "visits that have begun in sight"),
    ("time_inside", "s", "time in the zone"),
    ("cycles", "1", "whole visits that another one followed"),
    ("stay", "s", "Σ W over cycles, the time W of a visit"),
    ("cycle", "s", "Σ C over cycles, the time C from the beginning of a visit to that of the next"),
    ("stay_squared", "s²", "Σ W² over cycles"),
    ("cycle_squared", "s²", "Σ C² over cycles"),
    ("stay_cycle", "s²", "Σ W C over cycles"),
)
# The tables by the name under which they are asked for, and under which their file goes.
COLUMNS = {
    "contacts": CONTACTS,
    "wall_profile": WALL_PROFILE,
    "ledger_split": LEDGER_SPLIT,
    "discs": DISCS,
    "fields": FIELDS,
    "zone_visits": ZONE_VISITS,
}


def recorded_tables(run: "Run") -> tuple[str, ...]:
    """Return the names of the tables that a configuration asks for."""
    asked = (*run.record, *(["zone_visits"] if run.zone else []))
    return tuple(kind for kind in COLUMNS if kind in asked)


def file_words(kind: str, dissipated: dict[str, float]) -> dict[str, str]:
    """Return what the file of a table carries beside it: units, meanings, and what it adds up to, as JSON."""
    return {**metadata(COLUMNS[kind]), "dissipated": json.dumps(dissipated)}


@dataclass(frozen=True)
class TableMaker:
    """Makes the tables of one load in one drum.

    Parameters
    ----------
    parts
        Names of the parts of the drum.
    kinds
        Names of the species, one at least.
    time_step
        Time step [s].
    """

    parts: tuple[str, ...]
    kinds: tuple[str, ...]
    time_step: float

    def contacts(self, arrays: dict[str, NDArray[Any]], *, is_open: bool = False) -> "pl.DataFrame":
        """Return contacts that have ended, or are open, as a table."""
        import polars as pl

        steps = arrays["ended"].astype(np.int64) - arrays["opened"].astype(np.int64)
        others = {name: pl.Series(arrays[name]) for name in ("other", "part")}
        columns = {
            "opened": arrays["opened"] * self.time_step,
            "duration": steps * self.time_step,
            "particle": pl.Series(arrays["particle"]),
            "other": others["other"].set(others["other"] == _NONE, None),
            "part": self._part_names(arrays["part"]),
            **{one.name: arrays[one.name] for one in CONTACTS[5:14]},
            "is_open": np.full(len(steps), is_open),
            "count": np.ones(len(steps), np.uint32),
        }
        return pl.DataFrame(columns, nan_to_null=True)

    def arrays(self, table: "pl.DataFrame") -> dict[str, NDArray[Any]]:
        """Return contacts of a table as the core has them."""
        import polars as pl

        opened = np.rint(table["opened"].to_numpy() / self.time_step)
        ended = opened + np.rint(table["duration"].to_numpy() / self.time_step)
        bodies = {"other": table["other"], "part": table["part"].to_physical()}
        return {
            "opened": opened.astype(np.uint64),
            "ended": ended.astype(np.uint64),
            "particle": table["particle"].to_numpy(),
            **{name: own.cast(pl.UInt32).fill_null(_NONE).to_numpy() for name, own in bodies.items()},
            **{one.name: table[one.name].fill_null(np.nan).to_numpy() for one in CONTACTS[5:13]},
        }

    def below_floor(self, count: int, dissipated: Sequence[float]) -> "pl.DataFrame":
        """Return the row of the contacts that were too small to be listed."""
        table = self.contacts({name: np.empty(0, kind) for name, kind in _CORE_TYPES.items()})
        energies = dict(
            zip(("dissipated_normal", "dissipated_tangential", "dissipated_rolling"), dissipated, strict=True)
        )
        row = dict.fromkeys(table.columns) | energies | {"is_open": False, "count": count}
        return type(table)([row], schema=table.schema)

    def wall_profile(self, profile: dict[str, NDArray[Any]]) -> "pl.DataFrame":
        """Return the profile along the drum's outline as a table."""
        import polars as pl

        numbers = np.hstack([profile["places"], profile["sums"]])
        names = [column.name for column in WALL_PROFILE[1:]]
        return pl.DataFrame(
            {"part": self._part_names(profile["part"]), **dict(zip(names, numbers.T, strict=True))}
        )

    def ledger_split(self, split: NDArray[np.float64]) -> "pl.DataFrame":
        """Return what pairs of species, and species and parts of the drum, took, as a table."""
        import polars as pl

        pairs = [*combinations_with_replacement(self.kinds, 2)]
        pairs += [(kind, part) for kind in self.kinds for part in self.parts]
        bodies = dict(zip(("body", "other"), map(list, zip(*pairs, strict=True)), strict=True))
        return pl.DataFrame({**bodies, **dict(zip(FLOWS, split.T, strict=True))})

    def discs(
        self, discs: dict[str, NDArray[Any]], radii: NDArray[np.float64], species: NDArray[Any]
    ) -> "pl.DataFrame":
        """Return what the discs received and how they flew, as a table."""
        import polars as pl

        received = dict(
            zip(
                ("received_normal", "received_tangential", "received_rolling"),
                discs["received"].T,
                strict=True,
            )
        )
        return pl.DataFrame(
            {
                "id": np.arange(len(radii), dtype=np.uint32),
                "species": self._species_names(species),
                "radius": radii,
                "mass": discs["mass"],
                **received,
                **{column.name: discs[column.name] for column in DISCS[7:]},
            }
        )

    def fields(self, fields: dict[str, Any]) -> "pl.DataFrame":
        """Return the means in cells as a table."""
        import polars as pl

        middles, moments = fields["middles"], max(fields["moments"], 1)
        count = len(middles)
        area = (middles[1] - middles[0]) ** 2
        means = fields["sums"] / (moments * area)
        places = [np.repeat(middles, count), np.tile(middles, count)]
        return pl.DataFrame(dict(zip((one.name for one in FIELDS), [*places, *means.T], strict=True)))

    def zone_visits(
        self, visits: dict[str, Any], zones: Sequence[str], species: NDArray[Any]
    ) -> "pl.DataFrame":
        """Return how bundles visited zones as a table."""
        import polars as pl

        count, inside, sums = len(species), visits["times"][:, 0], visits["times"][:, 1:].T
        return pl.DataFrame(
            {
                "zone": pl.Series(np.repeat(zones, count), dtype=pl.Enum(zones)),
                "id": np.tile(np.arange(count, dtype=np.uint32), len(zones)),
                "species": self._species_names(np.tile(species, len(zones))),
                "entries": visits["entries"],
                "time_inside": inside,
                "cycles": visits["cycles"],
                **dict(zip((one.name for one in ZONE_VISITS[6:]), sums, strict=True)),
            }
        )

    def _species_names(self, places: NDArray[Any]) -> "pl.Series":
        import polars as pl

        return pl.Series(self.kinds, dtype=pl.Enum(sorted(set(self.kinds)))).gather(pl.Series(places))

    def _part_names(self, places: NDArray[np.uint32]) -> "pl.Series":
        import polars as pl

        own = pl.Series(places)
        names = pl.Series(self.parts, dtype=pl.Enum(self.parts))
        return names.gather(own.set(own == _NONE, None))


# The core's arrays of contacts.
_CORE_TYPES: dict[str, type] = {
    **dict.fromkeys(("opened", "ended"), np.uint64),
    **dict.fromkeys(("particle", "other", "part"), np.uint32),
    **dict.fromkeys((column.name for column in CONTACTS[5:14]), np.float64),
}


# Digits of contacts are mostly chance: to compress them harder takes long and gains next to nothing.
CONTACTS_LEVEL = 1


def write_contact_tables(folder: Path, tables: Mapping[str, Any]) -> list[Path]:
    """Write what `Records.contact_tables` returns; return the paths written."""
    paths = {kind: folder / f"{kind}.parquet" for kind in COLUMNS if kind in tables}
    for kind, path in paths.items():
        level = CONTACTS_LEVEL if kind == "contacts" else None
        write_table(path, tables[kind], file_words(kind, tables["dissipated"]), level=level)
    return list(paths.values())


def read_contact_tables(folder: Path) -> dict[str, Any]:
    """Return what `write_contact_tables` has written into a folder."""
    import polars as pl

    paths = {kind: folder / f"{kind}.parquet" for kind in COLUMNS}
    there = {kind: path for kind, path in paths.items() if path.is_file()}
    tables: dict[str, Any] = {
        kind: pl.read_parquet(io.BytesIO(read_plain(path))) for kind, path in there.items()
    }
    for path in there.values():
        tables["dissipated"] = json.loads(pl.read_parquet_metadata(path)["dissipated"])
    return tables
