"""The regimes of a drum over its speed and fill: a sweep drawn as a map."""

from typing import TYPE_CHECKING

import matplotlib as mpl

from drumrs.figures.shared import INK, drumrs_style, new_figure

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure

# After Mellmann, from slow to fast, each with a mark of its own.
REGIMES = {
    "slipping": "v",
    "surging": "<",
    "slumping": "D",
    "rolling": "o",
    "cascading": "s",
    "cataracting": "^",
    "partly centrifuging": "P",
    "centrifuging": "X",
}


def regime_map(
    table: "pl.DataFrame",
    *,
    speed: str = "critical_share",
    fill: str = "load.fill",
    regime: str = "regime",
    labels: tuple[str, str] = ("speed over the critical speed", "fill"),
) -> "Figure":
    """Draw which regime a load is in, by speed and fill.

    Parameters
    ----------
    table
        One row a case, as a sweep's table has them.
    speed, fill
        Columns of the axes.
    regime
        Column with the name of the regime: one of `REGIMES`, or any other, which follow them.
    labels
        Names of the axes.

    Raises
    ------
    ValueError
        Where there is nothing to draw.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs import figures
    >>> cases = {"critical_share": [0.1, 0.6, 1.3], "load.fill": [0.3, 0.3, 0.3]}
    >>> table = pl.DataFrame({**cases, "regime": ["rolling", "cataracting", "centrifuging"]})
    >>> figure = figures.regime_map(table)
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['rolling', 'cataracting', 'centrifuging']
    """
    if table.is_empty():
        raise ValueError("table is empty, but must hold at least one case")
    there = set(table[regime].drop_nulls())
    marks = {**REGIMES, **dict.fromkeys(sorted(there - set(REGIMES)), ".")}
    with drumrs_style():
        figure = new_figure(5.6, 3.8)
        axes = figure.subplots()
        # Colors rise in lightness with the regimes, so that they stay in order in gray.
        colors = mpl.colormaps["viridis"].resampled(len(marks))
        for place, (name, marker) in enumerate(marks.items()):
            rows = table.filter(table[regime] == name)
            if name in there:
                axes.plot(
                    *(rows[speed].to_numpy(), rows[fill].to_numpy()),
                    marker=marker,
                    linestyle="none",
                    markersize=8.0,
                    color=colors(place),
                    markeredgecolor=INK,
                    markeredgewidth=0.5,
                    label=name,
                )
        axes.set(xlabel=labels[0], ylabel=labels[1])
        axes.margins(0.08)
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure
