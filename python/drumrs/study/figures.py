"""The paper's figures by number: title, caption, what they are drawn from."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from drumrs.analysis import disagreement
from drumrs.config import Config, baseline
from drumrs.study.cases import THIRDS
from drumrs.study.claims_power import percent
from drumrs.study.curves import Curve, Results
from drumrs.study.verdict import MissingError

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure

    from drumrs.sweep import Case, Sweep

# Seeds this unlikely to be of one steady state are shown one by one.
_APART = 0.05
_HALF = 0.5


@dataclass(frozen=True, eq=False)
class Material:
    """What figures are drawn from.

    Attributes
    ----------
    table
        What `measure` returned.
    sweep
        The sweep, for the figures that need series or frames.
    folder
        Where its results are; that of its last run unless given.
    """

    table: "pl.DataFrame"
    sweep: "Sweep | None" = None
    folder: str | Path | None = None

    def cases(self, fill: float, *, baffles: bool) -> "list[tuple[Sweep, Case]]":
        """Return the finished cases of a fill in Table 1's drum, by seed.

        Raises
        ------
        MissingError
            Where there are none, or no sweep.
        """
        finished = set(self.table["case"])
        like = baseline(fill, baffles=baffles)
        cases = self.sweep.cases if self.sweep is not None else ()
        found = [case for case in cases if case.id in finished and _same_drum(case.config, like)]
        if self.sweep is None or not found:
            raise MissingError(f"runs at {percent(fill)} fill {'with' if baffles else 'without'} baffles")
        return [(self.sweep, case) for case in sorted(found, key=lambda case: case.config.run.seed)]


def _same_drum(config: Config, like: Config) -> bool:
    return config.replace({"run": like.run.model_dump()}) == like


@dataclass(frozen=True)
class StudyFigure:
    """A figure of the study.

    Attributes
    ----------
    number
        ``"F2"`` to ``"F9"``, ``"speed"``, ``"restitution"``, ``"drift"``.
    title, caption
        What it shows, and how to read it.
    draw
        Function from `Material` to a matplotlib figure; raises `MissingError` where cases are missing.
    """

    number: str
    title: str
    caption: str
    draw: "Callable[[Material], Figure]"


def points(curves: "list[Curve]") -> "pl.DataFrame":
    """Return curves as the table that `drumrs.figures` draws.

    Raises
    ------
    MissingError
        Where there is no point.
    """
    import polars as pl

    rows = [
        {
            "label": curve.label,
            "x": point.x,
            "mean": point.estimate.mean,
            "half_width": point.estimate.interval().half_width,
            "drifting": point.drifting,
            "disagree": disagreement(point.values, point.errors) < _APART,
            "values": list(point.values),
        }
        for curve in curves
        for point in curve.points
    ]
    if not rows:
        raise MissingError("every case of the figure")
    return pl.DataFrame(rows)


def _both_drums(material: Material, axis: str, column: str) -> "pl.DataFrame":
    results = Results(material.table)
    return points([results.curve(axis, column, baffles=baffles) for baffles in (False, True)])


def _three_fills(material: Material, column: str) -> "pl.DataFrame":
    results = Results(material.table)
    return points([results.curve("friction", column, fill=fill) for fill in THIRDS])


def _snapshots(baffles: bool) -> "Callable[[Material], Figure]":
    def draw(material: Material) -> "Figure":
        from drumrs import figures

        frames = {}
        for fill in THIRDS:
            sweep, case = material.cases(fill, baffles=baffles)[0]
            frames[f"{percent(fill)} fill"] = sweep.frames(case, material.folder)
        return figures.snapshots_of_fills(frames)

    return draw


def _draw_drift(material: Material) -> "Figure":
    from drumrs import figures

    runs, mass = {}, {}
    for baffles in (False, True):
        found = material.cases(_HALF, baffles=baffles)
        drum = f"50 % fill, {'with' if baffles else 'without'} baffles"
        runs[drum] = [sweep.series(case, material.folder) for sweep, case in found]
        config = found[0][1].config
        mass[drum] = config.bundle_count * config.load.density * math.pi * config.load.diameter**2 / 4.0
    return figures.drift_over_time(runs, mass, config.run.averaging_window)


def _draw_speed(material: Material) -> "Figure":
    from drumrs import figures

    radius, gravity = baseline().drum.diameter / 2.0, abs(baseline().gravity[1])
    centrifuging = math.sqrt(gravity / radius) * 60.0 / (2.0 * math.pi)
    return figures.specific_power_against_speed(
        _both_drums(material, "speed", "drum_specific_power"), centrifuging
    )


def _curve(name: str, axis: str, *columns: str) -> "Callable[[Material], Figure]":
    """Return the function that draws a figure of `drumrs.figures` from columns against an axis."""

    def draw(material: Material) -> "Figure":
        from drumrs import figures

        tables = [
            _three_fills(material, column) if axis == "friction" else _both_drums(material, axis, column)
            for column in columns
        ]
        figure: Figure = getattr(figures, name)(*tables)
        return figure

    return draw


_BARS = (
    "Bars are 95 % intervals; open markers: the load drifts; faint dots: single seeds, where they disagree."
)
_POWER, _RATIOS = "drum_specific_power", ("dissipation_ratio", "work_ratio")

_ALL = (
    StudyFigure(
        "F2",
        "Snapshots without baffles",
        "Fill 25, 50 and 75 %, colored by speed, at the end of the runs; a radius on each bundle shows its spin.",
        _snapshots(baffles=False),
    ),
    StudyFigure(
        "F3", "Snapshots with baffles", "As F2. The baffles' size is an assumption.", _snapshots(baffles=True)
    ),
    StudyFigure(
        "F4",
        "Drum power against fill",
        f"Power of the drum per meter of its depth. Shaded is where the paper has the peak. {_BARS}",
        _curve("power_against_fill", "fill", "drum_power"),
    ),
    StudyFigure(
        "F5",
        "Specific power against fill",
        f"Drum power over the mass of the load. {_BARS}",
        _curve("specific_power_against_fill", "fill", _POWER),
    ),
    StudyFigure(
        "F6",
        "N/T against fill",
        "Power taken by normal damping over power taken by sliding; crosses: work of the contacts' normal over that of "
        f"their tangential forces, which counts springs as well. {_BARS}",
        _curve("ratio_against_fill", "fill", *_RATIOS),
    ),
    StudyFigure(
        "F7",
        "Specific power against bundle size",
        f"At 40 % fill; the drum is the same, the bundles smaller to the right. {_BARS}",
        _curve("specific_power_against_size", "size", _POWER),
    ),
    StudyFigure(
        "F8",
        "Specific power against friction",
        f"Without baffles; the same friction between bundles and with the drum. {_BARS}",
        _curve("specific_power_against_friction", "friction", _POWER),
    ),
    StudyFigure(
        "F9",
        "N/T against friction",
        f"Without baffles; readings as in F6. {_BARS}",
        _curve("ratio_against_friction", "friction", *_RATIOS),
    ),
    StudyFigure(
        "speed",
        "Specific power against the drum's speed",
        f"At 25 % fill. The line marks where the rim's acceleration equals gravity. {_BARS}",
        _draw_speed,
    ),
    StudyFigure(
        "restitution",
        "Specific power against restitution",
        f"At 25 % fill; the same restitution between bundles and with the drum. {_BARS}",
        _curve("specific_power_against_restitution", "restitution", _POWER),
    ),
    StudyFigure(
        "drift",
        "How steady the load is at 50 % fill",
        "Running means over 2 s, one line a seed; shaded is the window of the averages. Where a load passes between "
        "states, lines bend and part for longer than a few seconds.",
        _draw_drift,
    ),
)

FIGURES: Mapping[str, StudyFigure] = MappingProxyType({figure.number: figure for figure in _ALL})
