"""What breaks the paper's claims: changes of the world in which all hold, and where each claim then still holds."""

import polars as pl

from worlds import measures, world


def changed(column: str, value: float | pl.Expr, *conditions: pl.Expr) -> pl.DataFrame:
    """Return the table of the world in which a column is another where the conditions hold."""
    table = world()
    new = pl.col(column) * 0.0 + value if isinstance(value, float) else value
    chosen = pl.all_horizontal(*conditions) if conditions else pl.lit(value=True)
    return table.with_columns(pl.when(chosen).then(new).otherwise(pl.col(column)).alias(column))


fill, friction = pl.col("load.fill"), pl.col("contact.bundle.friction")
baffles = pl.col("drum.baffles.count") > 0
small = friction < 0.12

BASE = {"fill": 0.25, "size": 20.0, "friction": 0.5, "speed": 54.0, "restitution": 0.1}
USUAL = measures(BASE, baffles=False)["drum_specific_power"]

NOWHERE = ""
# What breaks a claim, one change each: where it still holds, in words. Where it holds nowhere, it does not hold.
BROKEN = {
    "C1": {
        "without baffles": ("drum_power", 400.0 * (1.0 - ((fill - 0.6) / 0.6) ** 2), baffles),
        NOWHERE: ("drum_power", 400.0 * (1.0 - ((fill - 0.3) / 0.6) ** 2)),
    },
    "C2": {
        "similar above 50 % fill": ("drum_power", pl.col("drum_power") * 1.2, baffles, fill < 0.5),
        "less below 50 % fill, from 25 % fill on; similar above 50 % fill": (
            "drum_power",
            pl.col("drum_power") * 1.4,
            baffles,
            fill == 0.2,
        ),
        "less below 50 % fill": ("drum_power", pl.col("drum_power") * 0.7, baffles, fill > 0.5),
        # A tenth of the greatest power is much of the power at 75 %.
        "less below 50 % fill; similar above 50 % fill, from 65 % fill on": (
            "drum_power",
            pl.col("drum_power") * pl.when(fill < 0.62).then(0.8).otherwise(0.97),
            baffles,
            fill > 0.5,
        ),
    },
    "C3": {
        "without baffles; with baffles, up to 60 % fill": ("drum_specific_power", fill, baffles, fill >= 0.6),
        "without baffles, from 60 % fill on; with baffles, from 60 % fill on": (
            "drum_specific_power",
            fill,
            fill <= 0.4,
        ),
        "without baffles, from 20 % fill on; with baffles": (
            "drum_specific_power",
            pl.col("drum_specific_power") * 1.6,
            ~baffles,
            fill == 0.2,
        ),
    },
    "C4": {
        "without baffles, from 35 % fill on; with baffles, from 35 % fill on": (
            "gross_work_ratio",
            0.6,
            fill == 0.3,
        ),
        "without baffles; with baffles, up to 65 % fill": ("gross_work_ratio", 2.5, fill == 0.7, baffles),
        "with baffles": ("gross_work_ratio", 0.5, ~baffles),
    },
    "C5": {
        "nearly constant below 60 % fill, from 15 % fill on; about 2.2 on average there; falls from 60 % fill on": (
            "gross_work_ratio",
            3.0,
            baffles,
            fill == 0.1,
        ),
        "nearly constant below 60 % fill; falls from 60 % fill on": (
            "gross_work_ratio",
            1.5,
            baffles,
            fill < 0.6,
        ),
        "nearly constant below 60 % fill; about 2.2 on average there": (
            "gross_work_ratio",
            1.0 + fill,
            baffles,
            fill >= 0.6,
        ),
        "nearly constant below 60 % fill; about 2.2 on average there; falls from 60 % fill on, from 65 % fill on": (
            "gross_work_ratio",
            2.7,
            baffles,
            fill == 0.65,
        ),
    },
    "C6": {
        "about 1 below 40 % fill, from 25 % fill on; near 2 at 50 % fill; steep from 40 to 50 % fill": (
            "gross_work_ratio",
            0.6,
            ~baffles,
            fill == 0.2,
        ),
        "about 1 below 40 % fill": ("gross_work_ratio", 1.5, ~baffles, fill == 0.5),
        "about 1 below 40 % fill; near 2 at 50 % fill": ("gross_work_ratio", 1.8, ~baffles, fill == 0.4),
        NOWHERE: ("gross_work_ratio", 0.3, ~baffles),
    },
    "C7": {
        NOWHERE: ("drum_specific_power", pl.col("drum_specific_power") * 2.0, pl.col("size_ratio") > 36.0),
        "without baffles, for D/d ≥ 13; with baffles, for D/d ≥ 13": (
            "drum_specific_power",
            pl.col("drum_specific_power") * 0.5,
            pl.col("size_ratio") < 11.0,
        ),
    },
    "C8": {
        "constant above μ = 0.3 at 25 % fill; constant above μ = 0.3 at 50 % fill; "
        "constant above μ = 0.3 at 75 % fill": ("drum_specific_power", 1.0, friction == 0.0, fill == 0.5),
        "zero at μ = 0; constant above μ = 0.3 at 25 % fill, for μ ≤ 0.75; constant above μ = 0.3 at 50 % fill; "
        "constant above μ = 0.3 at 75 % fill": (
            "drum_specific_power",
            pl.col("drum_specific_power") * 1.3,
            friction == 1.0,
            fill == 0.25,
        ),
    },
    "C9": {
        "tangential power small; circulation sets in abruptly": (
            "dissipated_normal_specific_power",
            0.5,
            small,
        ),
        "normal power zero; tangential power small, up to 50 % fill; circulation sets in abruptly": (
            "dissipated_sliding_specific_power",
            0.0,
            small,
            fill == 0.75,
        ),
        "normal power zero; tangential power small; circulation sets in abruptly, from 50 % fill on": (
            "specific_angular_momentum",
            0.15 * (friction - 0.02),
            fill == 0.25,
        ),
    },
    "C10": {
        "rises at 50 % fill; falls at 75 % fill": (
            "gross_work_ratio",
            1.0 - 0.3 * friction,
            fill == 0.25,
            ~small,
        ),
        "rises at 25 % fill; rises at 50 % fill": (
            "gross_work_ratio",
            1.0 + 0.3 * friction,
            fill == 0.75,
            ~small,
        ),
        # Falls on the whole, but rises again.
        "rises at 25 % fill; rises at 50 % fill; falls at 75 % fill, for μ ≤ 0.75": (
            "gross_work_ratio",
            pl.when(friction > 0.8).then(1.9).otherwise(3.0 - 2.4 * friction),
            fill == 0.75,
            ~small,
        ),
    },
    "C11": {
        "carried over the top; mixes less": ("along_the_rim", 0.3, baffles, fill == 0.25),
        "carried along the rim; mixes less": ("carried_round", 0.1, baffles, fill == 0.25),
        "carried along the rim; carried over the top": ("mixed_in_a_turn", 0.9, baffles, fill == 0.25),
    },
    "C12": {
        NOWHERE: ("deep_speed", 0.2, fill == 0.75),
        "slow below the surface": ("surface_speed", 0.04, fill == 0.75),
    },
    "C13": {
        "power, up to 65 % fill; angular momentum; share carried over the top; mixing in a turn": (
            "drum_power",
            pl.col("drum_power") * 0.8,
            baffles,
            fill == 0.7,
        ),
        "power; angular momentum, from 65 % fill on; share carried over the top; mixing in a turn": (
            "specific_angular_momentum",
            0.2,
            baffles,
            fill == 0.6,
        ),
        "power; angular momentum; share carried over the top, up to 70 % fill; mixing in a turn": (
            "carried_round",
            0.5,
            baffles,
            fill == 0.75,
        ),
        "power; angular momentum; share carried over the top; mixing in a turn, from 65 % fill on": (
            "mixed_in_a_turn",
            0.4,
            baffles,
            fill == 0.6,
        ),
    },
    "C14": {
        "fill, speed and friction matter more without baffles; fill and speed matter more with baffles": (
            "drum_specific_power",
            pl.col("drum_specific_power") * (1.0 + pl.col("contact.bundle.restitution")),
        ),
        "size and restitution matter little without baffles; size and restitution matter little with baffles; "
        "fill and speed matter more with baffles": (
            "drum_specific_power",
            USUAL,
            friction != 0.5,
            fill == 0.25,
        ),
    },
}
