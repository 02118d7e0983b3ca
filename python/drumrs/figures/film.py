"""`Film`: frames of a run as pictures one after the other, with the drum and a trace of the power.

Whatever stays is drawn once. Of each picture only what moves is drawn anew, which takes a tenth of the time.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.patches import Rectangle
from matplotlib.transforms import Affine2D
from numpy.typing import NDArray

from drumrs.errors import ConfigError
from drumrs.figures import labels
from drumrs.figures.history import draw_power
from drumrs.figures.shared import INK, STEEL, drumrs_style, label_lines, line_colors, new_figure
from drumrs.frames import Frames

if TYPE_CHECKING:
    from collections.abc import Iterator

    import polars as pl
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

# What colors may stand for.
COLORS = ("speed", "species", "height")
# Inches. Axes are given as parts of them: left, bottom, width, height.
_WIDTH, _HEIGHT = 6.4, 7.8
_DRUM, _BAR, _TRACE = (0.02, 0.2, 0.96, 0.76), (0.035, 0.245, 0.2, 0.012), (0.09, 0.06, 0.72, 0.105)
# Speeds beyond so many per cent of all have the last color.
_MOST = 99.5
# Relative luminance on which black shows better than white.
_LIGHT = 0.4


@dataclass(frozen=True)
class _Coloring:
    """Values of the bundles, of shape (frames, n) or (n,), and their colors; names where they are kinds."""

    values: NDArray[np.floating[Any]]
    norm: Normalize
    colors: mpl.colors.Colormap
    label: str
    names: tuple[str, ...] = ()


class Film:
    """Pictures of a run.

    Parameters
    ----------
    frames
        Frames of the run.
    series
        Its series, for the trace of the power.
    title
        Written over the drum.
    color
        What colors stand for: ``"speed"``, ``"species"``, or ``"height"``, that at the first frame, which shows mixing.
    width
        Width of a picture [pixels]; the height follows. Both are even, as films need them.

    Raises
    ------
    ConfigError
        Where there is no such color.
    """

    def __init__(
        self, frames: Frames, series: "pl.DataFrame", title: str = "", color: str = "speed", width: int = 720
    ) -> None:
        self._frames = frames
        with drumrs_style():
            self._coloring = _coloring(frames, color)
            figure = new_figure(_WIDTH, _HEIGHT)
            figure.set_layout_engine("none")
            # Of what redraws a part, matplotlib tells no types.
            canvas: Any = FigureCanvasAgg(figure)
            self._canvas = canvas
            dpi = width / _WIDTH
            figure.set_dpi(dpi)
            figure.set_size_inches(_even(width) / dpi, _even(_HEIGHT * dpi) / dpi)
            figure.text(0.03, 0.965, title, fontsize="medium")
            axes = figure.add_axes(_DRUM)
            self._moving = [*self._draw_drum(axes), *self._draw_bundles(axes)]
            self._time = axes.text(0.995, 0.965, "", transform=axes.transAxes, ha="right")
            trace = figure.add_axes(_TRACE)
            draw_power(trace, {name: series[name].to_numpy() for name in series.columns})
            trace.set(
                xlim=(frames.times[0], max(frames.times[-1], frames.times[0] + 1e-9)), xlabel=labels.TIME
            )
            label_lines(trace)
            low, high = trace.get_ylim()
            # What has not come yet is pale.
            self._future = Rectangle((0.0, low), 0.0, high - low, facecolor="white", alpha=0.75, zorder=3)
            trace.add_patch(self._future)
            self._moving += [self._time, self._future]
            for artist in self._moving:
                artist.set_animated(True)
            canvas.draw()
            self._still = canvas.copy_from_bbox(figure.bbox)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of a picture [pixels]."""
        width, height = self._canvas.get_width_height()
        return width, height

    def picture(self, index: int) -> NDArray[np.uint8]:
        """Return the picture of a frame: red, green, blue and opacity, of shape (height, width, 4)."""
        frames = self._frames
        self._turn.clear().rotate(float(frames.drum_angles[index]))
        centers, angles = frames.positions[index], frames.angles[index]
        values = self._coloring.values
        shown = values[index] if values.ndim > 1 else values
        self._discs.set_offsets(centers)
        self._discs.set_array(shown)
        ends = centers + frames.radii[:, np.newaxis] * np.column_stack([np.cos(angles), np.sin(angles)])
        self._marks.set_segments(np.stack([centers, ends], axis=1))  # type: ignore[arg-type]
        light = self._coloring.colors(self._coloring.norm(shown))[:, :3] @ np.array([0.2126, 0.7152, 0.0722])
        self._marks.set_color(
            np.where(light[:, np.newaxis] > _LIGHT, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)).tolist()
        )
        time, last = float(frames.times[index]), float(frames.times[-1])
        self._time.set_text(f"t = {time:.2f} s")
        self._future.set_bounds(time, self._future.get_y(), last - time, self._future.get_height())
        self._canvas.restore_region(self._still)
        for artist in self._moving:
            self._canvas.figure.draw_artist(artist)
        return np.array(self._canvas.buffer_rgba())

    def _draw_drum(self, axes: "Axes") -> "Iterator[Artist]":
        """Draw the drum; what it consists of turns with one transform."""
        frames = self._frames
        self._turn = Affine2D()
        lines = frames.outline()
        solid = [line.points for line in lines if line.part.startswith("baffle")]
        thin = [line.points for line in lines if not line.part.startswith("baffle")]
        for drawn in (
            PolyCollection(solid, facecolors=STEEL, edgecolors=STEEL),
            LineCollection(thin, colors=STEEL, linewidths=2.0),
        ):
            drawn.set_transform(self._turn + axes.transData)
            yield axes.add_collection(drawn, autolim=False)
        points = np.concatenate([frames.positions.reshape(-1, 2), *(line.points for line in lines)])
        reach = 1.02 * (frames.reach or float(np.abs(points).max() + frames.radii.max(initial=0.0)))
        axes.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
        axes.axis("off")

    def _draw_bundles(self, axes: "Axes") -> "Iterator[Artist]":
        """Draw bundles with a radius on each, and what their colors stand for."""
        coloring, sizes = self._coloring, 2.0 * self._frames.radii
        self._discs = EllipseCollection(
            sizes,
            sizes,
            np.zeros_like(sizes),
            units="xy",
            offsets=self._frames.positions[0],
            offset_transform=axes.transData,
            cmap=coloring.colors,
            norm=coloring.norm,
            edgecolors=INK,
            linewidths=0.4,
        )
        self._marks = LineCollection([], linewidths=0.9)
        for drawn in (self._discs, self._marks):
            yield axes.add_collection(drawn, autolim=False)
        ticks = range(len(coloring.names)) if coloring.names else None
        figure = axes.get_figure()
        bar = figure.colorbar(self._discs, cax=figure.add_axes(_BAR), orientation="horizontal", ticks=ticks)  # type: ignore[union-attr]
        bar.ax.set_title(coloring.label, fontsize="small")
        bar.ax.tick_params(labelsize="small")
        bar.outline.set_visible(False)
        if coloring.names:
            bar.ax.set_xticklabels(coloring.names, rotation=20.0, ha="right")


def _coloring(frames: Frames, color: str) -> _Coloring:
    several = sorted(set(frames.species))
    if color not in COLORS or (color == "species" and not several):
        words = ", ".join(COLORS if several else [name for name in COLORS if name != "species"])
        hint = "" if several or color != "species" else "the load of this run has one species"
        raise ConfigError("color", color, f"one of {words}", hint=hint)
    if color == "species":
        tints = [line_colors()[place % len(line_colors())] for place in range(len(several))]
        values = np.array([several.index(name) for name in frames.species], float)
        norm = Normalize(-0.5, len(several) - 0.5)
        return _Coloring(values, norm, ListedColormap(tints), "", tuple(several))
    viridis = mpl.colormaps["viridis"]
    if color == "speed":
        fastest = float(np.percentile(frames.speeds, _MOST)) if frames.speeds.size else 0.0
        return _Coloring(frames.speeds, Normalize(0.0, fastest or 1.0), viridis, "speed [m/s]")
    heights = frames.positions[0, :, 1]
    norm = Normalize(float(heights.min(initial=0.0)), float(heights.max(initial=0.0)))
    return _Coloring(heights, norm, viridis, "height at the start [m]")


def _even(pixels: float) -> int:
    return 2 * round(pixels / 2.0)
