"""What all figures share: the style, writing, names at the ends of lines."""

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib import style
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterSciNotation
from numpy.typing import NDArray

from drumrs.files import write_whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

Array = NDArray[np.float64]

# Least distance of names at the ends of lines, over the height of the axes.
_GAP = 0.075
STEEL = "0.55"
INK = "0.15"

# Powers of ten in the mathematical notation of matplotlib.
_POWER = re.compile(r"\^\{(-?\d+)\}")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_STYLE = Path(__file__).with_name("drumrs.mplstyle")


@contextmanager
def drumrs_style() -> Iterator[None]:
    """Draw in drumrs's style within: matplotlib's defaults and drumrs.mplstyle, nothing of a user's matplotlibrc.

    Examples
    --------
    >>> from drumrs import figures
    >>> with figures.drumrs_style():
    ...     figure = figures.new_figure(4.0, 3.0)
    ...     _ = figure.subplots().plot([0.0, 1.0], [0.0, 2.0])
    >>> figures.render(figure, "png")[1:4]
    b'PNG'
    """
    with style.context(_STYLE, after_reset=True):
        yield


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure of a size in inches; it belongs to no window, so nothing has to be closed."""
    return Figure(figsize=(width, height))


def line_colors() -> list[str]:
    """Return the colors that lines take in turn, to be asked for in drumrs's style."""
    colors: list[str] = mpl.rcParams["axes.prop_cycle"].by_key()["color"]
    return colors


class _Powers(LogFormatterSciNotation):
    """Writes powers of ten in plain letters: to set mathematical notation takes half of the time of a drawing."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        text: str = super().__call__(x, pos).removeprefix(r"$\mathdefault{").removesuffix("}$")
        return _POWER.sub(lambda power: power[1].translate(_RAISED), text).replace(r"\times", "×")


def log_scale(axes: "Axes", *names: str) -> None:
    """Let axes of a drawing, ``"x"`` or ``"y"``, be logarithmic, with powers of ten at their ticks.

    Examples
    --------
    >>> from drumrs import figures
    >>> from drumrs.figures.shared import log_scale
    >>> axes = figures.new_figure(4.0, 3.0).subplots()
    >>> _ = axes.plot([1.0, 2.0], [2e-3, 30.0])
    >>> log_scale(axes, "y")
    >>> axes.yaxis.get_major_formatter()(1e-2), axes.yaxis.get_minor_formatter()(2e-2)
    ('10⁻²', '2×10⁻²')
    """
    for name in names:
        axes.set(**{f"{name}scale": "log"})
        axis: Axis = getattr(axes, f"{name}axis")
        axis.set_major_formatter(_Powers())
        axis.set_minor_formatter(_Powers())


def write(figure: Figure, path: str | Path) -> None:
    """Write a figure as PNG or SVG, as the name's ending says; the same figure gives the same bytes.

    Parameters
    ----------
    figure
        The figure.
    path
        File whose name ends in ``.png`` or ``.svg``.

    Raises
    ------
    OSError
        Where the file cannot be written; there is never half a picture.
    """
    write_whole(path, render(figure, Path(path).suffix.removeprefix(".")))


def render(figure: Figure, kind: str) -> bytes:
    """Return a figure as ``"png"`` or ``"svg"``; the same figure gives the same bytes."""
    kept = BytesIO()
    with drumrs_style():
        figure.savefig(kept, format=kind, metadata={"Date": None} if kind == "svg" else {"Software": None})
    return kept.getvalue()


def label_lines(axes: "Axes") -> None:
    """Write each line's name at its right end, in its color, kept apart from the others."""
    ends: list[tuple[float, str, Any]] = []
    first, last = axes.get_xlim()
    for line in axes.get_lines():
        x, values = (np.asarray(data, dtype=float) for data in (line.get_xdata(), line.get_ydata()))
        finite = values[np.isfinite(values) & (x >= first) & (x <= last)]
        if len(finite):
            ends.append(
                (float(finite[-max(1, len(finite) // 20) :].mean()), str(line.get_label()), line.get_color())
            )
    write_at_ends(axes, ends)


def write_at_ends(axes: "Axes", ends: Sequence[tuple[float, str, Any]]) -> None:
    """Write names in their colors at the right of the axes, at their values, kept apart from each other."""
    # Asking for the limits settles them; until then the transform is not the final one.
    axes.get_ylim()
    heights = [
        axes.transAxes.inverted().transform(axes.transData.transform((0.0, value)))[1] for value, *_ in ends
    ]
    # In low axes a line of text is a larger part of their height.
    inches = axes.get_window_extent().height / axes.figure.dpi
    gap = max(_GAP, 1.3 * mpl.rcParams["font.size"] / (72.0 * inches))
    order = np.argsort(heights, kind="stable")
    for place, k in zip(apart([float(heights[k]) for k in order], gap), order, strict=True):
        _, name, color = ends[k]
        axes.annotate(name, (1.01, place), xycoords="axes fraction", color=color, va="center")


def apart(heights: Sequence[float], gap: float = _GAP) -> list[float]:
    """Move sorted heights away from each other until none is nearer than `gap` to the next."""
    places = list(heights)
    for _ in range(100):
        for below in range(len(places) - 1):
            lacking = gap - (places[below + 1] - places[below])
            if lacking > 0.0:
                places[below] -= lacking / 2.0
                places[below + 1] += lacking / 2.0
    return places
