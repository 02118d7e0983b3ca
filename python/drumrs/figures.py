"""Pictures of a run: snapshots of the drum, and its history; frames and tables in, matplotlib figures out."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib import style
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch
from numpy.typing import NDArray

from drumrs.frames import Frames

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

_STYLE = Path(__file__).with_name("drumrs.mplstyle")
_STEEL = "0.55"
_INK = "0.15"
_LIGHT = 0.4  # relative luminance on which black shows better than white
_PANEL = 3.1  # inches


@dataclass(frozen=True)
class View:
    """One frame to be drawn, and what to write above it."""

    frames: Frames
    index: int = -1
    label: str = ""

    @property
    def speeds(self) -> Array:
        """Speeds of the bundles [m/s]."""
        speeds: Array = self.frames.speeds[self.index]
        return speeds


@contextmanager
def _drumrs_style() -> Iterator[None]:
    with style.context(_STYLE):
        yield


def write(figure: Figure, path: str | Path) -> None:
    """Write a figure as PNG or SVG, as the name's ending says; the same figure gives the same bytes."""
    with _drumrs_style():
        metadata = {"Date": None} if Path(path).suffix == ".svg" else {"Software": None}
        figure.savefig(path, metadata=metadata)


def snapshot(frames: Frames, index: int = -1, label: str = "") -> Figure:
    """Draw one frame: bundles colored by speed, a radius on each to show its spin, rim, baffles, rotation.

    Parameters
    ----------
    frames
        Frames of a run.
    index
        Which of them.
    label
        Written before the time.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs import figures
    >>> simulation = drumrs.Simulation(drumrs.baseline(fill=0.1))
    >>> simulation.run(steps=10)
    >>> figure = figures.snapshot(simulation.frames, label="start")
    """
    return snapshots([View(frames, index, label)])


def snapshots(views: Sequence[View]) -> Figure:
    """Draw several frames in a row, on one scale of speed.

    Raises
    ------
    ValueError
        Where there is nothing to draw.
    """
    if not views:
        raise ValueError("views is empty, but must hold at least one frame")
    fastest = max((float(view.speeds.max(initial=0.0)) for view in views), default=0.0)
    with _drumrs_style():
        norm = Normalize(0.0, fastest or 1.0)
        figure = Figure(figsize=(_PANEL * len(views) + 0.9, _PANEL + 0.45))
        row = figure.subplots(1, len(views), squeeze=False)[0]
        for axes, view in zip(row, views, strict=True):
            discs = _draw_view(axes, view, norm)
        figure.colorbar(discs, ax=list(row), label="speed of the bundles [m/s]", shrink=0.8, pad=0.02)
    return figure


def _draw_view(axes: "Axes", view: View, norm: Normalize) -> EllipseCollection:
    frames, index = view.frames, view.index % len(view.frames)
    _draw_drum(axes, frames, index)
    discs = _draw_bundles(axes, frames, index, norm)
    reach = _reach(frames, index)
    # The arrow of rotation needs room above.
    axes.set(xlim=(-1.03 * reach, 1.03 * reach), ylim=(-1.03 * reach, 1.15 * reach), aspect="equal")
    axes.axis("off")
    time = f"t = {frames.times[index]:.2f} s"
    axes.set_title(f"{view.label}, {time}" if view.label else time, loc="center")
    return discs


def _reach(frames: Frames, index: int) -> float:
    """Return the half width of a picture that holds the drum, or else everything there is."""
    if frames.drum_radius is not None:
        return frames.drum_radius
    points = np.concatenate([frames.positions[index], *frames.walls])
    return float(np.abs(points).max(initial=0.0) + frames.radii.max(initial=0.0))


def _draw_drum(axes: "Axes", frames: Frames, index: int) -> None:
    turn = _rotation(float(frames.drum_angles[index]))
    axes.add_collection(
        PolyCollection([line @ turn.T for line in frames.baffles], facecolors=_STEEL, edgecolors=_STEEL)
    )
    axes.add_collection(LineCollection([line @ turn.T for line in frames.walls], colors=_STEEL, linewidths=2))
    if frames.drum_radius is None:
        return
    axes.add_patch(Circle((0.0, 0.0), frames.drum_radius, fill=False, edgecolor=_STEEL, linewidth=2.0))
    sense = frames.turning(index)
    if sense:
        _draw_arrow(axes, 1.09 * frames.drum_radius, sense)


