"""Sections on the load in the drum: its shape, its fields, how it flows, flies, lands and goes round; its regime."""

import math
from dataclasses import asdict
from typing import TYPE_CHECKING

import numpy as np

from drumrs import measures
from drumrs.measures.frame_window import counter_clockwise
from drumrs.reports.content import Picture, Play, Table, measured, value

if TYPE_CHECKING:
    from collections.abc import Iterator

    import polars as pl
    from matplotlib.figure import Figure

    from drumrs.reports.content import Block
    from drumrs.reports.run_data import RunData

# Frames no further apart than this share of the shortest flight see nearly all.
_FINE = 0.4
# Half the width of the zone of a spray, over the drum's radius.
_SPRAY = 0.25
_MIRROR = "of a drum that turns counter-clockwise; one that turns the other way is shown in the mirror."


def motion(_: "RunData") -> "Iterator[Block]":
    """Write the player."""
    yield Play()


def shape(of: "RunData") -> "Iterator[Block]":
    """Write where the charge lies: toe, shoulder, slope, filling."""
    yield measured(of.charge, f"Angles are counter-clockwise from the horizontal, {_MIRROR}")
    if of.other_way is not None:
        start, end = of.other_way
        yield measured(
            measures.charge(of.frames, of.other_way),
            f"The same while the drum turns the other way, t = {start:.3g} to {end:.3g} s.",
        )


def flow(of: "RunData") -> "Iterator[Block]":
    """Draw where the load is, and how it moves."""
    from drumrs import figures

    found = of.fields

    def draw() -> "Figure":
        return figures.flow(found, of.frames.drum_radius)

    yield Picture(
        "Where the load is, and how it moves",
        f"Mean solid fraction and velocity, coarse-grained over {found.width:.3g} m, {_MIRROR}"
        + (" Summed up over the window." if of.sums_fields else ""),
        draw,
    )
    if not of.sums_fields:
        return

    def draw_stress() -> "Figure":
        return figures.stress(found, of.frames.drum_radius)

    yield Picture(
        "What the load bears",
        "Mean pressure, of contacts and of what the load trembles. The arms of a cross are its principal stresses over "
        "the pressure: the longer one is the way forces go.",
        draw_stress,
    )


def layer(of: "RunData") -> "Iterator[Block]":
    """Write how thick and fast the layer is that flows down the bed."""
    yield measured(
        measures.flowing_layer(of.frames, of.span),
        "On the line through the axis normal to the bed’s surface. They mean little for a load that is thrown.",
    )


def regime(of: "RunData") -> "Iterator[Block]":
    """Write the regime, and the numbers that decide."""
    found = measures.regime(of.frames, of.span, gravity=of.gravity, surface=of.surface)
    yield f"The load is {found.name}, by the first of the limits in docs/measures/regimes.md that holds."
    numbers = [
        (name.replace("_", " ").replace("froude", "Froude"), value(one))
        for name, one in asdict(found).items()
        if isinstance(one, float)
    ]
    yield Table(("what decides", "value"), numbers)


def flight(of: "RunData") -> "Iterator[Block]":
    """Write how much of the load flies and falls, and where it lands."""
    from drumrs import figures

    yield measured(measures.flight(of.frames, of.span, of.masses, of.gravity), _frames_for_flights(of))
    falls = of.flights.filter("is_fall")
    if falls.is_empty():
        yield "No disc falls."
        return

    def draw() -> "Figure":
        return figures.landing_rose(falls, of.masses)

    yield Picture(
        "Where falls land",
        f"Shares of the energy of {falls.height} falls, by the angle of landing, {_MIRROR}",
        draw,
    )


def _frames_for_flights(of: "RunData") -> str:
    """Say how fine frames should be, where flights are missed between them."""
    least = math.sqrt(float(of.frames.radii.mean()) / of.gravity) if of.gravity else math.inf
    apart = of.config.run.frame_every
    if apart <= _FINE * least:
        return ""
    return (
        f"Flights are seen in frames, {apart:.3g} s apart: shorter ones than twice that are missed. "
        f"For all that last {value(least, digits=2)} s, set run.frame_every to {value(_FINE * least, digits=1)} s or "
        "less."
    )


