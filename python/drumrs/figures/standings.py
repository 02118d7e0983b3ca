"""How far designs are behind the best one: intervals of differences beside what counts as equal."""

from typing import TYPE_CHECKING

from drumrs.figures.shared import INK, STEEL, drumrs_style, line_colors, new_figure

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

    from drumrs.analysis import Interval


def differences(rows: "Mapping[str, tuple[Interval, str]]", equal: float, label: str) -> "Figure":
    """Draw by how much each design is behind the best one, and the band within which designs count as equal.

    Parameters
    ----------
    rows
        By the design's name, how much it is behind, and how it stands: "best", "worse", "equal" or "open".
    equal
        Difference below which designs count as equal.
    label
        What stands at the axis.

    Examples
    --------
    >>> from drumrs import figures
    >>> from drumrs.analysis import Interval
    >>> rows = {"A": (Interval(0.0, 0.0), "best"), "B": (Interval(0.3, 0.1), "worse")}
    >>> figure = figures.differences(rows, 0.1, "power behind A [W/kg]")
    >>> [text.get_text() for text in figure.axes[0].texts]
    ['best', 'worse']
    """
    with drumrs_style():
        blue, red, green, *_ = line_colors()
        colors = {"best": green, "equal": green, "worse": red, "open": blue}
        figure = new_figure(5.6, 1.0 + 0.38 * len(rows))
        axes = figure.subplots()
        axes.axvspan(-equal, equal, color="0.92", lw=0.0, zorder=0)
        axes.axvline(0.0, color=STEEL, lw=1.0, zorder=1)
        for row, (behind, standing) in enumerate(rows.values()):
            axes.errorbar(
                behind.mean,
                row,
                xerr=behind.half_width,
                fmt="o",
                ms=5.0,
                color=colors[standing],
                capsize=3.0,
            )
            axes.annotate(
                standing, (1.02, row), xycoords=("axes fraction", "data"), va="center", color=colors[standing]
            )
        axes.set_yticks(range(len(rows)), list(rows))
        axes.set(xlabel=label, ylim=(len(rows) - 0.5, -0.5))
        axes.tick_params(axis="y", length=0.0, labelcolor=INK)
        axes.spines["left"].set_visible(False)
        axes.set_title("gray: counts as equal; bars hold together with 95 %", fontsize="small", color=STEEL)
    return figure
