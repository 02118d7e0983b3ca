"""How pictures and statistics add up the energies of contacts, and which of them they show."""

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from drumrs.registry import quantity

Array = NDArray[np.float64]

# What every run loses; the others are shown where they are not zero.
_ALWAYS = ("dissipated_normal", "dissipated_sliding")


def losses(names: Iterable[str]) -> list[str]:
    """Return the columns of losses among some names."""
    return [name for name in names if name.startswith("dissipated_")]


def powers_to_show(columns: Mapping[str, Array]) -> dict[str, str]:
    """Return the cumulative energies whose powers a picture of a run shows, the drum's first, with their titles."""
    shown = [name for name in losses(columns) if name in _ALWAYS or np.any(columns[name])]
    return {name: quantity(name).title.removesuffix(" work") for name in ("drum_work", *shown)}


def energies_to_show(columns: Mapping[str, Array]) -> dict[str, Array]:
    """Return the stored energies that a picture of a run shows, by title, for a logarithmic axis.

    All springs are added up. The energy of adhesion, if there is any, is below zero while bodies touch, and is given
    with its sign turned.
    """
    shown = {quantity(name).title: columns[name] for name in ("kinetic_translation", "kinetic_rotation")}
    shown["elastic"] = np.sum([columns[name] for name in columns if name.startswith("elastic_")], axis=0)
    if "adhesion" in columns and np.any(columns["adhesion"]):
        shown["adhesion (−)"] = -columns["adhesion"]
    return shown
