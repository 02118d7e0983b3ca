"""The registry of quantities: one name for each, with symbol, unit, reading, formula and meaning.

What a run records is declared by the core, beside the code that computes it. What is made of it is declared here, or
follows from the rules for names (`_by_rule`). Columns of tables, fields of the summary, units in files, labels of
figures and docs/quantities.md all read from here.
"""

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from types import MappingProxyType

from drumrs import _core
from drumrs.errors import ConfigError

# What adds columns to the series on request, by the key `run.record`.
RECORDINGS = ("gross_work",)

# The parts of a drum with one baffle and one wall.
PARTS = ("rim", "baffle 1", "wall 1")

# How values are to be read.
READINGS = MappingProxyType(
    {
        "sample": "value at the time of the sample",
        "mean": "mean since the last sample, or over the window",
        "cumulative": "integral since t = 0",
        "greatest": "greatest value since the last sample, or within the window",
        "run": "one value for the run",
        "ratio": "ratio of two means over the window",
        "error": "standard error of a mean over the window, from block averages",
        "test": "test of whether the window is steady",
    }
)


@dataclass(frozen=True)
class Quantity:
    """What a column or a field holds.

    Attributes
    ----------
    name
        The name under which it goes everywhere.
    symbol
        Symbol, as formulas use it.
    unit
        Unit, per meter of drum depth where the quantity is extensive; "1" for a plain number.
    reading
        How its values are to be read: a key of `READINGS`.
    formula
        Formula, in the symbols of other quantities; empty where the meaning says it all. Δ is the change between two
        samples, or over the window; in energies without a rate, the change since t = 0.
    meaning
        What it means.

    Examples
    --------
    >>> import drumrs
    >>> drumrs.quantity("dissipated_sliding").label
    'dissipated sliding [J/m]'
    """

    name: str
    symbol: str
    unit: str
    reading: str
    formula: str
    meaning: str

    @property
    def title(self) -> str:
        """The name in words."""
        return self.name.replace("_", " ")

    @property
    def label(self) -> str:
        """The name in words, with the unit: what stands at an axis or at the head of a column."""
        return self.title if self.unit == "1" else f"{self.title} [{self.unit}]"

    @property
    def text(self) -> str:
        """Meaning, formula and unit in one line."""
        formula = f", {self.formula}" if self.formula else ""
        unit = f" [{self.unit}]" if self.unit != "1" else ""
        return f"{self.meaning[0].upper()}{self.meaning[1:]}{formula}{unit}"


def quantity(name: str) -> Quantity:
    """Return what the registry says of a quantity.

    Parameters
    ----------
    name
        Name of a column of series, frames or a table of results, or of a field of the summary.

    Raises
    ------
    KeyError
        Where there is no such quantity.

    Examples
    --------
    >>> import drumrs
    >>> drumrs.quantity("baffle_2_work").unit, drumrs.quantity("dissipated_sliding_specific_power").unit
    ('J/m', 'W/kg')
    >>> print(drumrs.quantity("dissipation_ratio").meaning)
    N/T by dissipation: what normal damping takes over what sliding takes
    """
    found = _find(name)
    if found is None:
        raise KeyError(f"{name!r} is not the name of a quantity; drumrs.quantities() lists them")
    return found


def known(names: Iterable[str]) -> list[Quantity]:
    """Return those of the names that are quantities."""
    return [found for name in names if (found := _find(name)) is not None]


def metadata(columns: Iterable[Quantity]) -> dict[str, str]:
    """Return what a file has to carry beside a table with these columns: their units and meanings, as JSON."""
    columns = list(columns)
    return {
        "units": json.dumps({column.name: column.unit for column in columns}),
        "meanings": json.dumps({column.name: column.meaning for column in columns}, ensure_ascii=False),
    }


def require(path: Path, names: Iterable[str], wanted: Iterable[str]) -> None:
    """Refuse a file of another version of drumrs, in which quantities have other names.

    Raises
    ------
    ConfigError
        Where one of those wanted is not among the names.
    """
    known = set(names)
    for name in wanted:
        if name not in known:
            problem = (
                f"has no {name!r}, but must have it: another version of drumrs wrote it, with other names"
            )
            hint = "run its configuration again, or read it with that version"
            raise ConfigError(Path(path), problem=problem, hint=hint)


def recorded(parts: Iterable[str] = PARTS, record: Iterable[str] = ()) -> list[Quantity]:
    """Return the columns of the series of a drum with these parts, in their order.

    Those of what is recorded on request, `record`, are among them.
    """
    return [Quantity(*row) for row in _core.Simulation.columns(list(parts), "gross_work" in record)]


