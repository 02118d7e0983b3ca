"""The configuration as the compiled core reads it: radius for diameter, rad/s for rpm, radians for degrees."""

import math
from typing import TYPE_CHECKING, Any

from drumrs.config.laws import laws
from drumrs.config.types import DRUM

if TYPE_CHECKING:
    from collections.abc import Iterator

    from drumrs.config.contact import Contact, LinearContact
    from drumrs.config.drum_tables import Drum
    from drumrs.config.load import Load
    from drumrs.config.tables import Rotation, Run, Tables


def core_config(config: "Tables", bundle_count: int) -> dict[str, Any]:
    """Return the tree of the core's `SimulationConfig`; every field is given, for defaults live here."""
    return {
        "drum": _drum(config.drum, chord_error(config.load)),
        "rotation": {"knots": _knots(config.rotation)},
        "load": _load(config.load, bundle_count),
        "contact": _contact(config.contact, config.load),
        "gravity": list(config.plane_gravity),
        "run": _run(config.run),
    }


def _drum(drum: "Drum", chord_error: float) -> dict[str, Any]:
    baffles = drum.baffles.model_dump()
    own = {"name": "baffle", **baffles, "phase": math.radians(drum.baffles.phase)}
    return {
        "radius": drum.diameter / 2.0 if drum.rim else None,
        "shell": drum.shell.points if drum.shell else None,
        "baffles": [{**one, "chord_error": chord_error} for one in (own, *_lifters(drum))],
        "walls": drum.walls,
    }


def _lifters(drum: "Drum") -> "Iterator[dict[str, Any]]":
    """List the sets of lifters that a liner has beside the shell."""
    # The keys of other shapes do not count.
    shape = {"shape": "outline", "height": 1.0, "base": 1.0, "tip": 0.0, "corner_radius": 0.0}
    for one in drum.liner.outlines:
        if one is not drum.shell:
            yield {**shape, "name": one.name, "count": drum.liner.repeat, "points": one.points, "phase": 0.0}
    rail = drum.liner.rail
    if rail.count:
        turned = {"count": rail.count, "phase": math.radians(rail.phase)}
        yield {**shape, "name": "rail", "points": rail.outline(drum.diameter / 2.0), **turned}


def chord_error(load: "Load") -> float:
    """Return how far a chord may be from the curve it stands for [m]: 1/50 of the radius of the smallest bundle."""
    return min(_diameters(load), default=load.diameter) / 100.0


def _diameters(load: "Load") -> "Iterator[float]":
    """List the least diameters that species are given [m]."""
    for own in load.species or ():
        if own.sizes is None:
            yield own.diameter or load.diameter
        else:
            yield from (one for one in (*(own.sizes.diameters or ()), own.sizes.smallest) if one)


def _load(load: "Load", bundle_count: int) -> dict[str, Any]:
    return {
        "count": bundle_count,
        "diameter": load.diameter,
        "density": load.wet(load.density),
        "species": load.species_to_core(),
        "share_by": load.share_by or "number",
        "start_speed": load.start_speed,
        "spin_locked": load.spin_locked,
    }


def _contact(contact: "Contact", load: "Load") -> dict[str, Any]:

    def table(law: "LinearContact") -> dict[str, Any]:
        return {"base": contact.base, **law.model_dump()}

    pairs: list[dict[str, Any]] = []
    walls: list[dict[str, Any]] = []
    for law in laws(load, contact):
        one, other = law.between
        values = {"key": law.key, "parameters": table(law.table)}
        if other == DRUM:
            walls.append({"species": load.names.index(one), **values})
        else:
            pairs.append({"between": [load.names.index(one), load.names.index(other)], **values})
    return {
        "bundle": table(contact.bundle),
        "drum": table(contact.drum),
        "species": max(len(load.names), 1),
        "pairs": pairs,
        "walls": walls,
    }


def _knots(rotation: "Rotation") -> list[tuple[float, float]]:
    return [(time, rpm * 2.0 * math.pi / 60.0) for time, rpm in rotation.knots]


def _run(run: "Run") -> dict[str, Any]:
    return {
        "time_step": None if run.time_step == "auto" else run.time_step,
        "sample_every": run.sample_every,
        "frame_every": run.frame_every,
        "skin": None if run.skin == "auto" else run.skin,
        "record": run.record,
        "contact_floor": run.contact_floor,
        "arc_bin": run.arc_bin,
        "cell": run.cell,
        "zones": [zone.model_dump() for zone in run.zone or ()],
        "sums_from": run.averaging_window[0],
        "overlap_limit": run.overlap_limit,
    }
