"""Fields of density, velocity and fluctuation from frames, by coarse graining: sums over discs with a smooth weight."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError
from drumrs.measures.frame_window import counter_clockwise, within

if TYPE_CHECKING:
    from drumrs.frames import Frames

# The weight is cut off at so many widths, and the grid has so many nodes in one.
CUT, _NODES = 3.0, 2.0
# The bed is where the solid fraction is above half of what nine in ten nodes that discs reach stay below.
_BED, _MOST = 0.5, 0.9


@dataclass(frozen=True, eq=False)
class Fields:
    """Means over a window on a square grid, in the laboratory's frame, of a drum that turns counter-clockwise.

    Attributes
    ----------
    x, y
        Places of the nodes [m], shape (k,) each; all fields have the shape (k, k), by x and by y, and what follows.
    width
        Width w of the weight [m].
    density
        ρ = Σ m W [kg/m³].
    solid_fraction
        Σ A W, with the areas of the discs.
    velocity
        u = Σ m v W / ρ [m/s], shape (k, k, 2); not a number where no disc comes near.
    kinetic_stress
        Σ m v′ v′ W [Pa], v′ = v − u at the place of the disc, shape (k, k, 2, 2).
    contact_stress
        Σ F ⊗ ∫ W along the branch of each contact [Pa], with the force on the other body; pressure is positive, shape
        (k, k, 2, 2). `None` where the fields are made of frames, which have no forces.
    """

    x: Array
    y: Array
    width: float
    density: Array
    solid_fraction: Array
    velocity: Array
    kinetic_stress: Array
    contact_stress: Array | None = None

    @property
    def fluctuation(self) -> Array:
        """½ ⟨v′·v′⟩ [m²/s²], the granular temperature in two dimensions, shape (k, k)."""
        with np.errstate(invalid="ignore", divide="ignore"):
            trace: Array = self.kinetic_stress[..., 0, 0] + self.kinetic_stress[..., 1, 1]
            temperature: Array = 0.5 * trace / self.density
        return temperature

    @property
    def stress(self) -> Array:
        """The stress of contacts and of fluctuations [Pa], shape (k, k, 2, 2).

        Raises
        ------
        ConfigError
            Where the fields are made of frames, which have no forces.
        """
        if self.contact_stress is None:
            problem = "lacks 'fields', needed for the stress of contacts"
            raise ConfigError("run.record", problem=problem, hint="add 'fields' to it and run again")
        return self.contact_stress + self.kinetic_stress

    @property
    def pressure(self) -> Array:
        """Half of the trace of `stress` [Pa], shape (k, k)."""
        pressure: Array = 0.5 * np.trace(self.stress, axis1=-2, axis2=-1)
        return pressure

    @property
    def bed(self) -> NDArray[np.bool_]:
        """Where the bed is: nodes with half of the solid fraction of dense ones, and more; shape (k, k)."""
        reached = self.solid_fraction[self.solid_fraction > 0.0]
        level = _BED * float(np.quantile(reached, _MOST)) if len(reached) else math.inf
        bed: NDArray[np.bool_] = self.solid_fraction > level
        return bed


def fields(
    frames: "Frames",
    window: tuple[float, float],
    masses: ArrayLike,
    width: float | None = None,
    *,
    relative: bool = False,
) -> Fields:
    """Return the coarse-grained fields of a window.

    W is a Gaussian of width w, cut off at 3 w and normalized to that: W(r) = exp(−r²/2w²) / (2 π w² (1 − e^{−9/2})).
    Sums run over discs and frames, so velocities are means weighted by mass. Fluctuations are taken from the mean
    velocity at the place of the disc: v − u(r), taken at the node instead, would be Ω² w² in each direction for a load
    that turns as one body, where v − u(r_i) is 0.

    Parameters
    ----------
    frames
        Frames of a run in a drum.
    window
        Start and end [s].
    masses
        Masses of the discs [kg/m], see `disc_masses`.
    width
        w [m]; a mean diameter unless given. Try half of it and twice: fields that change are not yet fields.
    relative
        Whether velocities are relative to the turning drum.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, or the drum has neither rim nor shell.

    References
    ----------
    I. Goldhirsch, Granular Matter 12 (2010) 239; T. Weinhart et al., Granular Matter 14 (2012) 289.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import disc_masses, fields
    >>> result = drumrs.run(drumrs.baseline().replace({"run.duration": 0.2}), progress=False)
    >>> masses = disc_masses(result.config, result.frames)
    >>> found = fields(result.frames, (0.0, 0.2), masses)
    >>> cell = (found.x[1] - found.x[0]) ** 2
    >>> bool(abs(found.density.sum() * cell / masses.sum() - 1.0) < 0.01)
    True
    """
    if frames.reach is None:
        raise ConfigError("drum.rim", False, "true: the grid covers the drum")
    seen = counter_clockwise(within(frames, window))
    grain = 2.0 * float(frames.radii.mean()) if width is None else width
    grid = _Grid(frames.reach, grain)
    weights, areas = np.asarray(masses, dtype=np.float64), math.pi * frames.radii**2
    speeds = np.gradient(seen.drum_angles, seen.times) if relative else np.zeros(len(seen))

    def moving() -> Iterator[tuple[Array, Array]]:
        for positions, velocities, speed in zip(seen.positions, seen.velocities, speeds, strict=True):
            place = positions.astype(np.float64)
            yield place, velocities - speed * np.column_stack([-place[:, 1], place[:, 0]])

    count = len(grid.line)
    density, solid, momentum = np.zeros(count**2), np.zeros(count**2), np.zeros((count**2, 2))
    for place, velocity in moving():
        nodes, near = grid.weights(place)
        density += grid.sums(nodes, near, weights)
        solid += grid.sums(nodes, near, areas)
        for axis in range(2):
            momentum[:, axis] += grid.sums(nodes, near, weights * velocity[:, axis])
    with np.errstate(invalid="ignore"):
        mean = np.asarray(momentum / density[:, np.newaxis], dtype=np.float64).reshape(count, count, 2)
    stress = np.zeros((count**2, 2, 2))
    for place, velocity in moving():
        nodes, near = grid.weights(place)
        off = velocity - grid.at(mean, place)
        for a, b in ((0, 0), (0, 1), (1, 1)):
            stress[:, a, b] += grid.sums(nodes, near, weights * off[:, a] * off[:, b])
    stress[:, 1, 0] = stress[:, 0, 1]
    shape, number = (count, count), len(seen)
    return Fields(
        x=grid.line,
        y=grid.line,
        width=grain,
        density=density.reshape(shape) / number,
        solid_fraction=solid.reshape(shape) / number,
        velocity=mean,
        kinetic_stress=stress.reshape(*shape, 2, 2) / number,
    )


class _Grid:
    """A square grid over a drum and a margin, so that no disc's weight is cut."""

    def __init__(self, reach: float, width: float) -> None:
        self._width, self._step = width, width / _NODES
        self._half = math.ceil(CUT * _NODES) + 1
        count = math.ceil(reach / self._step) + self._half
        self.line: Array = self._step * np.arange(-count, count + 1, dtype=np.float64)

    def weights(self, points: Array) -> tuple[NDArray[np.intp], Array]:
        """Return the nodes about each point and their weights, of shape (points, nodes)."""
        offsets = np.arange(-self._half, self._half + 1)
        nearest = np.rint((points - self.line[0]) / self._step).astype(np.intp)
        columns = [nearest[:, axis, np.newaxis] + offsets for axis in range(2)]
        squares = [(self.line[columns[axis]] - points[:, axis, np.newaxis]) ** 2 for axis in range(2)]
        distance = squares[0][:, :, np.newaxis] + squares[1][:, np.newaxis, :]
        norm = 2.0 * math.pi * self._width**2 * (1.0 - math.exp(-0.5 * CUT**2))
        weight = np.exp(-0.5 * distance / self._width**2) / norm
        weight[distance > (CUT * self._width) ** 2] = 0.0
        nodes = columns[0][:, :, np.newaxis] * len(self.line) + columns[1][:, np.newaxis, :]
        return nodes.reshape(len(points), -1), weight.reshape(len(points), -1)

    def sums(self, nodes: NDArray[np.intp], weights: Array, values: Array) -> Array:
        """Return the sums of values times weights over points, node by node."""
        terms = weights * values[:, np.newaxis]
        sums: Array = np.bincount(nodes.ravel(), terms.ravel(), len(self.line) ** 2).astype(np.float64)
        return sums

    def at(self, field: Array, points: Array) -> Array:
        """Return a field of shape (k, k, 2) at some points, linear between nodes."""
        place = (points - self.line[0]) / self._step
        corner = np.floor(place).astype(np.intp)
        share = place - corner
        found = np.zeros_like(points)
        for i in (0, 1):
            for j in (0, 1):
                part = np.abs(1.0 - i - share[:, 0]) * np.abs(1.0 - j - share[:, 1])
                found += part[:, np.newaxis] * field[corner[:, 0] + i, corner[:, 1] + j]
        return found