def _draw_arrow(axes: "Axes", radius: float, sense: int) -> None:
    """Draw an arc over the top of the drum with a head in the direction of rotation."""
    angles = np.radians(90.0 + sense * np.linspace(-24.0, 24.0, 40))
    arc = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    axes.plot(*arc[:-4].T, color=_INK, linewidth=1.2, solid_capstyle="butt")
    head = FancyArrowPatch(
        arc[-6], arc[-1], arrowstyle="-|>", mutation_scale=9, color=_INK, shrinkA=0, shrinkB=0
    )
    axes.add_patch(head)


def _draw_bundles(axes: "Axes", frames: Frames, index: int, norm: Normalize) -> EllipseCollection:
    centers, speeds, radii = frames.positions[index], frames.speeds[index], frames.radii
    colors = mpl.colormaps[mpl.rcParams["image.cmap"]]
    discs = EllipseCollection(
        2.0 * radii,
        2.0 * radii,
        np.zeros_like(radii),
        units="xy",
        offsets=centers,
        offset_transform=axes.transData,
        array=speeds,
        cmap=colors,
        norm=norm,
        edgecolors=_INK,
        linewidths=0.4,
    )
    axes.add_collection(discs)
    angles = frames.angles[index]
    ends = centers + radii[:, np.newaxis] * np.column_stack([np.cos(angles), np.sin(angles)])
    marks = np.stack([centers, ends], axis=1)
    axes.add_collection(LineCollection(list(marks), colors=_contrast(colors, norm, speeds), linewidths=0.9))
    return discs


def _contrast(colors: Colormap, norm: Normalize, values: Array) -> list[str]:
    """Choose black or white marks, whichever shows on the disc's color."""
    luminance = colors(norm(values))[:, :3] @ np.array([0.2126, 0.7152, 0.0722])
    return ["black" if light > _LIGHT else "white" for light in luminance]


def _rotation(angle: float) -> Array:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def time_series(series: "pl.DataFrame", window: tuple[float, float] | None = None) -> Figure:
    """Draw a run's history: power, energies, residual of the energy ledger, center of mass.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    window
        Interval of the averages [s], shaded.
    """
    panels: tuple[Callable[[Axes, dict[str, Array]], None], ...] = (
        _power,
        _energies,
        _ledger,
        _center_of_mass,
    )
    columns = {name: series[name].to_numpy() for name in series.columns}
    begin, end = float(columns["time"][0]), float(columns["time"][-1])
    with _drumrs_style():
        figure = Figure(figsize=(11.0, 5.6))
        grid = figure.subplots(2, 2, sharex=True)
        for axes, draw in zip(grid.flat, panels, strict=True):
            draw(axes, columns)
            if window is not None:
                axes.axvspan(*window, color="0.94", zorder=0, linewidth=0)
            # The last sample may fall just short of the window's end, which deserves its tick.
            axes.set_xlim(begin, max(end, window[1] if window is not None else end) or 1.0)
        if window is not None:
            grid[0, 0].text(sum(window) / 2.0, 0.985, "averages", **_over_the_window(grid[0, 0]))
        for axes in grid[1]:
            axes.set_xlabel("time [s]")
        for axes in grid.flat:
            _label_lines(axes)
    return figure


def _over_the_window(axes: "Axes") -> dict[str, Any]:
    """Return how to write just inside the top of the axes, at a time."""
    transform = axes.get_xaxis_transform()
    return {"transform": transform, "ha": "center", "va": "top", "color": "0.45", "fontsize": "small"}


