"""Fields of density, velocity and stress from the record "fields": sums in cells, smoothed."""

import math
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError
from drumrs.measures.coarse_graining import CUT, Fields
from drumrs.measures.recorded import required

if TYPE_CHECKING:
    import polars as pl

# The columns of which x alone changes the sign in a mirror.
_ODD = ("x", "momentum_x", "momentum_flux_xy", "contact_stress_xy", "contact_stress_yx")
_MOMENTUM = ("momentum_x", "momentum_y")
_FLUX = ("momentum_flux_xx", "momentum_flux_xy", "momentum_flux_xy", "momentum_flux_yy")
_STRESS = ("contact_stress_xx", "contact_stress_xy", "contact_stress_yx", "contact_stress_yy")


def recorded_fields(
    table: "pl.DataFrame | None",
    width: float | None = None,
    *,
    clockwise: bool = False,
    relative_to: float = 0.0,
) -> Fields:
    """Return the coarse-grained fields of a run that has recorded "fields", the stress of contacts included.

    They are means over all samples from the start of the averages' window on. The weight W is a cell smoothed by a
    Gaussian of width w, cut off at 3 w. Fluctuations are taken from the mean velocity at the place of the disc, which
    is taken to be linear within W, by least squares: a load that turns as one body has none.

    Parameters
    ----------
    table
        ``result.fields``.
    width
        w [m]; two cells unless given, which is a mean diameter where ``run.cell`` is not given. 0 leaves the sums as
        they are.
    clockwise
        Whether the drum turned clockwise: fields are then those of the mirror image, as `fields` has them.
    relative_to
        Angular velocity [rad/s], without its sign, of a frame that turns with the drum: velocities are relative to it.
        A load that turns as one body with it has none, whatever the cells.

    Raises
    ------
    ConfigError
        Where fields were not recorded, or the width is below 0 or not finite.

    References
    ----------
    I. Goldhirsch, Granular Matter 12 (2010) 239; T. Weinhart et al., Granular Matter 14 (2012) 289.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import disc_masses, recorded_fields
    >>> changes = {"run.duration": 0.2, "run.window": [0.1, 0.2], "run.record": ["fields"]}
    >>> result = drumrs.run(drumrs.baseline().softer(100.0).replace(changes), progress=False)
    >>> found = recorded_fields(result.fields)
    >>> cell, mass = (found.x[1] - found.x[0]) ** 2, disc_masses(result.config, result.frames).sum()
    >>> bool(abs(found.density.sum() * cell / mass - 1.0) < 1e-12)
    True
    """
    table = required(table, "fields", "the stress of contacts")
    if clockwise:
        table = table.with_columns(-table[name] for name in _ODD).sort("x", "y")
    count = math.isqrt(len(table))
    line = table["y"].to_numpy()[:count]
    side = float(line[1] - line[0])
    grain = 2.0 * side if width is None else width
    if not (math.isfinite(grain) and grain >= 0.0):
        raise ConfigError("width", width, "a finite number of at least 0, in m")
    margin = math.ceil(CUT * grain / side)
    line = np.concatenate(
        [line[0] - side * np.arange(margin, 0, -1), line, line[-1] + side * np.arange(1, margin + 1)]
    )

    def raw(name: str) -> Array:
        return np.pad(table[name].to_numpy().reshape(count, count), margin)

    def smooth(sums: Array) -> Array:
        from scipy import ndimage

        return np.asarray(
            ndimage.gaussian_filter(sums, grain / side, mode="constant", truncate=CUT) if grain else sums
        )

    mass, momentum = raw("density"), np.stack([raw(name) for name in _MOMENTUM], axis=-1)
    density = smooth(mass)
    shape = (*density.shape, 2, 2)
    flux, stress = (
        np.stack([smooth(raw(name)) for name in names], axis=-1).reshape(shape) for names in (_FLUX, _STRESS)
    )
    empty = density <= 0.0
    inverse = np.where(empty, np.nan, 1.0 / np.where(empty, 1.0, density))

    def mean(sums: Array) -> Array:
        """Return means over mass of what has been summed up in cells, of shape (k, k, …)."""
        flat = sums.reshape(*density.shape, -1)
        means = np.stack([smooth(flat[..., i]) for i in range(flat.shape[-1])], axis=-1)
        return (means * inverse[..., np.newaxis]).reshape(sums.shape)

    place = np.stack(np.meshgrid(line, line, indexing="ij"), axis=-1)
    velocity, center = mean(momentum), mean(mass[..., np.newaxis] * place)
    spread = mean(mass[..., np.newaxis, np.newaxis] * _product(place, place)) - _product(center, center)
    sheared = mean(_product(momentum, place)) - _product(velocity, center)
    # Velocity gradient by least squares; nothing is known across a direction in which there is one cell only.
    known = np.nan_to_num(spread)
    gradient = np.nan_to_num(sheared) @ np.linalg.pinv(known, rcond=1e-6, hermitian=True)
    within = known + side**2 / 12.0 * np.eye(2)
    of_flow = _product(velocity, velocity) + gradient @ within @ np.swapaxes(gradient, -1, -2)
    # In the turning frame, which sees each cell's mass where it has its center.
    velocity = velocity - relative_to * np.stack([-center[..., 1], center[..., 0]], axis=-1)
    kinetic = flux - np.nan_to_num(density[..., np.newaxis, np.newaxis] * of_flow)
    return Fields(
        x=line,
        y=line,
        width=grain or 2.0 * side,
        density=density,
        solid_fraction=smooth(raw("solid_fraction")),
        velocity=velocity,
        kinetic_stress=kinetic,
        contact_stress=stress,
    )


def _product(a: Array, b: Array) -> Array:
    """Return the dyads of vectors of shape (…, 2)."""
    return a[..., :, np.newaxis] * b[..., np.newaxis, :]
