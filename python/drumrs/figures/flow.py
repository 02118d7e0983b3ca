"""Where the load is, how it moves and what it bears: solid fraction with arrows, and pressure with its directions."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle

from drumrs.figures.shared import INK, STEEL, Array, drumrs_style, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from drumrs.measures import Fields

# Arrows across the drum, and how far the swiftest reaches, over the distance of two of them.
_ARROWS = 22
_LONGEST = 1.6
# Below this solid fraction there is a bundle so seldom that its velocity says little.
_SELDOM = 0.05
# Crosses of principal stress across the drum; a pressure above this share of all has the last color.
_CROSSES, _TYPICAL = 18, 0.995


def flow(fields: "Fields", drum_radius: float | None = None) -> "Figure":
    """Draw the mean solid fraction over the drum, with arrows for the mean velocity of the load.

    Parameters
    ----------
    fields
        What `measures.fields` returns: of a drum that turns counter-clockwise, or of the mirror image.
    drum_radius
        Radius of the rim [m], drawn where it is given.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs import figures, measures
    >>> result = drumrs.run(drumrs.baseline().replace({"run.duration": 0.2}), progress=False)
    >>> masses = measures.disc_masses(result.config, result.frames)
    >>> figure = figures.flow(measures.fields(result.frames, (0.0, 0.2), masses), result.frames.drum_radius)
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['y [m]', 'solid fraction']
    """
    reach = drum_radius or float(fields.x.max())
    with drumrs_style():
        figure = new_figure(5.0, 4.1)
        axes = figure.subplots()
        shown = np.ma.masked_less_equal(fields.solid_fraction.T, 0.01)
        mesh = axes.pcolormesh(fields.x, fields.y, shown, cmap="Blues", vmin=0.0, vmax=1.2, rasterized=True)
        every = max(1, round(2.0 * reach / _ARROWS / float(fields.x[1] - fields.x[0])))
        chosen = _spaced(fields, every)
        points = np.stack(np.meshgrid(fields.x, fields.y, indexing="ij"), axis=-1)[chosen]
        velocities = fields.velocity[chosen]
        swiftest = float(np.hypot(*velocities.T).max(initial=0.0)) or 1.0
        scale = swiftest * _ARROWS / (2.0 * reach * _LONGEST)
        axes.quiver(
            *points.T, *velocities.T, color=INK, angles="xy", scale_units="xy", scale=scale, width=0.0035
        )
        _draw_drum(axes, reach, drum_radius)
        bar = figure.colorbar(mesh, ax=axes, label="solid fraction", shrink=0.8, pad=0.02)
        bar.ax.set_ylim(0.0, 1.0)
        axes.set_title(f"longest arrow: {swiftest:.2g} m/s", fontsize="small", color="0.35")
    return figure


def stress(fields: "Fields", drum_radius: float | None = None) -> "Figure":
    """Draw the mean pressure in the load, with crosses for its principal stresses.

    Parameters
    ----------
    fields
        What `measures.recorded_fields` returns: of a drum that turns counter-clockwise, or of the mirror image.
    drum_radius
        Radius of the rim [m], drawn where it is given.

    Returns
    -------
    Figure
        The color is the pressure, half the trace of the stress of contacts and fluctuations. Each cross has its arms
        along the principal stresses, as long as these over the pressure; the longer one is the direction of the forces.

    Raises
    ------
    ConfigError
        Where the fields are made of frames, which have no forces.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs import figures, measures
    >>> changes = {"run.duration": 0.2, "run.window": [0.1, 0.2], "run.record": ["fields"]}
    >>> result = drumrs.run(drumrs.baseline().softer(100.0).replace(changes), progress=False)
    >>> figure = figures.stress(measures.recorded_fields(result.fields), result.frames.drum_radius)
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['y [m]', 'pressure [Pa]']
    """
    reach, pressure = drum_radius or float(fields.x.max()), fields.pressure
    with drumrs_style():
        figure = new_figure(5.0, 4.1)
        axes = figure.subplots()
        borne = pressure[fields.solid_fraction > _SELDOM]
        most = float(np.quantile(borne, _TYPICAL)) if len(borne) else 1.0
        shown = np.ma.masked_where(fields.solid_fraction.T <= _SELDOM, pressure.T)
        mesh = axes.pcolormesh(fields.x, fields.y, shown, cmap="YlOrBr", vmin=0.0, vmax=most, rasterized=True)
        every = max(1, round(2.0 * reach / _CROSSES / float(fields.x[1] - fields.x[0])))
        within = np.hypot(*np.meshgrid(fields.x, fields.y, indexing="ij")) < reach
        chosen = _spaced(fields, every) & (pressure > 0.0) & within
        arms = _arms(fields, chosen, 0.45 * every * float(fields.x[1] - fields.x[0]))
        axes.add_collection(LineCollection(list(arms), colors=INK, linewidths=0.8))
        _draw_drum(axes, reach, drum_radius)
        figure.colorbar(mesh, ax=axes, label="pressure [Pa]", shrink=0.8, pad=0.02, extend="max")
        axes.set_title("arms: principal stresses over the pressure", fontsize="small", color="0.35")
    return figure


def _arms(fields: "Fields", chosen: "NDArray[np.bool_]", unit: float) -> Array:
    """Return the arms of crosses as lines through the chosen nodes, two each, shape (2 n, 2, 2)."""
    total = fields.stress[chosen]
    # Its antisymmetric part, which torques on discs make, has no directions.
    values, directions = np.linalg.eigh(0.5 * (total + np.swapaxes(total, -1, -2)))
    half = 0.5 * unit * (values / fields.pressure[chosen][:, np.newaxis])[:, np.newaxis, :] * directions
    points = np.stack(np.meshgrid(fields.x, fields.y, indexing="ij"), axis=-1)[chosen][:, :, np.newaxis]
    lines: Array = np.stack([points - half, points + half], axis=-1).transpose(0, 2, 3, 1).reshape(-1, 2, 2)
    return lines


def _spaced(fields: "Fields", every: int) -> "NDArray[np.bool_]":
    """Tell which nodes have a mark: every so many, where there is load."""
    chosen = np.zeros(fields.solid_fraction.shape, dtype=bool)
    chosen[every // 2 :: every, every // 2 :: every] = True
    marked: NDArray[np.bool_] = chosen & (fields.solid_fraction > _SELDOM)
    return marked


def _draw_drum(axes: "Axes", reach: float, drum_radius: float | None) -> None:
    if drum_radius is not None:
        axes.add_patch(Circle((0.0, 0.0), drum_radius, fill=False, edgecolor=STEEL, linewidth=2.0))
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", xlim=(-1.03 * reach, 1.03 * reach))
    axes.set_ylim(-1.03 * reach, 1.03 * reach)
