"""The paper's figures by number: title, caption, what they are drawn from."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

from drumrs.analysis import disagreement
from drumrs.config import baseline
from drumrs.paper.cases import THIRDS, percent
from drumrs.paper.curves import RATIOS
from drumrs.paper.data import StudyData
from drumrs.paper.drums import BAFFLED, BARE, Drum
from drumrs.paper.states import two_states
from drumrs.paper.verdict import MissingError

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure

    from drumrs.paper.curves import Curve


# Seeds this unlikely to be of one steady state are shown one by one.
_APART = 0.05
_HALF = 0.5
_POWER = "drum_specific_power"


@dataclass(frozen=True)
class PaperFigure:
    """A figure of the paper.

    Attributes
    ----------
    number
        ``"F2"`` to ``"F9"``, ``"speed"``, ``"restitution"``, ``"drift"``, ``"states"``.
    title, caption
        What it shows, and how to read it.
    draw
        Function from `StudyData` to a matplotlib figure; raises `MissingError` where cases are missing.
    """

    number: str
    title: str
    caption: str
    draw: "Callable[[StudyData], Figure]"


def points(curves: "list[Curve]") -> "pl.DataFrame":
    """Return curves as the table that `drumrs.figures.curves` draws.

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


def _snapshots(drum: Drum) -> "Callable[[StudyData], Figure]":
    def draw(data: StudyData) -> "Figure":
        from drumrs.paper import plots

        frames = {}
        for fill in THIRDS:
            case = data.cases(fill, drum)[0]
            frames[f"{percent(fill)} fill"] = data.sweep.frames(case, data.folder)
        return plots.snapshots_of_fills(frames)

    return draw


def _draw_drift(data: StudyData) -> "Figure":
    from drumrs.paper import plots

    runs, mass = {}, {}
    for drum in (BARE, BAFFLED):
        found = data.cases(_HALF, drum)
        name = f"50 % fill, {drum.name}"
        runs[name] = [data.sweep.series(case, data.folder) for case in found]
        config = found[0].config
        mass[name] = config.derived.load_mass
    return plots.drift_over_time(runs, mass, config.run.averaging_window)


def _draw_states(data: StudyData) -> "Figure":
    from drumrs.paper import plots

    return plots.states_over_time(two_states(data))


def _draw_speed(data: StudyData) -> "Figure":
    from drumrs.paper import plots

    config = baseline()
    centrifuging = (config.rotation.rpm or 0.0) / math.sqrt(config.derived.froude_number or math.inf)
    shown = data.results.shown("speed", _POWER)
    figure = plots.specific_power_against_speed(points(shown), centrifuging)
    _say_softer(figure, shown)
    return figure


def _say_softer(figure: "Figure", curves: "list[Curve]") -> None:
    """Say above a figure by how much springs are softer than Table 1's, where they are."""
    from drumrs.figures.curves import say_above

    softer = max(curve.softer for curve in curves)
    if softer > 1.0:
        say_above(figure.axes[0], f"springs softer by {softer:g}")


def _curve(number: str, axis: str, *columns: str) -> "Callable[[StudyData], Figure]":
    """Return the function that draws columns against an axis, as the figure of that number."""

    def draw(data: StudyData) -> "Figure":
        from drumrs.paper import plots

        figure = plots.CURVES[number](*(points(data.results.shown(axis, column)) for column in columns))
        _say_softer(figure, data.results.shown(axis, columns[0]))
        return figure

    return draw


_BARS = (
    "Bars are 95 % intervals; open markers: the load drifts; faint dots: single seeds, where they disagree."
)

_ALL = (
    PaperFigure(
        "F2",
        "Snapshots without baffles",
        "Fill 25, 50 and 75 %, colored by speed, at the end of the runs; a radius on each bundle shows its spin.",
        _snapshots(BARE),
    ),
    PaperFigure(
        "F3",
        "Snapshots with baffles",
        "As F2. The baffles' shape is inferred.",
        _snapshots(BAFFLED),
    ),
    PaperFigure(
        "F4",
        "Drum power against fill",
        f"Power of the drum per meter of its depth. Shaded is where the paper has the peak. {_BARS}",
        _curve("F4", "fill", "drum_power"),
    ),
    PaperFigure(
        "F5",
        "Specific power against fill",
        f"Drum power over the mass of the load. {_BARS}",
        _curve("F5", "fill", _POWER),
    ),
    PaperFigure(
        "F6",
        "N/T against fill",
        "What normal contacts exchange over what tangential ones do, loading and unloading of springs both counted. "
        f"Marks: by dissipation (×), and by net work (+), to which springs add nothing on balance. {_BARS}",
        _curve("F6", "fill", *RATIOS),
    ),
    PaperFigure(
        "F7",
        "Specific power against bundle size",
        f"At 40 % fill; the drum is the same, the bundles smaller to the right. {_BARS}",
        _curve("F7", "size", _POWER),
    ),
    PaperFigure(
        "F8",
        "Specific power against friction",
        f"Without baffles; the same friction between bundles and with the drum. {_BARS}",
        _curve("F8", "friction", _POWER),
    ),
    PaperFigure(
        "F9",
        "N/T against friction",
        f"Without baffles; readings as in F6. {_BARS}",
        _curve("F9", "friction", *RATIOS),
    ),
    PaperFigure(
        "speed",
        "Specific power against the drum's speed",
        f"At 25 % fill. The line marks where the rim's acceleration equals gravity. {_BARS}",
        _draw_speed,
    ),
    PaperFigure(
        "restitution",
        "Specific power against restitution",
        f"At 25 % fill; the same restitution between bundles and with the drum. {_BARS}",
        _curve("restitution", "restitution", _POWER),
    ),
    PaperFigure(
        "drift",
        "How steady the load is at 50 % fill",
        "Running means over 2 s, one line a seed; shaded is the window of the averages. Where a load passes between "
        "states, lines bend and part for longer than a few seconds.",
        _draw_drift,
    ),
    PaperFigure(
        "states",
        "Two states about half full",
        "Without baffles. Above: angular momentum of the load, means over a turn, of the first five seeds, colored by "
        "state. Below: the share of the time that the load is a ring carried round, and what the drum does in each "
        "state. Bars are 95 % intervals over the runs.",
        _draw_states,
    ),
)

FIGURES: Mapping[str, PaperFigure] = MappingProxyType({figure.number: figure for figure in _ALL})
