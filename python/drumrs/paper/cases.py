"""Every case of every figure, each once; and what they cost."""

import math
from collections.abc import Iterable, Iterator
from typing import Any

from drumrs.config import Config, baseline
from drumrs.paper.drums import BAFFLED, BARE, TRIANGLES
from drumrs.paper.scales import Scale, scale_of

# Fills of the figures of friction, and of the snapshots.
THIRDS = (0.25, 0.50, 0.75)
# Fill at which the size of bundles varies, and that at which speed and restitution do.
SIZE_FILL = 0.40
BASELINE_FILL = 0.25
# Frictions between which power is claimed to be constant.
END_FRICTIONS = (0.3, 1.0)
# Fills of the bare drum at which the load passes between two states, and which are run for longer.
HALF_FULL = (0.45, 0.50, 0.55)
# Cases whose motion is looked at, bundle by bundle: the snapshots', and one more above 50 %.
WATCHED_FILLS = (0.25, 0.50, 0.60, 0.75)

# The step of the paper's Table 1 [s].
TIME_STEP = 3.70e-6

# Means are exact for any sampling, and block errors the same as from samples ten times as dense.
_SAMPLE_EVERY = 0.02
# A thirtieth of a turn.
_FRAME_EVERY = 0.04


def cases(scale: str | Scale = "default") -> list[Config]:
    """Return every case of the study; what several figures share is one case.

    Parameters
    ----------
    scale
        ``"quick"``, ``"default"``, ``"full"``, or a scale of your own.

    Returns
    -------
    list of Config
        Figure by figure, seed by seed, without duplicates.

    Raises
    ------
    ConfigError
        Where there is no such scale.

    Examples
    --------
    >>> from drumrs import paper
    >>> quick = paper.cases("quick")
    >>> {config.run.seed for config in quick} >= set(paper.SCALES["quick"].seeds)
    True
    >>> len({config.digest for config in quick}) == len(quick)
    True
    """
    scale = scale_of(scale)
    # The paper's N/T counts what springs take and give back.
    always = {"sample_every": _SAMPLE_EVERY, "record": ["gross_work"]}
    half_full = [BARE.config(fill) for fill in HALF_FULL] if scale.half_full_seeds else []
    ends = list(_ends(scale)) if scale.end_seeds else []
    # Frames follow each other closely where the motion is looked at; elsewhere there are the first and the last.
    drums = (BARE, BAFFLED, TRIANGLES) if scale.softer == 1.0 else ()
    watched = [drum.config(fill) for drum in drums for fill in WATCHED_FILLS]
    found: dict[str, Config] = {}
    for point in _points(scale):
        seeds, duration, end = scale.seeds, scale.duration, scale.window[1]
        if point in half_full:
            seeds = scale.half_full_seeds
            duration = end = scale.half_full_duration
        elif point in ends:
            seeds = scale.end_seeds
            duration = end = scale.end_duration
        run = {**always, "duration": duration, "window": (scale.window[0], end)}
        run["frame_every"] = _FRAME_EVERY if point in watched else scale.duration
        cheaper = _cheaper(point, scale)
        for seed in seeds:
            config = cheaper.replace({"run": {**run, "seed": seed}})
            found.setdefault(config.digest, config)
    beside = cases(scale.beside) if scale.beside else []
    return [*found.values(), *beside]


def _cheaper(point: Config, scale: Scale) -> Config:
    softer = point.softer(scale.softer) if scale.softer > 1.0 else point
    return softer.replace({"run.time_step": scale.coarser * float(softer.run.time_step)})


def cost(configs: Iterable[Config]) -> int:
    """Return what the cases cost, in particle-steps: bundles times steps.

    Examples
    --------
    >>> from drumrs import baseline, paper
    >>> paper.cost([baseline(fill=0.25)])
    810810900
    """
    return sum(
        config.bundle_count * math.ceil(config.run.duration / config.derived.time_step) for config in configs
    )


def _points(scale: Scale) -> Iterator[Config]:
    for drum, fills in (
        (BARE, scale.fills),
        (BAFFLED, scale.fills_with_baffles),
        (TRIANGLES, scale.fills_with_triangles),
    ):
        for fill in fills:
            yield drum.config(fill)
    for drum, sizes in ((BARE, scale.sizes), (BAFFLED, scale.sizes), (TRIANGLES, scale.sizes_with_triangles)):
        for ratio in sizes:
            yield drum.config(SIZE_FILL).replace(_size(ratio))
    for fill in THIRDS:
        for friction in scale.frictions:
            yield BARE.config(fill).replace(_of_both("friction", friction))
    for drum in (BARE, BAFFLED):
        at = drum.config(BASELINE_FILL)
        for rpm in scale.speeds:
            yield at.replace({"rotation.rpm": rpm})
        for restitution in scale.restitutions:
            yield at.replace(_of_both("restitution", restitution))


def _ends(scale: Scale) -> Iterator[Config]:
    """Points at ends of curves that decide a claim alone and vary much from seed to seed, most of few bundles."""
    for drum in (BARE, BAFFLED):
        yield drum.config(min(scale.fills))
        if scale.sizes:
            yield drum.config(SIZE_FILL).replace(_size(min(scale.sizes)))
    for friction in END_FRICTIONS:
        yield BARE.config(BASELINE_FILL).replace(_of_both("friction", friction))


def _size(ratio: float) -> dict[str, Any]:
    """Return the changes for another D/d at the same drum, stiffness and restitution.

    The contact time goes with the root of the mass, and so with d: the time step follows it.
    """
    table = baseline()
    own = table.drum.diameter / table.load.diameter
    return {"load.diameter": table.drum.diameter / ratio, "run.time_step": TIME_STEP * (own / ratio)}


def _of_both(key: str, value: float) -> dict[str, float]:
    return {f"contact.bundle.{key}": value, f"contact.drum.{key}": value}


def percent(fill: float) -> str:
    """Name a fill as figures do."""
    return f"{100.0 * fill:.4g} %"
