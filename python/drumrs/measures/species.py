"""Who has how much: number, mass and kinetic energy of each species."""

from typing import TYPE_CHECKING

import numpy as np

from drumrs.measures.frame_window import with_errors, within
from drumrs.measures.masses import disc_masses

if TYPE_CHECKING:
    import polars as pl

    from drumrs.config import Config
    from drumrs.frames import Frames


def by_species(config: "Config", frames: "Frames", window: tuple[float, float]) -> "pl.DataFrame":
    """Return a row for each species, in the order of ``load.species``.

    Parameters
    ----------
    config
        The configuration of the run.
    frames
        Its frames.
    window
        Start and end of the mean over time [s].

    Returns
    -------
    polars.DataFrame
        ``species``, its name; ``bundle_count``; ``load_mass``, with the water that it holds [kg/m];
        ``kinetic_translation``, the mean of Σ ½ m v² over its bundles [J/m], with ``kinetic_translation_error``, null
        where the window is too short to tell. There is no row where the load has no species.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import by_species
    >>> species = [{"name": name, "preset": name, "share": 0.5} for name in ("steel-ball", "ore")]
    >>> changes = {"load.species": species, "load.share_by": "number", "run.time_step": "auto"}
    >>> config = drumrs.baseline().replace({**changes, "run.duration": 0.2})
    >>> found = by_species(config, drumrs.run(config, progress=False).frames, (0.1, 0.2))
    >>> found["species"].to_list(), found["bundle_count"].to_list()
    (['steel-ball', 'ore'], [50, 50])
    """
    import polars as pl

    seen = within(frames, window)
    masses, names = disc_masses(config, frames), np.array(frames.species)
    energies = 0.5 * masses * seen.speeds.astype(np.float64) ** 2
    own = {name: names == name for name in config.load.names}
    means = with_errors(
        lambda part: {name: energies[part][:, of].sum(axis=1).mean() for name, of in own.items()}, seen.times
    )
    rows = [
        {
            "species": name,
            "bundle_count": int(of.sum()),
            "load_mass": float(masses[of].sum()),
            "kinetic_translation": means[name].value,
            "kinetic_translation_error": means[name].error,
        }
        for name, of in own.items()
    ]
    return pl.DataFrame(rows, infer_schema_length=None)
