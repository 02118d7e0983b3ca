"""Quantities that are made of what a run records, beside those that follow from the rules for names: a row for each.

`registry` finds them by name. The core declares what it records where it computes it.
"""

from typing import NamedTuple


class Row(NamedTuple):
    """A quantity; the fields are those of `registry.Quantity`."""

    name: str
    symbol: str
    unit: str
    reading: str
    formula: str
    meaning: str


def made(name: str, unit: str, reading: str, meaning: str, *, symbol: str = "", formula: str = "") -> Row:
    """Return the row of a quantity, in the order in which one is told."""
    return Row(name, symbol, unit, reading, formula, meaning)


# What is made of the series.
TABLES = (
    # Summary of a run.
    made("bundle_count", "1", "run", "number of bundles", symbol="N"),
    made(
        "fill",
        "1",
        "run",
        "cross-section of the bundles over that of the drum",
        symbol="φ",
        formula="Σ d² / D²",
    ),
    made("steps", "1", "run", "time steps since t = 0"),
    made("time_step", "s", "run", "time step", symbol="h"),
    made("window_start", "s", "run", "start of the window of the averages, at a sample", symbol="t₁"),
    made("window_end", "s", "run", "end of the window of the averages, at a sample", symbol="t₂"),
    made(
        "energy_balance_power",
        "W/m",
        "mean",
        "power of the drum from the energy ledger: what is stored and what is taken, per time",
        symbol="P_E",
        formula="(ΔE + Σ ΔD + ΔD_numerical)/Δt",
    ),
    made(
        "power_disagreement",
        "1",
        "run",
        "greatest difference of drum_power, energy_balance_power and moment_balance_power, relative",
        formula="greatest difference of P, P_E, ΔW_L/Δt / max(|P|, |P_E|, |ΔW_L/Δt|, E/Δt)",
    ),
    made(
        "dissipation_ratio",
        "1",
        "ratio",
        "N/T by dissipation: what normal damping takes over what sliding takes",
        symbol="(N/T)_D",
        formula="ΔD_normal/ΔD_sliding",
    ),
    made(
        "work_ratio",
        "1",
        "ratio",
        "N/T by net work: normal_power over tangential_power, which count what springs store as well",
        symbol="(N/T)_W",
        formula="ΔN/ΔT",
    ),
    made(
        "gross_work_ratio",
        "1",
        "ratio",
        "N/T by gross work: what normal forces exchange over what tangential forces exchange, loading and unloading "
        "both counted; where run.record has 'gross_work'",
        symbol="(N/T)_G",
        formula="ΔN_gross/ΔT_gross",
    ),
    made("kinetic_energy", "J/m", "mean", "kinetic energy of the load", symbol="K", formula="K_t + K_r"),
    made("drum_force_x", "N/m", "mean", "horizontal force of the load on the drum", symbol="F_x"),
    made("drum_force_y", "N/m", "mean", "vertical force of the load on the drum", symbol="F_y"),
    made("correlation_time", "s", "run", "integrated correlation time of drum_power", symbol="t_c"),
    made("wall_time", "s", "run", "time of the wall clock spent stepping in this process"),
    made("particle_steps_per_second", "1/s", "run", "bundles times steps, per second of wall_time"),
    # Table of a sweep, beyond the summaries.
    made(
        "specific_angular_momentum",
        "m²/s",
        "mean",
        "angular momentum over the mass of the load: 0 for a load that stays where it is, however it rocks",
        symbol="L/M",
    ),
    made("drift", "1", "test", "change of drum_power within the window, over its mean"),
    made(
        "share_drift",
        "1",
        "test",
        "change of the share of normal damping in all dissipation within the window",
    ),
    made(
        "share_switching",
        "1",
        "test",
        "difference of that share between stretches of time, greatest less least",
    ),
    made("drift_significance", "1", "test", "probability of so large a drift in a steady run", symbol="p"),
    made(
        "share_drift_significance",
        "1",
        "test",
        "probability of so large a share_drift in a steady run",
        symbol="p",
    ),
    made(
        "share_switching_significance",
        "1",
        "test",
        "probability of so large a share_switching in a steady run",
        symbol="p",
    ),
    made(
        "drifting", "1", "test", "whether one of the three tests finds a change beyond chance and above 1 %"
    ),
    # Table of the paper's study, beyond that of a sweep.
    made("size_ratio", "1", "run", "diameter of the drum over that of a bundle", symbol="D/d"),
    made("along_the_rim", "1", "mean", "share of the time that a bundle spends along the rim"),
    made("carried_round", "1", "mean", "share of the load that the drum carries over the top in a turn"),
    made("mixed_in_a_turn", "1", "mean", "index of mixing after a turn of the drum"),
    made(
        "surface_speed",
        "1",
        "mean",
        "speed relative to the turning drum at the free surface of the load, over that of the rim",
    ),
    made(
        "middle_speed",
        "1",
        "mean",
        "speed relative to the turning drum below the free surface, over that of the rim",
    ),
    made(
        "deep_speed", "1", "mean", "speed relative to the turning drum deep in the load, over that of the rim"
    ),
    # Frames, one row for each bundle.
    made("frame", "1", "sample", "number of the frame"),
    made("bundle", "1", "sample", "number of the bundle"),
    made("x", "m", "sample", "horizontal position of a bundle's center from the axis", symbol="x"),
    made("y", "m", "sample", "vertical position of a bundle's center from the axis", symbol="y"),
    made("angle", "rad", "sample", "angle by which a bundle has turned, within ±π"),
    made("velocity_x", "m/s", "sample", "horizontal velocity of a bundle", symbol="v_x"),
    made("velocity_y", "m/s", "sample", "vertical velocity of a bundle", symbol="v_y"),
    made("contacts", "1", "sample", "number of a bundle's contacts, those with the drum included"),
    made("radius", "m", "sample", "radius of a bundle", symbol="r"),
    made("species", "1", "sample", "name of a bundle's species, where the load has species"),
)

