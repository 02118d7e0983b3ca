"""Sections on how a load slips, opens to the air and mixes, and how far off balance it is."""

import math
from dataclasses import astuple
from typing import TYPE_CHECKING

import numpy as np

from drumrs import measures
from drumrs.analysis import Mean, mean_with_error
from drumrs.errors import ConfigError
from drumrs.measures.airborne import in_flight
from drumrs.measures.frame_window import within
from drumrs.reports.content import Picture, Table, measured, value

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.figure import Figure

    from drumrs.reports.content import Block
    from drumrs.reports.run_data import RunData

# Frames that are plenty for a curve, and for a mean of what takes long.
_POINTS, _SNAPSHOTS = 400, 16


def going_along(of: "RunData") -> "Iterator[Block]":
    """Write how the load goes with the drum: slip, riding along the rim, carried over the top."""
    yield measured(
        {
            "wall_slip": measures.wall_slip(of.frames, of.span),
            "along_the_rim": measures.along_the_rim(of.frames, of.span),
            "carried_round": measures.carried_round(of.frames, of.span),
        }
    )


def opening(of: "RunData") -> "Iterator[Block]":
    """Write how far the load opens to the air."""
    seen = within(of.frames, of.span)
    radii, reach = seen.radii, seen.reach or of.config.drum.area_diameter / 2.0
    few = seen.picked(_every(len(seen), _SNAPSHOTS))
    interval = float(np.diff(few.times).mean())
    flies = in_flight(seen, of.gravity)
    curtains = [
        measures.curtain(places[aloft], radii[aloft], reach)
        for places, aloft in zip(seen.positions, flies, strict=True)
    ]
    yield measured(
        {
            "openness": mean_with_error(
                [measures.openness(places, radii, reach / 2.0) for places in few.positions], interval
            ),
            "shape_factor": mean_with_error(
                [measures.shape_factor(places, radii) for places in few.positions], interval
            ),
            "curtain": mean_with_error(curtains, float(np.diff(seen.times).mean())),
        },
        "Air goes where the way is free. There is no air in the model, neither its drag nor its heat.",
    )


def balance(of: "RunData") -> "Iterator[Block]":
    """Write how far off balance the load is."""
    from drumrs import figures

    found = measures.unbalance(of.frames, of.span, of.masses)
    speed = of.config.derived.angular_velocity
    force = value(found["turning_unbalance"].value * speed**2, digits=3) if speed else ""
    note = f" Bearings feel {force} N/m of it that turns with the drum." if force else ""
    radius, depth = of.config.drum.area_diameter / 2.0, of.config.drum.depth
    if depth is not None:
        rim = Mean(*(part and 1e3 * part * depth / radius for part in astuple(found["unbalance"])))
        note += f" With a depth of {depth:.3g} m it is {value(rim.value, rim.error)} g at the rim."
    if of.config.rotation.phase:
        note += (
            " A load that tumbles is off balance as it lies; before a spin, see the unbalance phase by phase."
        )
    yield measured(
        found,
        f"Over the drum’s radius, {radius:.3g} m, and times its depth it is the mass at "
        f"the rim, as the trade has it.{note} To judge a distribution, run many seeds: it is a matter of chance.",
    )
    lengths = np.hypot(*measures.unbalance_vectors(of.frames, of.span, of.masses).T)

    def draw() -> "Figure":
        return figures.unbalance_histogram(lengths)

    yield Picture("Unbalance", "How often the load is how far off balance, frame by frame.", draw)


def mixing(of: "RunData") -> "Iterator[Block]":
    """Write how fast the load mixes."""
    from drumrs import figures

    few = of.frames.picked(_every(len(of.frames), _POINTS))
    species = sorted(set(few.species))
    colorings = [*measures.COLORINGS, *(species[:1] if len(species) > 1 else [])]
    curves = {by: measures.mixing_curve(few, of.span, by) for by in colorings}
    fits = {}
    for by, (turns, index) in curves.items():
        try:
            fits[by] = measures.mixing_rate(turns, index[len(index) // 2])
        except ConfigError:
            continue
    rows = [
        (
            by,
            *(value(getattr(fits[by], name)) if by in fits else "–" for name in ("rate", "end")),
            value(float(index[1, -1])),
        )
        for by, (_, index) in curves.items()
    ]
    yield Table(
        ("colored by", "rate [per turn]", "end of the fit", "index at the end"),
        rows,
        "Lacey’s index, 0 apart, 1 as mixed as chance makes it: M∞ − (M∞ − M₀) exp(−k (n − τ)) fitted to the middle of "
        "three sizes of cells. An end above 1 lies beyond this run: it is too short to tell. The first frame gives the "
        "colors: right half, upper half, inner half"
        + (f", and the species {species[0]}." if len(species) > 1 else "."),
    )

    def draw() -> "Figure":
        return figures.mixing_curve(curves, fits)

    yield Picture(
        "Mixing",
        "Index over turns since the first frame; bands: three sizes of cells; dashed: the fit.",
        draw,
    )


def _every(count: int, most: int) -> slice:
    """Return every so many frames that there are no more than enough."""
    return slice(None, None, math.ceil(count / most))