def declared() -> Mapping[str, Quantity]:
    """Return what is declared, not made by a rule, by name: the series with one baffle and one wall, then the rest."""
    return _declared()


@cache
def _declared() -> Mapping[str, Quantity]:
    rows = (*recorded(record=RECORDINGS), *_ROWS, *_PUBLISHED_DRUMS, *_MEASURES, *_FACTS, *_PHASES)
    return MappingProxyType({row.name: row for row in rows})


def _find(name: str) -> Quantity | None:
    return _declared().get(name) or _of_surface(name) or _by_rule(name)


def _of_surface(name: str) -> Quantity | None:
    """Return a column of a part of the drum: of a baffle or wall beyond the first, or one that a liner names."""
    found = re.fullmatch(r"([a-z]\w*)_([1-9]\d*)_(work|torque|force_x|force_y)", name)
    if found is None:
        return None
    columns = recorded([f"{found[1]} {found[2]}"])
    return next(column for column in columns if column.name == name)


def _by_rule(name: str) -> Quantity | None:
    """Return what follows from another quantity by the rules for names.

    - ``<energy>_power``: what a cumulative energy grows by per time. An ending ``_work`` gives way: ``drum_work``,
      ``drum_power``.
    - ``<energy>_specific_power``: the same over the mass of the load.
    - ``<mean>_error``: the standard error of a mean.
    """
    stem, _, ending = name.rpartition("_")
    if ending == "error":
        mean = _declared().get(stem) or _by_rule(stem)
        known = mean is not None and mean.reading in {"mean", "ratio"}
        return _error_of(mean) if mean is not None and known else None
    flow = stem.removesuffix("_specific")
    energy = _declared().get(flow) or _declared().get(f"{flow}_work")
    if ending != "power" or energy is None or energy.reading != "cumulative":
        return None
    formula = f"Δ{energy.symbol}/Δt"
    power = Quantity(name, formula, "W/m", "mean", formula, f"{energy.meaning}, per time")
    if flow == stem:
        return power
    specific = f"{formula}/M"
    return replace(
        power, symbol=specific, unit="W/kg", formula=specific, meaning=f"{power.meaning} and mass of the load"
    )


def _error_of(mean: Quantity) -> Quantity:
    changes = {"reading": "error", "formula": "", "meaning": f"standard error of {mean.name}"}
    return replace(mean, name=f"{mean.name}_error", symbol=f"s({mean.symbol})", **changes)


def _made(
    name: str, unit: str, reading: str, meaning: str, *, symbol: str = "", formula: str = ""
) -> Quantity:
    return Quantity(name, symbol, unit, reading, formula, meaning)


