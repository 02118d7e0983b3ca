"""What designers of rotating drums measure: pure functions on frames and tables, one short module for each family.

`motion`, `depth` and `bed` look at the load as a whole, `neighbors` at how it mixes, `profile` at the flowing layer,
`toe` at the ends of the charge. Statistics are those of `drumrs.analysis`; nothing here sees a simulation.
"""

from drumrs.measures.bed import bulk_fill
from drumrs.measures.charge import Occupancy, charge, occupancy
from drumrs.measures.depth import depth_profile
from drumrs.measures.motion import along_the_rim, carried_round
from drumrs.measures.neighbors import mixed_in_a_turn, mixing
from drumrs.measures.surface import FreeSurface, free_surface

__all__ = [
    "FreeSurface",
    "Occupancy",
    "along_the_rim",
    "bulk_fill",
    "carried_round",
    "charge",
    "depth_profile",
    "free_surface",
    "mixed_in_a_turn",
    "mixing",
    "occupancy",
]
