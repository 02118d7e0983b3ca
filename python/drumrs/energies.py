"""Columns of the energies that contacts take and hold, and how pictures and statistics add them up."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# What takes energy, in words. A run without rolling resistance or tangential dashpot has none of the latter two.
LOSSES = MappingProxyType(
    {
        "dissipated_normal": "normal damping",
        "dissipated_sliding": "sliding",
        "dissipated_tangential": "tangential damping",
        "dissipated_rolling": "rolling",
    }
)
_ALWAYS = ("dissipated_normal", "dissipated_sliding")
_SPRINGS = ("elastic_normal", "elastic_tangential", "elastic_rolling")


def losses(names: Iterable[str]) -> list[str]:
    """Return the columns of losses among some names."""
    known = set(names)
    return [name for name in LOSSES if name in known]


def shown_losses(columns: Mapping[str, Array]) -> dict[str, str]:
    """Return the columns of losses to be shown, with their words: the base law's, and any that are not zero."""
    return {name: LOSSES[name] for name in losses(columns) if name in _ALWAYS or np.any(columns[name])}


def held_by_contacts(columns: Mapping[str, Array]) -> dict[str, Array]:
    """Return what contacts hold, for a logarithmic axis: all springs together, and what adhesion lacks, if any.

    The energy of adhesion is below zero while bodies touch, and is given with its sign turned.
    """
    springs = np.sum([columns[name] for name in _SPRINGS if name in columns], axis=0)
    held = {"contacts": springs}
    if "adhesion" in columns and np.any(columns["adhesion"]):
        held["adhesion (−)"] = -columns["adhesion"]
    return held
