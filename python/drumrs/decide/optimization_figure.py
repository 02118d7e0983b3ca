"""The figure of an optimization: convergence, the response along each key, the front of two objectives."""

import math
from typing import TYPE_CHECKING

import numpy as np

from drumrs.decide.gain import hypervolume
from drumrs.figures import INK, drumrs_style, line_colors, new_figure

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Any

    import polars as pl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from drumrs.decide.confirmed import Confirmed
    from drumrs.decide.emulator import Array
    from drumrs.decide.problem import Problem
    from drumrs.decide.search import Model, Search

_COLUMNS = 3
_PANEL = (3.4, 2.7)
# Places at which a response is drawn, and half the width of its band in standard errors.
_PLACES, _BAND = 101, 2.0


def draw(
    problem: "Problem",
    search: "Search",
    model: "Model",
    confirmed: "Sequence[Confirmed]",
    table: "pl.DataFrame",
    best: "Mapping[str, Any]",
) -> "Figure":
    """Draw an optimization.

    Parameters
    ----------
    problem, search, model, confirmed, table, best
        As of `Optimization`, with something confirmed.
    """
    keys, objectives = len(problem.space), len(problem.objectives)
    count = 1 + keys * objectives + (objectives > 1)
    rows = math.ceil(count / _COLUMNS)
    with drumrs_style():
        figure = new_figure(_PANEL[0] * min(count, _COLUMNS), _PANEL[1] * rows)
        panels = list(np.ravel(figure.subplots(rows, min(count, _COLUMNS), squeeze=False)))
        _convergence(panels.pop(0), problem, search, model)
        if objectives > 1:
            _front(panels.pop(0), problem, confirmed, table)
        for objective in range(objectives):
            for key in range(keys):
                _response(panels.pop(0), problem, model, best, (objective, key))
        for axes in panels:
            axes.set_axis_off()
    return figure


def _convergence(axes: "Axes", problem: "Problem", search: "Search", model: "Model") -> None:
    """Draw the best that was known after each run, as all runs together say now."""
    colors, count = line_colors(), len(model.points)
    means, runs = model.predict(model.points)[0], np.arange(1, count + 1)
    feasible = model.feasible
    if model.objectives == 1:
        goal = problem.objectives[0]
        seen = np.vectorize(goal.unsigned)(search.values[:, 0])
        axes.errorbar(
            runs,
            seen,
            np.nan_to_num(search.errors[:, 0]),
            fmt=".",
            color="0.6",
            elinewidth=0.8,
            label="runs",
        )
        best = np.minimum.accumulate(np.where(feasible, means[:, 0], np.inf))
        there = np.isfinite(best)
        axes.step(
            runs[there], np.vectorize(goal.unsigned)(best[there]), where="post", color=colors[0], label="best"
        )
        axes.set(ylabel=goal.target.label)
    else:
        reference, wanted = model.reference, means[:, : model.objectives]
        grown = [hypervolume(wanted[:k][feasible[:k]], reference) for k in runs]
        axes.step(runs, grown, where="post", color=colors[0], label="hypervolume of the front")
        axes.set(ylabel="hypervolume")
    axes.set(xlabel="runs", title="convergence")
    axes.legend(loc="best", fontsize="small")


def _front(axes: "Axes", problem: "Problem", confirmed: "Sequence[Confirmed]", table: "pl.DataFrame") -> None:
    colors = line_colors()
    goals = problem.objectives
    names = [f"{goal.target.text}_expected" for goal in goals]
    axes.plot(*(table[name].to_numpy() for name in names), ".", color="0.6", label="runs")
    front = table.filter("front")
    axes.errorbar(
        front[names[0]].to_numpy(),
        front[names[1]].to_numpy(),
        xerr=_BAND * front[f"{names[0]}_error"].to_numpy(),
        yerr=_BAND * front[f"{names[1]}_error"].to_numpy(),
        fmt="o",
        color=colors[0],
        markersize=4,
        label="front, ± two standard errors",
    )
    fresh = np.array([[one.fresh[k].mean for k in range(2)] for one in confirmed])
    errors = np.array([[one.fresh[k].error for k in range(2)] for one in confirmed])
    errors = np.where(np.isfinite(errors), errors, 0.0)
    axes.errorbar(
        fresh[:, 0],
        fresh[:, 1],
        xerr=_BAND * errors[:, 0],
        yerr=_BAND * errors[:, 1],
        fmt="s",
        color=colors[1],
        markersize=4,
        label="on fresh seeds",
    )
    axes.set(xlabel=goals[0].target.label, ylabel=goals[1].target.label, title="front")
    axes.legend(loc="best", fontsize="small")


def _response(
    axes: "Axes", problem: "Problem", model: "Model", values: "Mapping[str, Any]", which: tuple[int, int]
) -> None:
    """Draw what is expected along a key, the others being those of the best point."""
    objective, key = which
    space, goal, colors = problem.space, problem.objectives[objective], line_colors()
    one = space.parameters[key]
    best = space.place(values)
    steps = round(one.high - one.low) + 1
    is_discrete = steps <= _PLACES and (one.is_whole or bool(one.choices))
    count = steps if is_discrete else _PLACES
    places = np.tile(best, (count, 1))
    places[:, key] = np.linspace(0.0, 1.0, count)
    means, errors = (both[:, objective] for both in model.predict(places))
    low, mean, high = (np.vectorize(goal.unsigned)(means + share * errors) for share in (-_BAND, 0.0, _BAND))
    x = places[:, key] if one.choices else one.low + (one.high - one.low) * places[:, key]
    if is_discrete:
        axes.errorbar(x, mean, np.abs(np.array([low, high]) - mean), fmt="o", color=colors[0], markersize=4)
    else:
        axes.fill_between(
            x, np.minimum(low, high), np.maximum(low, high), color=colors[0], alpha=0.2, linewidth=0
        )
        axes.plot(x, mean, color=colors[0])
    axes.axvline(_own_place(best, key, x), color=INK, linewidth=0.8, linestyle=":")
    if one.choices:
        axes.set_xticks(x, [str(choice) for choice in one.choices])
    axes.set(xlabel=one.key, ylabel=goal.target.label)


def _own_place(best: "Array", key: int, x: "Array") -> float:
    return float(x[0] + (x[-1] - x[0]) * best[key])
