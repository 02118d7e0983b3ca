"""What matters most: bars of effects or of shares in the spread, with intervals, beside what is chance."""

from typing import TYPE_CHECKING

from drumrs.figures.shared import INK, STEEL, drumrs_style, line_colors, new_figure

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from drumrs.analysis import Interval

_PERCENT = 100.0
_NOT_TOLD = "not told from noise"


def indices(
    rows: "Mapping[str, tuple[Interval | None, Interval | None]]", chance: "Interval", label: str
) -> "Figure":
    """Draw Sobol's indices of keys: by itself, and with all that a key does together with others.

    Parameters
    ----------
    rows
        By key, the index of first order and the total one; `None` for a key that was found dead.
    chance
        Share of noise in the spread of single runs.
    label
        What stands at the axis.

    Examples
    --------
    >>> from drumrs import figures
    >>> from drumrs.analysis import Interval
    >>> rows = {"rotation.rpm": (Interval(0.6, 0.1), Interval(0.7, 0.1)), "load.fill": (None, None)}
    >>> figure = figures.indices(rows, Interval(0.1, 0.05), "share of the spread")
    >>> [label.get_text() for label in figure.axes[0].get_yticklabels()]
    ['rotation.rpm', 'load.fill', 'chance']
    """
    with drumrs_style():
        figure = new_figure(6.0, 1.2 + 0.45 * (len(rows) + 1))
        axes = figure.subplots()
        dark, red, *_ = line_colors()
        for row, (first, total) in enumerate(rows.values()):
            if first is None or total is None:
                axes.annotate(_NOT_TOLD, (1.0, row), va="center", color=STEEL)
                continue
            named = not axes.containers
            _bar(axes, row - 0.17, first, dark, "by itself" if named else None)
            _bar(axes, row + 0.17, total, red, "with what it does together with others" if named else None)
        _bar(axes, len(rows), chance, "0.7")
        # Up to round-off nothing is below 0 or above all of the spread.
        axes.set_xlim(0.0, 105.0)
        axes.legend(loc="lower right")
        _label(axes, [*rows, "chance"], f"{label} [%]")
    return figure


def effects(rows: "Mapping[str, tuple[float, float, bool]]", floor: float, label: str) -> "Figure":
    """Draw Morris's effects of keys beside what noise alone makes of them.

    Parameters
    ----------
    rows
        By key, the mean effect without its sign, its standard deviation by noise, and whether it cannot be told from
        noise.
    floor
        What noise alone makes of an effect.
    label
        What stands at the axis.

    Examples
    --------
    >>> from drumrs import figures
    >>> figure = figures.effects({"rotation.rpm": (2.0, 0.1, False), "load.fill": (0.2, 0.1, True)}, 0.2, "change")
    >>> [text.get_text() for text in figure.axes[0].texts]
    ['not told from noise', 'noise alone']
    """
    with drumrs_style():
        figure = new_figure(6.0, 1.2 + 0.38 * len(rows))
        axes = figure.subplots()
        dark, *_ = line_colors()
        for row, (size, spread, is_dead) in enumerate(rows.values()):
            color = "0.7" if is_dead else dark
            axes.barh(row, size, 0.5, xerr=2.0 * spread, color=color, ecolor=INK, capsize=2.0)
            if is_dead:
                place = (max(size, floor) + 2.5 * spread, row)
                axes.annotate(
                    _NOT_TOLD, place, (4.0, 0.0), textcoords="offset points", va="center", color=STEEL
                )
        axes.axvline(floor, color=INK, lw=1.0, ls="--")
        axes.annotate(
            "noise alone",
            (floor, 1.0),
            (3.0, 2.0),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            color=INK,
        )
        axes.set_xlim(left=0.0)
        _label(axes, list(rows), label)
    return figure


def _bar(axes: "Axes", row: float, share: "Interval", color: str, name: str | None = None) -> None:
    axes.barh(
        row,
        _PERCENT * max(share.mean, 0.0),
        0.3,
        xerr=_PERCENT * share.half_width,
        color=color,
        ecolor=INK,
        capsize=2.0,
        label=name,
    )


def _label(axes: "Axes", names: list[str], label: str) -> None:
    axes.set_yticks(range(len(names)), names)
    axes.set(xlabel=label, ylim=(len(names) - 0.4, -0.6))
    axes.tick_params(axis="y", length=0.0, labelcolor=INK)
