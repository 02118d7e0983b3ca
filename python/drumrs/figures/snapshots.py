"""Snapshots of the drum: frames in, a figure out."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.colors import Colormap, ListedColormap, Normalize
from matplotlib.patches import Circle, FancyArrowPatch, Polygon

from drumrs.figures import labels
from drumrs.figures.shared import INK, STEEL, Array, drumrs_style, line_colors, new_figure
from drumrs.frames import Frames

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LIGHT = 0.4  # relative luminance on which black shows better than white
_PANEL = 3.1  # inches


@dataclass(frozen=True)
class View:
    """One frame to be drawn, and what to write above it.

    Attributes
    ----------
    frames
        Frames of a run.
    index
        Which of them; the last one unless given.
    label
        Written before the time.
    """

    frames: Frames
    index: int = -1
    label: str = ""

    @property
    def speeds(self) -> Array:
        """Speeds of the bundles [m/s]."""
        speeds: Array = self.frames.speeds[self.index]
        return speeds


def snapshot(frames: Frames, index: int = -1, label: str = "") -> "Figure":
    """Draw one frame: bundles colored by speed, a radius on each to show its spin, rim, baffles, rotation.

    Where there are several species, it is drawn again below, colored by them.

    Parameters
    ----------
    frames
        Frames of a run.
    index
        Which of them; the last one unless given.
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


def snapshots(views: Sequence[View]) -> "Figure":
    """Draw several frames in a row, on one scale of speed; where there are several species, a second time by them.

    Parameters
    ----------
    views
        The frames, of one run or of several, as `snapshot` draws each.

    Raises
    ------
    ValueError
        Where there is nothing to draw.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs import figures
    >>> simulation = drumrs.Simulation(drumrs.baseline(fill=0.1))
    >>> simulation.run(duration=0.1)
    >>> figure = figures.snapshots([figures.View(simulation.frames, index, "10 % fill") for index in (0, -1)])
    >>> [axes.get_title() for axes in figure.axes[:2]]
    ['10 % fill, t = 0.00 s', '10 % fill, t = 0.08 s']
    """
    if not views:
        raise ValueError("views is empty, but must hold at least one frame")
    fastest = max((float(view.speeds.max(initial=0.0)) for view in views), default=0.0)
    known = all(view.frames.species for view in views)
    names = sorted({name for view in views for name in view.frames.species}) if known else []
    with drumrs_style():
        rows = 2 if len(names) > 1 else 1
        figure = new_figure(_PANEL * len(views) + 0.9, rows * (_PANEL + 0.45))
        grid = figure.subplots(rows, len(views), squeeze=False)
        scale = _Scale(mpl.colormaps[mpl.rcParams["image.cmap"]], Normalize(0.0, fastest or 1.0))
        for axes, view in zip(grid[0], views, strict=True):
            discs = _draw_view(axes, view, view.speeds, scale)
        figure.colorbar(discs, ax=list(grid[0]), label=labels.SPEED, shrink=0.8, pad=0.02)
        if rows > 1:
            _draw_species(figure, list(grid[1]), views, names)
    return figure


@dataclass(frozen=True)
class _Scale:
    """Colors of values."""

    colors: Colormap
    norm: Normalize


def _draw_species(figure: "Figure", row: "list[Axes]", views: Sequence[View], names: list[str]) -> None:
    """Draw the frames once more, bundles colored by species."""
    colors = [line_colors()[place % len(line_colors())] for place in range(len(names))]
    scale = _Scale(ListedColormap(colors), Normalize(-0.5, len(names) - 0.5))
    for axes, view in zip(row, views, strict=True):
        places = np.array([names.index(name) for name in view.frames.species], dtype=float)
        discs = _draw_view(axes, view, places, scale)
    bar = figure.colorbar(discs, ax=row, shrink=0.8, pad=0.02, ticks=range(len(names)))
    bar.ax.set_yticklabels(names)


def _draw_view(axes: "Axes", view: View, values: Array, scale: _Scale) -> EllipseCollection:
    frames, index = view.frames, view.index % len(view.frames)
    _draw_drum(axes, frames, index)
    discs = _draw_bundles(axes, frames, index, values, scale)
    reach = _reach(frames, index)
    # The arrow of rotation needs room above.
    axes.set(xlim=(-1.03 * reach, 1.03 * reach), ylim=(-1.03 * reach, 1.15 * reach), aspect="equal")
    axes.axis("off")
    time = f"t = {frames.times[index]:.2f} s"
    axes.set_title(f"{view.label}, {time}" if view.label else time, loc="center")
    return discs


def _reach(frames: Frames, index: int) -> float:
    """Return the half width of a picture that holds the drum, or else everything there is."""
    if frames.reach is not None:
        return frames.reach
    points = np.concatenate([frames.positions[index], *frames.walls])
    return float(np.abs(points).max(initial=0.0) + frames.radii.max(initial=0.0))


def _draw_drum(axes: "Axes", frames: Frames, index: int) -> None:
    turn = _rotation(float(frames.drum_angles[index]))
    axes.add_collection(
        PolyCollection([line @ turn.T for line in frames.drawn_baffles], facecolors=STEEL, edgecolors=STEEL)
    )
    axes.add_collection(LineCollection([line @ turn.T for line in frames.walls], colors=STEEL, linewidths=2))
    if frames.shell is not None:
        axes.add_patch(Polygon(frames.shell @ turn.T, fill=False, edgecolor=STEEL, linewidth=2.0))
    if frames.drum_radius is not None:
        axes.add_patch(Circle((0.0, 0.0), frames.drum_radius, fill=False, edgecolor=STEEL, linewidth=2.0))
    sense = frames.turning(index)
    if sense and frames.reach is not None:
        _draw_arrow(axes, 1.09 * frames.reach, sense)


def _draw_arrow(axes: "Axes", radius: float, sense: int) -> None:
    """Draw an arc over the top of the drum with a head in the direction of rotation."""
    angles = np.radians(90.0 + sense * np.linspace(-24.0, 24.0, 40))
    arc = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    axes.plot(*arc[:-4].T, color=INK, linewidth=1.2, solid_capstyle="butt")
    head = FancyArrowPatch(
        arc[-6], arc[-1], arrowstyle="-|>", mutation_scale=9, color=INK, shrinkA=0, shrinkB=0
    )
    axes.add_patch(head)


def _draw_bundles(
    axes: "Axes", frames: Frames, index: int, values: Array, scale: _Scale
) -> EllipseCollection:
    centers, radii = frames.positions[index], frames.radii
    discs = EllipseCollection(
        2.0 * radii,
        2.0 * radii,
        np.zeros_like(radii),
        units="xy",
        offsets=centers,
        offset_transform=axes.transData,
        array=values,
        cmap=scale.colors,
        norm=scale.norm,
        edgecolors=INK,
        linewidths=0.4,
    )
    axes.add_collection(discs)
    angles = frames.angles[index]
    ends = centers + radii[:, np.newaxis] * np.column_stack([np.cos(angles), np.sin(angles)])
    marks = np.stack([centers, ends], axis=1)
    axes.add_collection(LineCollection(list(marks), colors=_contrast(scale, values), linewidths=0.9))
    return discs


def _contrast(scale: _Scale, values: Array) -> list[str]:
    """Choose black or white marks, whichever shows on the disc's color."""
    luminance = scale.colors(scale.norm(values))[:, :3] @ np.array([0.2126, 0.7152, 0.0722])
    return ["black" if light > _LIGHT else "white" for light in luminance]


def _rotation(angle: float) -> Array:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