# What is made of the series.
_ROWS = (
    # Summary of a run.
    _made("bundle_count", "1", "run", "number of bundles", symbol="N"),
    _made(
        "fill",
        "1",
        "run",
        "cross-section of the bundles over that of the drum",
        symbol="φ",
        formula="Σ d² / D²",
    ),
    _made("steps", "1", "run", "time steps since t = 0"),
    _made("time_step", "s", "run", "time step", symbol="h"),
    _made("window_start", "s", "run", "start of the window of the averages, at a sample", symbol="t₁"),
    _made("window_end", "s", "run", "end of the window of the averages, at a sample", symbol="t₂"),
    _made(
        "energy_balance_power",
        "W/m",
        "mean",
        "power of the drum from the energy ledger: what is stored and what is taken, per time",
        symbol="P_E",
        formula="(ΔE + Σ ΔD + ΔD_numerical)/Δt",
    ),
    _made(
        "power_disagreement",
        "1",
        "run",
        "greatest difference of drum_power, energy_balance_power and moment_balance_power, relative",
        formula="greatest difference of P, P_E, ΔW_L/Δt / max(|P|, |P_E|, |ΔW_L/Δt|, E/Δt)",
    ),
    _made(
        "dissipation_ratio",
        "1",
        "ratio",
        "N/T by dissipation: what normal damping takes over what sliding takes",
        symbol="(N/T)_D",
        formula="ΔD_normal/ΔD_sliding",
    ),
    _made(
        "work_ratio",
        "1",
        "ratio",
        "N/T by net work: normal_power over tangential_power, which count what springs store as well",
        symbol="(N/T)_W",
        formula="ΔN/ΔT",
    ),
    _made(
        "gross_work_ratio",
        "1",
        "ratio",
        "N/T by gross work: what normal forces exchange over what tangential forces exchange, loading and unloading "
        "both counted; where run.record has 'gross_work'",
        symbol="(N/T)_G",
        formula="ΔN_gross/ΔT_gross",
    ),
    _made("kinetic_energy", "J/m", "mean", "kinetic energy of the load", symbol="K", formula="K_t + K_r"),
    _made("drum_force_x", "N/m", "mean", "horizontal force of the load on the drum", symbol="F_x"),
    _made("drum_force_y", "N/m", "mean", "vertical force of the load on the drum", symbol="F_y"),
    _made("correlation_time", "s", "run", "integrated correlation time of drum_power", symbol="t_c"),
    _made("wall_time", "s", "run", "time of the wall clock spent stepping in this process"),
    _made("particle_steps_per_second", "1/s", "run", "bundles times steps, per second of wall_time"),
    # Table of a sweep, beyond the summaries.
    _made(
        "specific_angular_momentum",
        "m²/s",
        "mean",
        "angular momentum over the mass of the load: 0 for a load that stays where it is, however it rocks",
        symbol="L/M",
    ),
    _made("drift", "1", "test", "change of drum_power within the window, over its mean"),
    _made(
        "share_drift",
        "1",
        "test",
        "change of the share of normal damping in all dissipation within the window",
    ),
    _made(
        "share_switching",
        "1",
        "test",
        "difference of that share between stretches of time, greatest less least",
    ),
    _made("drift_significance", "1", "test", "probability of so large a drift in a steady run", symbol="p"),
    _made(
        "share_drift_significance",
        "1",
        "test",
        "probability of so large a share_drift in a steady run",
        symbol="p",
    ),
    _made(
        "share_switching_significance",
        "1",
        "test",
        "probability of so large a share_switching in a steady run",
        symbol="p",
    ),
    _made(
        "drifting", "1", "test", "whether one of the three tests finds a change beyond chance and above 1 %"
    ),
    # Table of the paper's study, beyond that of a sweep.
    _made("size_ratio", "1", "run", "diameter of the drum over that of a bundle", symbol="D/d"),
    _made("along_the_rim", "1", "mean", "share of the time that a bundle spends along the rim"),
    _made("carried_round", "1", "mean", "share of the load that the drum carries over the top in a turn"),
    _made("mixed_in_a_turn", "1", "mean", "index of mixing after a turn of the drum"),
    _made(
        "surface_speed",
        "1",
        "mean",
        "speed relative to the turning drum at the free surface of the load, over that of the rim",
    ),
    _made(
        "middle_speed",
        "1",
        "mean",
        "speed relative to the turning drum below the free surface, over that of the rim",
    ),
    _made(
        "deep_speed", "1", "mean", "speed relative to the turning drum deep in the load, over that of the rim"
    ),
    # Frames, one row for each bundle.
    _made("frame", "1", "sample", "number of the frame"),
    _made("bundle", "1", "sample", "number of the bundle"),
    _made("x", "m", "sample", "horizontal position of a bundle's center from the axis", symbol="x"),
    _made("y", "m", "sample", "vertical position of a bundle's center from the axis", symbol="y"),
    _made("angle", "rad", "sample", "angle by which a bundle has turned, within ±π"),
    _made("velocity_x", "m/s", "sample", "horizontal velocity of a bundle", symbol="v_x"),
    _made("velocity_y", "m/s", "sample", "vertical velocity of a bundle", symbol="v_y"),
    _made("contacts", "1", "sample", "number of a bundle's contacts, those with the drum included"),
    _made("radius", "m", "sample", "radius of a bundle", symbol="r"),
    _made("species", "1", "sample", "name of a bundle's species, where the load has species"),
)

# Table of the published drums, beyond that of a sweep.
_PUBLISHED_DRUMS = (
    _made(
        "mean_overlap_ratio",
        "1",
        "mean",
        "overlap over the radius, root mean square over contacts and time",
        symbol="δ/r",
        formula="√(2 ΣE_normal / (k n)) / r",
    ),
    _made("surface_slope", "rad", "mean", "angle of the bed's surface to the horizontal"),
    _made("bed_depth", "m", "mean", "depth of the bed, from its surface to the rim, under the axis"),
    _made(
        "surface_velocity_ratio", "1", "mean", "velocity down the slope at the bed's surface, over the rim's"
    ),
    _made(
        "layer_thickness",
        "m",
        "mean",
        "thickness of the flowing layer, from the surface to where the velocity is zero",
    ),
    _made(
        "layer_to_solid_rotation",
        "m",
        "mean",
        "thickness of the flowing layer, down to where its straight profile meets solid rotation",
    ),
    _made(
        "core_velocity_ratio",
        "1",
        "mean",
        "angular velocity of the bed below the flowing layer, over the drum's",
    ),
    _made("toe_angle", "rad", "mean", "angle of the lower end of the charge at a mill's shell"),
    _made("shoulder_angle", "rad", "mean", "angle of the upper end of the charge at a mill's shell"),
)
PUBLISHED_DRUMS = tuple(row.name for row in _PUBLISHED_DRUMS)

