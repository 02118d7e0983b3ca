"""Presets of species by name: density and contact keys of materials, each number with its source in presets.toml."""

import difflib
import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from drumrs.config.messages import conflict


def presets_toml() -> str:
    """Return the text of the presets: TOML in which each number has its source beside it."""
    return files("drumrs.config").joinpath("presets.toml").read_text(encoding="utf-8")


@cache
def presets() -> dict[str, dict[str, Any]]:
    """Return the presets of species: keys of a table of ``load.species`` by name.

    Examples
    --------
    >>> from drumrs.config import presets
    >>> presets()["steel-ball"]["density"]
    7850.0
    """
    return tomllib.loads(presets_toml())


def with_preset(species: Any) -> Any:
    """Return the keys of a species with those of the preset that it names, unless they are given beside it.

    Raises
    ------
    PydanticCustomError
        Where there is no such preset.
    """
    if not isinstance(species, Mapping) or species.get("preset") is None:
        return species
    name, known = species["preset"], presets()
    if not isinstance(name, str) or name not in known:
        close = difflib.get_close_matches(str(name), known, n=1)
        hint = f"did you mean {close[0]!r}?" if close else "drumrs config --species prints them"
        raise conflict("{at}preset", name, f"one of {', '.join(known)}", hint=hint)
    given = {key: value for key, value in species.items() if key != "preset" and value is not None}
    contact = given.get("contact", {})
    if isinstance(contact, Mapping):
        lower = known[name]["contact"]
        # What a collision loses is said once.
        lost = {"restitution"} if contact.get("normal_damping") is not None else set()
        given["contact"] = {key: lower[key] for key in lower.keys() - lost} | dict(contact)
    return known[name] | given
