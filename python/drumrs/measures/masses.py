"""Masses of the discs of a run's frames."""

from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array

if TYPE_CHECKING:
    from drumrs.config import Config
    from drumrs.frames import Frames


def disc_masses(config: "Config", frames: "Frames") -> Array:
    """Return the masses of the discs of a run, with the water that they hold [kg/m], shape (n,).

    A disc has the mass ρ π r² per meter of depth, with the wet density of its species.

    Parameters
    ----------
    config
        The configuration of the run.
    frames
        Its frames.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import disc_masses
    >>> result = drumrs.run(drumrs.baseline().replace({"run.duration": 0.01}), progress=False)
    >>> mass = disc_masses(result.config, result.frames).sum()
    >>> bool(abs(mass / result.config.derived.load_mass - 1.0) < 1e-12)
    True
    """
    load = config.load
    own = {species.name: species.density for species in load.species or ()}
    densities = [load.wet(own.get(name) or load.density) for name in frames.species or ("",) * frames.count]
    masses: Array = np.pi * frames.radii**2 * np.array(densities)
    return masses
