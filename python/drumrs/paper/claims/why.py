"""Why claims fail where they do: a paragraph each, its numbers taken from the study."""

import numpy as np

from drumrs.paper.cases import SIZE_FILL, THIRDS, percent
from drumrs.paper.curves import Curve, Results
from drumrs.paper.verdict import MissingError

_POWER = "drum_specific_power"
_NORMAL, _SLIDING = "dissipated_normal_specific_power", "dissipated_sliding_specific_power"


def baffles_fill_the_drum(results: Results) -> str:
    """Say for C2 and C13 how much of the difference above 50 % fill is the room that baffles take.

    Raises
    ------
    MissingError
        Where a drum has no fill above 50 %, or the bare one none as full as the other's free area.
    """
    bare, baffled = (results.curve("fill", "drum_power", drum=drum) for drum in results.drums)
    at = float(baffled.above(0.5).between(high=bare.x[-1]).x[-1])
    share = results.baffled.baffles_share
    as_full = at / (1.0 - share)
    if as_full > bare.x[-1]:
        raise MissingError(f"{bare.label} at {percent(as_full)}")
    power, same_count = baffled.at(at).mean, bare.at(at).mean
    same_room = float(np.interp(as_full, bare.x, [one.mean for one in bare.estimates]))
    return (
        f"Baffles take {100.0 * share:.1f} % of the drum’s area. At {percent(at)} fill, which counts the bare drum, "
        f"{100.0 * as_full:.0f} % of what they leave free is full. The drum with baffles then draws {power:.0f} "
        f"W/m, the "
        f"bare one with as many bundles {same_count:.0f} W/m, and the bare one as full, at {100.0 * as_full:.0f} %, "
        f"{same_room:.0f} W/m: to compare at equal room changes the difference from {power - same_count:+.0f} to "
        f"{power - same_room:+.0f} W/m."
    )


def baffles_keep_their_size(results: Results) -> str:
    """Say for C7 what else changes where bundles are smaller and baffles are not.

    Raises
    ------
    MissingError
        Where there are fewer than two sizes with baffles.
    """
    curve = results.curve("size", _POWER, drum=results.baffled).between(least=2)
    drum = results.baffled.config().drum
    first, last = (float(x) for x in curve.x[[0, -1]])
    heights = [drum.baffles.height / (drum.diameter / ratio) for ratio in (first, last)]
    return (
        f"The baffles keep their size: {heights[0]:.1f} bundle diameters high at D/d = {first:g}, and "
        f"{heights[1]:.1f} at "
        f"{last:g}. So with baffles it is not the bundles alone that change against the drum: at "
        f"{percent(SIZE_FILL)} fill "
        f"specific power goes from {curve.at(first).mean:.2f} to {curve.at(last).mean:.2f} W/kg."
    )


def thin_loads_slide(results: Results) -> str:
    """Say for C4 and C6 which of N and T it is that changes with fill in the bare drum, up to 40 %.

    Raises
    ------
    MissingError
        Where there are fewer than two fills up to 40 %.
    """
    sliding, normal, turning = (
        results.curve("fill", column).between(high=0.4, least=2)
        for column in (_SLIDING, _NORMAL, "specific_angular_momentum")
    )
    first, last = (float(x) for x in sliding.x[[0, -1]])
    return (
        f"From {percent(first)} to {percent(last)} fill of the bare drum sliding goes from {_from_to(sliding)} W/kg, "
        f"normal damping from {_from_to(normal)} W/kg, and the angular momentum of a kilogram, which says how far the "
        f"drum takes the load along, from {_from_to(turning, 3)} m²/s."
    )


def _from_to(curve: Curve, digits: int = 2) -> str:
    means = [one.mean for one in curve.estimates]
    return f"{means[0]:.{digits}f} to {means[-1]:.{digits}f}"


def damping_goes_on_growing(results: Results) -> str:
    """Say for C8 what becomes of N and T from μ = 0.3 on, fill by fill.

    Raises
    ------
    MissingError
        Where a fill has fewer than two frictions from 0.3 on.
    """
    told = []
    for fill in THIRDS:
        normal, sliding = (
            results.curve("friction", column, fill=fill).between(0.3, least=2)
            for column in (_NORMAL, _SLIDING)
        )
        told.append(f"{_from_to(normal)} and {_from_to(sliding)} W/kg at {percent(fill)} fill")
    return (
        "From μ = 0.3 on, what normal damping takes and what sliding takes go from "
        f"{', '.join(told[:-1])}, and {told[-1]}: power is constant where what one gains the other loses."
    )


def sliding_is_compared_with_little(results: Results) -> str:
    """Say for C9 that what sliding takes at small friction is alike at all fills, and the usual power is not.

    Raises
    ------
    MissingError
        Where a fill has no small friction above 0.
    """
    taken, usual = [], []
    for fill in THIRDS:
        curve = results.curve("friction", _SLIDING, fill=fill).above(0.0)
        taken.append((float(curve.x[0]), curve.estimates[0].mean))
        usual.append(results.usual(_POWER, fill))
    names = ", ".join(percent(fill) for fill in THIRDS[:-1]) + f" and {percent(THIRDS[-1])}"
    return (
        f"At μ = {taken[0][0]:g} the drum slides under a load that stays where it is, and takes "
        f"{_listed([one for _, one in taken])} W/kg at {names} fill. The usual power, with which that is compared, is "
        f"{_listed(usual)} W/kg: a drum nearly full leaves its load little to do at μ = 0.5, so that as much "
        "sliding is a greater part of it."
    )


def _listed(values: list[float]) -> str:
    told = [f"{value:.2f}" for value in values]
    return f"{', '.join(told[:-1])} and {told[-1]}"


def ratio_turns_at_the_last_step(results: Results) -> str:
    """Say for C10 by what N/T changes from the last friction but one to the last, at 75 % fill.

    Raises
    ------
    MissingError
        Where there are fewer than two frictions.
    """
    fill = max(THIRDS)
    ratio = results.curve("friction", results.ratio, fill=fill).between(least=2)
    before, after = (float(x) for x in ratio.x[-2:])
    changes = {
        name: _change(results.curve("friction", column, fill=fill), before, after)
        for name, column in (("normal damping", _NORMAL), ("sliding", _SLIDING))
    }
    told = " and ".join(f"what {name} takes changes by {100.0 * one:+.0f} %" for name, one in changes.items())
    more = max(changes, key=lambda name: abs(changes[name]))
    return (
        f"From μ = {before:g} to {after:g} at {percent(fill)} fill N/T goes from {ratio.at(before).mean:.2f} to "
        f"{ratio.at(after).mean:.2f}: {told}. It is {more} that changes more."
    )


def _change(curve: Curve, before: float, after: float) -> float:
    return curve.at(after).mean / curve.at(before).mean - 1.0