# What `drumrs.measures` returns by name, beyond that.
_MEASURES = (
    # charge
    _made(
        "center_slope",
        "rad",
        "mean",
        "slope of the bed by its center of mass",
        symbol="α",
        formula="atan2(x, −y)",
    ),
    _made(
        "s_shape",
        "1",
        "mean",
        "greatest distance of the bed's surface from its chord, over the chord",
        symbol="κ",
    ),
    _made("filling", "1", "mean", "area between rim and surface of the bed, over the drum's", symbol="J"),
    _made(
        "arm",
        "1",
        "mean",
        "arm of the load's weight about the axis, over the drum's radius, positive on the rising side",
        formula="x/R",
    ),
    # unbalance
    _made(
        "unbalance",
        "kg",
        "mean",
        "length of the load's first moment of mass about the axis [kg m per m]",
        symbol="|U|",
        formula="|Σ m r|",
    ),
    _made(
        "turning_unbalance",
        "kg",
        "mean",
        "length of the mean of that moment in the frame of the drum: what turns with it",
        symbol="|⟨U⟩|",
    ),
    _made("eccentricity", "m", "mean", "unbalance over the mass of the load", symbol="ε", formula="|U|/M"),
    # motion
    _made(
        "circulation",
        "1",
        "mean",
        "how often a disc goes round the center of circulation in a turn of the drum",
    ),
    _made(
        "wall_slip",
        "1",
        "ratio",
        "how far the layer at the wall stays behind the drum, over the drum's speed",
        formula="1 − ω/Ω",
    ),
    # flight
    _made(
        "share_in_flight",
        "1",
        "mean",
        "share of mass and time without contact for longer than ½ √(2 d/g)",
    ),
    _made("falls_per_turn", "1", "mean", "falls of a disc in a turn of the drum"),
    _made("mean_drop", "m", "ratio", "height from take-off to landing, mean over falls"),
    _made(
        "landing_on_drum",
        "1",
        "ratio",
        "share of the energy of landing falls that meets the drum, not the load",
    ),
    _made("head_height", "m", "mean", "height above the axis that 99 % of the flying mass stays below"),
    _made(
        "impact_toe_angle",
        "rad",
        "mean",
        "angle that 5 % of the energy of landing falls lies beyond, as seen from the top",
    ),
    # washing and drying
    _made(
        "center_turning", "rad/s", "mean", "change of the polar angle of the center of mass, without its sign"
    ),
    _made("disc_turning", "rad/s", "mean", "change of the polar angle of a disc, without its sign"),
    _made("moving_speed", "m/s", "mean", "way of a disc between frames, over their interval"),
    _made("moving_spread", "1", "mean", "standard deviation of these ways over discs, over their mean"),
    _made("axis_distance_spread", "m", "mean", "standard deviation of the distances of discs from the axis"),
    _made("shape_factor", "1", "mean", "roundness of the outline of the load", formula="4 π A/P²"),
    _made(
        "openness", "1", "mean", "share of the discs' perimeters from which a line of D/4 meets no other disc"
    ),
    _made("curtain", "1", "mean", "share of vertical lines through the drum that meet a disc in flight"),
)
MEASURES = tuple(row.name for row in _MEASURES)

# What places a case among others.
_FACTS = (
    _made("load_mass", "kg/m", "run", "mass of the load per meter of depth", symbol="M", formula="Σ m"),
    _made("steps_per_collision", "1", "run", "time steps in the shortest collision"),
    _made(
        "critical_angular_velocity",
        "rad/s",
        "run",
        "angular velocity from which on a bundle stays on the rim all the way round",
        symbol="Ω_c",
        formula="√(g/(R − r))",
    ),
    _made("critical_share", "1", "run", "greatest speed of the drum over the critical one", formula="Ω/Ω_c"),
    _made(
        "froude_number",
        "1",
        "run",
        "centrifugal acceleration of the rim over gravity, at the greatest speed of the drum",
        symbol="Fr",
        formula="Ω² R/g",
    ),
)
FACTS = tuple(row.name for row in _FACTS)

# Table of the phases of a program, beyond the summary and the table of a sweep.
_PHASES = (
    _made("number", "1", "run", "how often the phase has come, from 1 on"),
    _made("start", "s", "run", "time at which the phase begins"),
    _made("end", "s", "run", "time at which the phase ends, or the run"),
    _made("phase_work", "J/m", "run", "work of the drum on the load within the phase", symbol="ΔW"),
    _made(
        "phase_specific_work",
        "J/kg",
        "run",
        "work of the drum on the load within the phase, over the mass of the load",
        symbol="ΔW/M",
    ),
)
PHASES = tuple(row.name for row in _PHASES)