def center_of_circulation(of: Fields) -> Array:
    """Return the place in the bed where the mean velocity vanishes [m], shape (2,).

    About the node of the bed with the least speed the velocity is taken to be linear, by least squares over the nodes
    within two widths. Where that has no zero nearby, the node is returned.

    Parameters
    ----------
    of
        Fields, with velocities in the laboratory's frame.

    Raises
    ------
    ConfigError
        Where there is no bed.
    """
    from scipy import ndimage

    # The bed without its edge, one and a half widths, where the weight sees one side only.
    inner = ndimage.binary_erosion(of.bed, iterations=math.ceil(1.5 * _NODES))
    if not inner.any():
        raise ConfigError("frames", "of a load without a bed", "of a bed some diameters deep")
    speed = np.where(inner, np.hypot(of.velocity[..., 0], of.velocity[..., 1]), np.inf)
    i, j = np.unravel_index(int(speed.argmin()), speed.shape)
    node = np.array([of.x[i], of.y[j]])
    x, y = np.meshgrid(of.x, of.y, indexing="ij")
    near = of.bed & (np.hypot(x - node[0], y - node[1]) <= _NODES * of.width)
    columns = np.column_stack([np.ones(int(near.sum())), x[near] - node[0], y[near] - node[1]])
    flow = np.linalg.lstsq(columns, of.velocity[near], rcond=None)[0]
    shift, *_ = np.linalg.lstsq(flow[1:].T, -flow[0], rcond=None)
    center: Array = node + shift if np.hypot(*shift) <= _NODES * of.width else node
    return center
