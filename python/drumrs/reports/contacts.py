"""Sections on what contacts do: collisions, wear of the drum, who takes which energy."""

import math
from typing import TYPE_CHECKING

from drumrs import measures
from drumrs.analysis import rate_with_error
from drumrs.measures.recorded import required
from drumrs.reports.content import Picture, Table, value

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy as np
    import polars as pl
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from drumrs.reports.content import Block
    from drumrs.reports.run_data import RunData

_WEAR = {"archard": "sliding wear (Archard)", "finnie": "impact wear (Finnie)"}


def collisions(of: "RunData") -> "Iterator[Block]":
    """Write how often collisions take which energy."""
    from drumrs import figures

    contacts, time = of.result.contacts, of.config.derived.bundle.collision_time
    hits, lasting = measures.impacts(contacts, time), measures.enduring(contacts, time)
    spectra = {
        name: measures.collision_spectrum(table, of.mass, of.duration, kind)
        for name, table, kind in (
            ("impacts, normal", hits, "normal"),
            ("impacts, tangential", hits, "tangential"),
            ("enduring, all", lasting, "total"),
        )
    }
    yield Table(
        ("", "collisions [1/(kg s)]", "power [W/kg]", "half of it above [J/m]"),
        [
            (
                name,
                value(float(rows["rate"].sum())),
                value(float(rows["power"].sum())),
                value(_half(rows)),
            )
            for name, rows in spectra.items()
        ],
        f"Impacts are over within three collision times, {1e3 * 3.0 * time:.3g} ms; enduring contacts lie, roll and "
        "slide. From t = 0 on.",
    )
    if all(rows.is_empty() for rows in spectra.values()):
        return

    def draw() -> "Figure":
        return figures.collision_spectrum(spectra)

    yield Picture(
        "Spectrum of collision energies",
        "Left: how often, per kilogram of load and second, in ten bins a decade. Right: the share of each kind’s power "
        "that collisions above an energy take.",
        draw,
    )
    yield (
        "Discs coarser by a factor k than the bodies they stand for meet 1/k² as often with k² the energy: this is no "
        "spectrum of smaller balls."
    )


def _kind(column: str) -> "pl.Expr":
    """Return what kind of part a column names: its parts of a drum without their numbers."""
    import polars as pl

    return pl.col(column).cast(pl.String).str.replace(r" \d+$", "").alias("kind")


def _half(spectrum: "pl.DataFrame") -> float | None:
    """Return the energy above which half of the power is taken, at the edge of a bin."""
    above = spectrum.filter(spectrum["share_above"] >= 0.5)  # noqa: PLR2004 - half
    return None if above.is_empty() else float(above["energy_low"][-1])


def wear(of: "RunData") -> "Iterator[Block]":
    """Write where the drum wears, as shares: amounts need a coefficient that somebody has measured."""
    import polars as pl

    from drumrs import figures

    profile = required(of.result.wall_profile, "wall_profile", "wear along the outline")
    shown = measures.exposed(profile)
    worn = {law: measures.wear(shown, law, turns=max(of.turns, 1e-9)) for law in _WEAR}
    length = (pl.col("arc_end") - pl.col("arc_start")).sum()
    tables = {
        law: rows.group_by(_kind("part"), maintain_order=True).agg(
            volume=pl.col("wear_volume").sum(), length=length, greatest=pl.col("relative_wear").max()
        )
        for law, rows in worn.items()
    }
    rows = []
    for place, name in enumerate(tables["archard"]["kind"]):
        cells = [name]
        for table in tables.values():
            whole = float(table["volume"].sum()) or 1.0
            cells += [
                f"{100.0 * float(table['volume'][place]) / whole:.1f}",
                value(float(table["greatest"][place])),
            ]
        rows.append(cells)
    yield Table(
        ("part", "sliding: share [%]", "greatest", "impact: share [%]", "greatest"),
        rows,
        "Sliding wear is Archard’s, impact wear Finnie’s. Greatest: the depth in the bin that wears most, over the "
        "mean along all of the outline that the load can touch. An amount needs a coefficient of wear that somebody "
        "has measured; the shape does not.",
    )
    speed = of.config.derived.angular_velocity
    way = "counter-clockwise" if speed is None or speed > 0.0 else "clockwise"
    for law, label in _WEAR.items():
        shown = worn[law]
        if not float(shown["wear_volume"].sum()):
            continue

        def draw(shown: "pl.DataFrame" = shown, label: str = label) -> "Figure":
            return figures.wall_profile(
                shown, "relative_wear", f"{label} over its mean", clockwise=way == "clockwise"
            )

        yield Picture(
            label[0].upper() + label[1:],
            "Depth of wear over its mean along the whole outline. Left: the drum in its own frame, the color of the "
            "2 % that wear most being that of the rest’s greatest; lifters that are alike are drawn large as their "
            "mean, with an arrow for the way they go. Right: along the outline of the parts, unrolled over one lifter "
            f"where they are alike, of a drum that turns {way}; line: mean, band: least and greatest.",
            draw,
        )