# Table of the published drums, beyond that of a sweep.
PUBLISHED_DRUMS = (
    made(
        "mean_overlap_ratio",
        "1",
        "mean",
        "overlap over the radius, root mean square over contacts and time, as if all had the springs of two bundles",
        symbol="δ/r",
        formula="√(2 ΣE_normal / (k n)) / r",
    ),
    made(
        "center_slope",
        "rad",
        "mean",
        "slope of the bed by its center of mass",
        symbol="α",
        formula="atan2(x, −y)",
    ),
    made("bed_depth", "m", "mean", "depth of the bed, from its surface to the rim, under the axis"),
    made(
        "surface_velocity_ratio", "1", "mean", "velocity down the slope at the bed's surface, over the rim's"
    ),
    made(
        "layer_thickness",
        "m",
        "mean",
        "thickness of the flowing layer, from the surface to where the velocity is zero",
    ),
    made(
        "layer_to_solid_rotation",
        "m",
        "mean",
        "thickness of the flowing layer, down to where its straight profile meets solid rotation",
    ),
    made(
        "core_velocity_ratio",
        "1",
        "mean",
        "angular velocity of the bed below the flowing layer, over the drum's",
    ),
    made("toe_angle", "rad", "mean", "angle of the lower end of the charge at the drum's shell"),
    made("shoulder_angle", "rad", "mean", "angle of the upper end of the charge at the drum's shell"),
)