def circulation(of: "RunData") -> "Iterator[Block]":
    """Write how often discs go round."""
    center = measures.center_of_circulation(of.fields)
    rounds = measures.circulation(of.frames, of.span, center)
    yield measured(
        {"circulation": rounds},
        f"The center of circulation lies at x = {value(center[0], digits=3)} m, y = {value(center[1], digits=3)} m. "
        "Every round brings a disc to the surface once.",
    )


def visits(of: "RunData") -> "Iterator[Block]":
    """Write how often and how alike discs come to the zones of the run, or else to the middle of the bed's surface."""
    table = of.result.zone_visits
    if table is not None:
        for zone in table["zone"].unique(maintain_order=True):
            yield _recorded_visits(table.filter(zone=zone), zone, of.window[1] - of.window[0])
        return
    seen = counter_clockwise(of.frames)
    surface, diameter = of.surface, 2.0 * float(of.frames.radii.mean())
    middle = np.abs(surface.along) <= _SPRAY * surface.drum_radius
    line, up = (
        surface.points()[middle],
        diameter * np.array([-math.sin(surface.tilt), math.cos(surface.tilt)]),
    )
    found = measures.zone_visits(seen, of.span, np.concatenate([line + up, (line - 1.5 * up)[::-1]]))
    where = (
        f"The zone is the middle of the bed’s surface, {2.0 * _SPRAY * surface.drum_radius:.3g} m wide, and one and a "
        "half diameters deep; one of your own is a table [[run.zone]]."
    )
    yield _visits(found, where)


def _recorded_visits(table: "pl.DataFrame", zone: str, time: float) -> Table:
    """Return a table of the visits to a zone that were counted in some time [s]."""
    found, entries = measures.recorded_visits(table, zone), float(table["entries"].to_numpy().mean())
    inside = table["time_inside"].to_numpy()
    spread = float(inside.std(ddof=1) / inside.mean()) if len(inside) > 1 else math.nan
    return Table(
        ("", "value"),
        [
            ("visits of a disc in a minute", value(60.0 * entries / time)),
            ("time of a visit [s]", value(float(inside.mean()) / entries)),
            (f"discs that did not come in {time:.3g} s [%]", value(100.0 * float((inside == 0.0).mean()))),
            (f"spread of the time in the zone after {time:.3g} s, counted [%]", value(100.0 * spread)),
            *(
                (
                    f"after {name}, by one over the root of the time [%]",
                    value(100.0 * spread * math.sqrt(time / long)),
                )
                for name, long in (("a minute", 60.0), ("an hour", 3600.0))
            ),
            (f"after {time:.3g} s, were all visits chance alike [%]", value(100.0 * found.spread(time))),
        ],
        f"The zone is {zone!r} of run.zone; counted over {time:.3g} s. Spread: standard "
        "deviation over discs, over the mean, as the motion alone makes it. The last row is reckoned from the "
        f"{found.count} visits that another one followed: where it is below what was counted, discs that seldom come "
        "stay so, or the time is short for their cycles.",
    )


def _visits(found: "measures.Visits", where: str) -> Table:
    """Return a table of visits to a zone."""
    return Table(
        ("", "value"),
        [
            ("visits of a disc in a minute", value(60.0 / found.cycle)),
            ("time of a visit [s]", value(found.residence)),
            ("time from visit to visit [s]", value(found.cycle)),
            *(
                (f"spread of the time in the zone after {name} [%]", value(100.0 * found.spread(time)))
                for name, time in (("a minute", 60.0), ("an hour", 3600.0))
            ),
        ],
        f"{where} From {found.count} visits that another one followed. Spread: standard deviation over "
        "discs, over the mean, as the motion alone makes it; it falls as one over the root of the time.",
    )