def split(of: "RunData") -> "Iterator[Block]":
    """Write which pairs of species and parts take the energy."""
    import polars as pl

    table = required(of.result.ledger_split, "ledger_split", "who takes the energy")
    columns = [name for name in table.columns if name.startswith("dissipated_")]
    whole = math.fsum(float(table[name].sum()) for name in columns) or 1.0
    bodies = (pl.col("body"), _kind("other"))
    rows = [
        (f"{row['body']} – {row['kind']}", *(f"{100.0 * row[name] / whole:.2f}" for name in columns))
        for row in table.group_by(*bodies, maintain_order=True)
        .agg(pl.col(columns).sum())
        .iter_rows(named=True)
        if any(row[name] for name in columns)
    ]
    heads = [name.removeprefix("dissipated_") for name in columns]
    heads[columns.index("dissipated_tangential")] = "tangential dashpot"
    yield Table(("between", *(f"{head} [%]" for head in heads)), rows, "Shares of all that contacts took.")


def discs(of: "RunData") -> "Iterator[Block]":
    """Write how much discs differ in what they receive and how they fall."""
    import polars as pl

    table = required(of.result.discs, "discs", "what each disc received")
    energy = pl.sum_horizontal(name for name in table.columns if name.startswith("received_"))
    taken = table.with_columns(
        power=energy / pl.col("mass") / of.duration, aloft=100.0 * pl.col("flight_time") / of.duration
    )
    rows = [
        (
            str(name),
            str(own.height),
            *(
                _with_spread(own[column].to_numpy())
                for column in ("power", "falls", "drum_landings", "load_landings", "aloft")
            ),
        )
        for (name,), own in taken.group_by("species", maintain_order=True)
    ]
    heads = ("received [W/kg]", "falls", "landings on the drum", "on the load", "in flight [%]")
    yield Table(
        ("species", "discs", *heads),
        rows,
        "Mean over discs, and their standard deviation over it: how much they differ. From t = 0 on.",
    )


def _with_spread(values: "NDArray[np.number]") -> str:
    mean = float(values.mean())
    return f"{value(mean)} ± {100.0 * float(values.std()) / mean:.0f} %" if mean else "0"


def handling(of: "RunData") -> "Iterator[Block]":
    """Write how hard the load is knocked and rubbed, by itself and by the drum."""
    knocking, *rubbing = (
        rate_with_error(of.result.series, f"dissipated_{kind}", of.window)
        for kind in ("normal", "sliding", "tangential")
    )
    rubs = sum(one.value for one in rubbing) / of.mass
    yield Table(
        ("in the window", "knocking [W/kg]", "rubbing [W/kg]"),
        [
            (
                "all",
                value(knocking.value / of.mass, knocking.error and knocking.error / of.mass),
                # Errors of rates that go together add up at most.
                value(rubs, sum(one.error or 0.0 for one in rubbing) / of.mass),
            )
        ],
        "Knocking is what normal damping takes, rubbing what sliding and tangential damping take.",
    )
    found = measures.knocking_and_rubbing(of.result.ledger_split, of.mass, of.duration)
    names = {"load": "among the load", "drum": "with the drum"}
    yield Table(
        ("from t = 0 on", "knocking [W/kg]", "rubbing [W/kg]"),
        [(names[name], value(knocks), value(rubs)) for name, (knocks, rubs) in found.items()],
    )
    yield (
        "They are mechanical action. For what fabric or tablets suffer they stand only once they are fitted to loss of "
        "threads, to fraying or to attrition; soil removal is another thing."
    )