def _power(axes: "Axes", columns: dict[str, Array]) -> None:
    time = columns["time"]
    long = _averaging_time(time)
    axes.set_title(f"Power of the drum and losses, means over {long:.2g} s [W/m]")
    steady = [0.0]
    for name, label in (
        ("work_drum", "drum"),
        ("dissipated_normal", "normal damping"),
        ("dissipated_sliding", "sliding"),
    ):
        middle, power = _thinned(*_mean_rate(time, columns[name], long))
        axes.plot(middle, power, label=label)
        steady.extend(power[len(power) // 10 :][np.isfinite(power[len(power) // 10 :])])
    # From zero, so that heights compare; the first moments, when the load drops, may leave the picture.
    lowest, highest = min(steady), max(steady)
    room = 0.08 * (highest - lowest) or 1.0
    axes.set_ylim(lowest - room if lowest < 0.0 else 0.0, highest + room)


def _energies(axes: "Axes", columns: dict[str, Array]) -> None:
    axes.set_title("Energy stored [J/m]")
    axes.set_yscale("log")
    elastic = columns["elastic_normal"] + columns["elastic_tangential"]
    for values, label in (
        (columns["kinetic_translation"], "translation"),
        (columns["kinetic_rotation"], "rotation"),
        (elastic, "contacts"),
    ):
        time, smooth = _thinned(columns["time"], values)
        axes.plot(time, np.where(smooth > 0.0, smooth, np.nan), label=label)


def _ledger(axes: "Axes", columns: dict[str, Array]) -> None:
    axes.set_title("Energy ledger: relative residual")
    axes.set_yscale("log")
    residual = np.abs(columns["energy_residual"])
    # A residual of exactly 0 has no place on a logarithmic axis; it is drawn at the last bit of 1.
    axes.plot(columns["time"], np.maximum(residual, np.finfo(float).eps / 2), label="residual")
    axes.set_ylim(1e-17, max(1e-8, 10.0 * float(residual.max(initial=0.0))))


def _center_of_mass(axes: "Axes", columns: dict[str, Array]) -> None:
    axes.set_title("Center of mass from the axis [mm]")
    for name, label in (("center_of_mass_x", "x"), ("center_of_mass_y", "y")):
        time, smooth = _thinned(columns["time"], columns[name])
        axes.plot(time, 1e3 * smooth, label=label)


def _averaging_time(time: Array) -> float:
    """Choose an interval [s] for running means: a second, or a thirtieth of a short run."""
    return min(1.0, float(time[-1] - time[0]) / 30.0) if len(time) > 1 else 1.0


def _mean_rate(time: Array, total: Array, interval: float) -> tuple[Array, Array]:
    """Return running means of a rate from its running integral: exact, whatever the sampling."""
    if not len(time) > 1:
        return time, np.full_like(time, np.nan)
    step = float(time[1] - time[0])
    rows = max(1, min(round(interval / step), len(time) - 1))
    spans = time[rows:] - time[:-rows]
    return (time[rows:] + time[:-rows]) / 2.0, (total[rows:] - total[:-rows]) / spans


def _thinned(time: Array, values: Array, most: int = 600) -> tuple[Array, Array]:
    """Average blocks of rows, so that a line has no more points than a picture can show."""
    rows = max(1, len(time) // most)
    blocks = len(time) // rows
    shape = (blocks, rows)
    return (
        time[: blocks * rows].reshape(shape).mean(axis=1),
        values[: blocks * rows].reshape(shape).mean(axis=1),
    )


def _label_lines(axes: "Axes") -> None:
    """Write each line's name at its right end, in its color, kept apart from the others."""
    ends: list[tuple[float, Any]] = []
    # Asking for the limits settles them; until then the transform is not the final one.
    axes.get_ylim()
    for line in axes.get_lines():
        values = np.asarray(line.get_ydata(), dtype=float)
        finite = values[np.isfinite(values)]
        if len(finite):
            shown = axes.transData.transform((0.0, finite[-max(1, len(finite) // 20) :].mean()))
            ends.append((float(axes.transAxes.inverted().transform(shown)[1]), line))
    ends.sort(key=lambda end: end[0])
    for place, (_, line) in zip(_apart([height for height, _ in ends]), ends, strict=True):
        name, color = str(line.get_label()), line.get_color()
        axes.annotate(name, (1.01, place), xycoords="axes fraction", color=color, va="center")


def _apart(heights: Sequence[float], gap: float = 0.075) -> list[float]:
    """Move sorted heights away from each other until none is nearer than `gap` to the next."""
    places = list(heights)
    for _ in range(100):
        for below in range(len(places) - 1):
            lacking = gap - (places[below + 1] - places[below])
            if lacking > 0.0:
                places[below] -= lacking / 2.0
                places[below + 1] += lacking / 2.0
    return places
