"""Where the load is and how it moves: the mean solid fraction over the drum, and its velocity as arrows."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patches import Circle

from drumrs.figures.shared import INK, STEEL, drumrs_style, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from drumrs.measures import Fields

# Arrows across the drum, and how far the swiftest reaches, over the distance of two of them.
_ARROWS = 22
_LONGEST = 1.6
# Below this solid fraction there is a bundle so seldom that its velocity says little.
_SELDOM = 0.05


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
        chosen = np.zeros(fields.solid_fraction.shape, dtype=bool)
        chosen[every // 2 :: every, every // 2 :: every] = True
        chosen &= fields.solid_fraction > _SELDOM
        places = np.stack(np.meshgrid(fields.x, fields.y, indexing="ij"), axis=-1)[chosen]
        velocities = fields.velocity[chosen]
        swiftest = float(np.hypot(*velocities.T).max(initial=0.0)) or 1.0
        scale = swiftest * _ARROWS / (2.0 * reach * _LONGEST)
        axes.quiver(
            *places.T, *velocities.T, color=INK, angles="xy", scale_units="xy", scale=scale, width=0.0035
        )
        if drum_radius is not None:
            axes.add_patch(Circle((0.0, 0.0), drum_radius, fill=False, edgecolor=STEEL, linewidth=2.0))
        bar = figure.colorbar(mesh, ax=axes, label="solid fraction", shrink=0.8, pad=0.02)
        bar.ax.set_ylim(0.0, 1.0)
        axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", xlim=(-1.03 * reach, 1.03 * reach))
        axes.set_ylim(-1.03 * reach, 1.03 * reach)
        axes.set_title(f"longest arrow: {swiftest:.2g} m/s", fontsize="small", color="0.35")
    return figure
