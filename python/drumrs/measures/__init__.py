"""What designers of rotating drums measure: pure functions on frames and tables, in short modules by family.

- the load as a whole: `motion`, `depth`, `bed`, `overlap`, `species`
- shape of the charge: `shape`, `surface`, `toe`
- mixing and segregation: `colors`, `cells`, `segregation`, `rate`, `neighbors`
- fields, and the flowing layer: `coarse_graining`, `cell_sums`, `profile`
- unbalance: `balance`
- collisions and walls: `spectra`, `collisions`, `walls`, `lifters`; torque and forces over frequency: `signals`
- models of mills to compare with: `morrell`, `hogg_fuerstenau`
- washing and drying: `laundry`
- the regime: `regimes`
- flight and fall: `airborne`, `orbit`; visits to a zone: `zones`

Statistics are those of `drumrs.analysis`; nothing here sees a simulation.
"""

from drumrs.measures.airborne import flight, flights
from drumrs.measures.balance import (
    Exceedance,
    Suspension,
    exceedance,
    turning_force,
    unbalance,
    unbalance_vectors,
)
from drumrs.measures.bed import bulk_fill
from drumrs.measures.cell_sums import recorded_fields
from drumrs.measures.cells import entropy, lacey, mixing_curve, relative_deviation
from drumrs.measures.coarse_graining import Fields, center_of_circulation, fields
from drumrs.measures.collisions import impact_rates
from drumrs.measures.colors import COLORINGS, cell_side, coloring
from drumrs.measures.depth import depth_profile
from drumrs.measures.laundry import (
    curtain,
    knocking_and_rubbing,
    openness,
    received_spread,
    shape_factor,
    washing,
)
from drumrs.measures.lifters import FoldedLifter, exposed, folded_lifter
from drumrs.measures.masses import disc_masses
from drumrs.measures.motion import along_the_rim, carried_round, circulation, sticking, wall_slip
from drumrs.measures.neighbors import mixed_in_a_turn, mixing
from drumrs.measures.orbit import Orbit, davis
from drumrs.measures.overlap import mean_overlap_ratio
from drumrs.measures.profile import flowing_layer
from drumrs.measures.rate import MixingRate, mixing_rate
from drumrs.measures.regimes import Regime, RegimeLimits, regime
from drumrs.measures.segregation import (
    RadialSegregation,
    mean_position_index,
    memory_of_places,
    radial_segregation,
    unlike_contacts,
)
from drumrs.measures.shape import Occupancy, charge, occupancy
from drumrs.measures.signals import frequency_spectrum, peak_factor
from drumrs.measures.species import by_species
from drumrs.measures.spectra import collision_spectrum, enduring, impacts, sum_rule
from drumrs.measures.surface import FreeSurface, free_surface
from drumrs.measures.walls import finnie_f, wear, wear_of_parts, worn_outline
from drumrs.measures.zones import Visits, recorded_visits, zone_visits

__all__ = [
    "COLORINGS",
    "Exceedance",
    "Fields",
    "FoldedLifter",
    "FreeSurface",
    "MixingRate",
    "Occupancy",
    "Orbit",
    "RadialSegregation",
    "Regime",
    "RegimeLimits",
    "Suspension",
    "Visits",
    "along_the_rim",
    "bulk_fill",
    "by_species",
    "carried_round",
    "cell_side",
    "center_of_circulation",
    "charge",
    "circulation",
    "collision_spectrum",
    "coloring",
    "curtain",
    "davis",
    "depth_profile",
    "disc_masses",
    "enduring",
    "entropy",
    "exceedance",
    "exposed",
    "fields",
    "finnie_f",
    "flight",
    "flights",
    "flowing_layer",
    "folded_lifter",
    "free_surface",
    "frequency_spectrum",
    "impact_rates",
    "impacts",
    "knocking_and_rubbing",
    "lacey",
    "mean_overlap_ratio",
    "mean_position_index",
    "memory_of_places",
    "mixed_in_a_turn",
    "mixing",
    "mixing_curve",
    "mixing_rate",
    "occupancy",
    "openness",
    "peak_factor",
    "radial_segregation",
    "received_spread",
    "recorded_fields",
    "recorded_visits",
    "regime",
    "relative_deviation",
    "shape_factor",
    "sticking",
    "sum_rule",
    "turning_force",
    "unbalance",
    "unbalance_vectors",
    "unlike_contacts",
    "wall_slip",
    "washing",
    "wear",
    "wear_of_parts",
    "worn_outline",
    "zone_visits",
]