# What `drumrs.measures` returns by name, beyond that.
MEASURES = (
    # charge
    made("surface_slope", "rad", "mean", "angle of the bed's surface to the horizontal"),
    made(
        "s_shape",
        "1",
        "mean",
        "greatest distance of the bed's surface, without its ends, from its chord, over the chord",
        symbol="κ",
    ),
    made("filling", "1", "mean", "area between rim and surface of the bed, over the drum's", symbol="J"),
    made(
        "arm",
        "1",
        "mean",
        "arm of the load's weight about the axis, over the drum's radius, positive on the rising side",
        formula="x/R",
    ),
    # unbalance
    made(
        "unbalance",
        "kg",
        "mean",
        "length of the load's first moment of mass about the axis [kg m per m]",
        symbol="|U|",
        formula="|Σ m r|",
    ),
    made(
        "turning_unbalance",
        "kg",
        "mean",
        "length of the mean of that moment in the frame of the drum: what turns with it",
        symbol="|⟨U⟩|",
    ),
    made("eccentricity", "m", "mean", "unbalance over the mass of the load", symbol="ε", formula="|U|/M"),
    # motion
    made(
        "circulation",
        "1",
        "mean",
        "how often a disc goes round the center of circulation in a turn of the drum",
    ),
    made(
        "wall_slip",
        "1",
        "ratio",
        "how far the layer at the wall stays behind the drum, over the drum's speed",
        formula="1 − ω/Ω",
    ),
    # mixing, and visits to zones
    made(
        "lacey_index",
        "1",
        "mean",
        "Lacey's index over cells of ten discs that turn with the drum: of a species, lacey_index(by='ore'), or of "
        "discs colored by where they were before a turn, by='side', 'layer' or 'depth'; turns=3 gives them three",
        formula="(σ₀² − σ²)/(σ₀² − σ_r²)",
    ),
    made(
        "zone_residence",
        "s",
        "ratio",
        "mean time of a visit to a zone of run.zone, as zone_residence(zone='spray')",
        symbol="w̄",
    ),
    made(
        "zone_cycle",
        "s",
        "ratio",
        "mean time from the beginning of a visit to that of the next one, as zone_cycle(zone='spray')",
        symbol="c̄",
    ),
    made(
        "zone_share", "1", "mean", "share of its time that a disc is in a zone, as zone_share(zone='spray')"
    ),
    made(
        "zone_spread",
        "1",
        "run",
        "standard deviation over discs of the time spent in a zone, over its mean, to be expected after a minute, as "
        "zone_spread(zone='spray'), or after time=600",
        formula="√(Var(W − (w̄/c̄) C) c̄/t)/w̄",
    ),
    # flight
    made(
        "share_in_flight",
        "1",
        "mean",
        "share of mass and time without contact for longer than ½ √(2 d/g)",
    ),
    made("falls_per_turn", "1", "mean", "falls of a disc in a turn of the drum"),
    made("mean_drop", "m", "ratio", "height from take-off to landing, mean over falls"),
    made(
        "landing_on_drum",
        "1",
        "ratio",
        "share of the energy of landing falls that meets the drum, not the load",
    ),
    made("head_height", "m", "mean", "height above the axis that 99 % of the flying mass stays below"),
    made(
        "impact_toe_angle",
        "rad",
        "mean",
        "angle that 5 % of the energy of landing falls lies beyond, as seen from the top",
    ),
    # washing and drying
    made(
        "center_turning", "rad/s", "mean", "change of the polar angle of the center of mass, without its sign"
    ),
    made("disc_turning", "rad/s", "mean", "change of the polar angle of a disc, without its sign"),
    made("moving_speed", "m/s", "mean", "way of a disc between frames, over their interval"),
    made("moving_spread", "1", "mean", "standard deviation of these ways over discs, over their mean"),
    made("axis_distance_spread", "m", "mean", "standard deviation of the distances of discs from the axis"),
    made("shape_factor", "1", "mean", "roundness of the outline of the load", formula="4 π A/P²"),
    made(
        "openness", "1", "mean", "share of the discs' perimeters from which a line of D/4 meets no other disc"
    ),
    made("curtain", "1", "mean", "share of vertical lines through the drum that meet a disc in flight"),
    # torque
    made("torque_peak_factor", "1", "greatest", "greatest torque of the drum over its root mean square"),
    # contacts
    made(
        "impact_rate",
        "1/(kg s)",
        "mean",
        "contacts that are over within three collision times, per mass of the load and time",
    ),
    made("impact_specific_power", "W/kg", "mean", "what these impacts take, per mass of the load"),
    made(
        "median_impact_energy", "J/m", "mean", "energy above which impacts take half of all that impacts take"
    ),
    made("drum_impact_rate", "1/(kg s)", "mean", "impacts on the drum, per mass of the load and time"),
    made("drum_impact_specific_power", "W/kg", "mean", "what impacts on the drum take, per mass of the load"),
    # wall_profile
    made(
        "archard_wear",
        "J/m",
        "mean",
        "normal force times way slid along the outline of the drum in a turn, from t = 0 on; Archard's coefficient "
        "makes it a volume",
        formula="∫ Fₙ ds",
    ),
    made(
        "finnie_wear",
        "J/m",
        "mean",
        "what Finnie's law adds up along the outline of the drum in a turn, from t = 0 on; his coefficient makes it a "
        "volume",
        formula="∫ 2 |v| |F| f(γ) dt",
    ),
    made("wear_peak", "1", "mean", "depth of Archard's wear in the bin that wears most, over its mean"),
    # ledger_split
    made("load_knocking", "W/kg", "mean", "what normal damping takes between discs, from t = 0 on"),
    made(
        "load_rubbing",
        "W/kg",
        "mean",
        "what sliding and tangential damping take between discs, from t = 0 on",
    ),
    made("drum_knocking", "W/kg", "mean", "what normal damping takes at the drum, from t = 0 on"),
    made(
        "drum_rubbing", "W/kg", "mean", "what sliding and tangential damping take at the drum, from t = 0 on"
    ),
    # discs
    made(
        "received_spread",
        "1",
        "mean",
        "standard deviation over discs of the energy received per mass, over its mean, from t = 0 on",
    ),
)

# Measures that each part of the drum has as well, and that of the whole drum of which they are a part.
OF_PARTS = {
    "impact_rate": "drum_impact_rate",
    "impact_specific_power": "drum_impact_specific_power",
    "archard_wear": "archard_wear",
    "finnie_wear": "finnie_wear",
}

# What places a case among others.
FACTS = (
    made("load_mass", "kg/m", "run", "mass of the load per meter of depth", symbol="M", formula="Σ m"),
    made("steps_per_collision", "1", "run", "time steps in the shortest collision"),
    made(
        "critical_angular_velocity",
        "rad/s",
        "run",
        "angular velocity from which on a bundle stays on the rim all the way round",
        symbol="Ω_c",
        formula="√(g/(R − r))",
    ),
    made("critical_share", "1", "run", "greatest speed of the drum over the critical one", formula="Ω/Ω_c"),
    made(
        "froude_number",
        "1",
        "run",
        "centrifugal acceleration at the rim or a shell's farthest corner over gravity, at the greatest speed",
        symbol="Fr",
        formula="Ω² R/g",
    ),
)

# Table of the phases of a program, beyond the summary and the table of a sweep.
PHASES = (
    made("number", "1", "run", "how often the phase has come, from 1 on"),
    made("start", "s", "run", "time at which the phase begins"),
    made("end", "s", "run", "time at which the phase ends, or the run"),
    made("phase_work", "J/m", "run", "work of the drum on the load within the phase", symbol="ΔW"),
    made(
        "phase_specific_work",
        "J/kg",
        "run",
        "work of the drum on the load within the phase, over the mass of the load",
        symbol="ΔW/M",
    ),
)
