"""The configuration as the compiled core reads it: radius for diameter, rad/s for rpm, radians for degrees."""

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from drumrs.config.tables import Contact, Drum, LinearContact, Rotation, Run, Tables


def core_config(config: "Tables", bundle_count: int) -> dict[str, Any]:
    """Return the tree of the core's `SimulationConfig`; every field is given, for defaults live here."""
    return {
        "drum": _drum(config.drum),
        "rotation": {"knots": _knots(config.rotation)},
        "load": {**config.load.model_dump(exclude={"fill"}), "count": bundle_count},
        "contact": _contact(config.contact),
        "gravity": list(config.plane_gravity),
        "run": _run(config.run),
    }


def _drum(drum: "Drum") -> dict[str, Any]:
    baffles = drum.baffles.model_dump()
    return {
        "radius": drum.diameter / 2.0 if drum.rim else None,
        "baffles": {**baffles, "phase": math.radians(drum.baffles.phase)},
        "walls": drum.walls,
    }


def _contact(contact: "Contact") -> dict[str, Any]:

    def table(law: "LinearContact") -> dict[str, Any]:
        return {"base": contact.base, **law.model_dump()}

    return {
        "bundle": table(contact.bundle),
        "drum": table(contact.drum),
        "species": contact.species,
        "pairs": [(*law.between, table(law.over(contact.bundle))) for law in contact.pairs],
        "walls": [(law.species, table(law.over(contact.drum))) for law in contact.walls],
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
        "overlap_limit": run.overlap_limit,
    }
