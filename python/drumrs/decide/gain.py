"""What further runs may gain: hypervolume, its expected improvement, and which points are not dominated.

Everything is minimized. One objective is the case of a front of one point, whose hypervolume is how far it lies below
the reference.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_FAR = 40.0


def non_dominated(values: Array) -> Mask:
    """Tell which points no other point is better than in one objective and as good in all, shape (n,).

    Parameters
    ----------
    values
        Objectives to be minimized, shape (n, 1) or (n, 2). Of equal points the first counts.

    Examples
    --------
    >>> import numpy as np
    >>> from drumrs.decide.gain import non_dominated
    >>> non_dominated(np.array([[1.0, 3.0], [2.0, 2.0], [3.0, 2.5], [2.0, 2.0]])).tolist()
    [True, True, False, False]
    """
    order = np.lexsort(values.T[::-1])
    # In this order every point is met after all that could dominate it, the last objective deciding.
    last = values[order, -1]
    best_before = np.minimum.accumulate(np.concatenate([[np.inf], last[:-1]]))
    found = np.zeros(len(values), dtype=bool)
    found[order] = last < best_before
    return found


def clearly_non_dominated(values: Array, resolution: float = 1e-3) -> Mask:
    """Tell which points are not dominated, differences below a part of the extent of all values not counting.

    So a point that an emulator takes for better by a rounding error, and that is far worse else, is left out.
    """
    steps = resolution * np.ptp(values, axis=0) if len(values) else np.ones(values.shape[1])
    return non_dominated(np.rint(values / np.where(steps > 0.0, steps, 1.0)))


def hypervolume(values: Array, reference: Array) -> float:
    """Return the volume that points dominate below a reference, for one or two objectives.

    Examples
    --------
    >>> import numpy as np
    >>> from drumrs.decide.gain import hypervolume
    >>> hypervolume(np.array([[1.0, 3.0], [2.0, 2.0]]), np.array([4.0, 4.0]))
    5.0
    """
    front = _front(values, reference)
    if values.shape[1] == 1:
        return float(np.sum(reference - front))
    return float(np.sum(np.diff(np.append(front[:, 0], reference[0])) * (reference[1] - front[:, 1])))


def expected_improvement(means: Array, errors: Array, front: Array, reference: Array) -> Array:
    """Return by how much points are expected to enlarge the hypervolume, shape (n,).

    For one objective this is the expected improvement over the best value (Jones, Schonlau & Welch 1998), for two the
    expected hypervolume improvement in closed form (Yang, Emmerich, Deutz & Bäck 2019), objectives being independent:
    the plane below the front falls into strips, and in each the gain is a product of two one-dimensional ones.

    Parameters
    ----------
    means, errors
        Predictions at the points, shape (n, 1) or (n, 2).
    front
        Objectives of what is known, shape (m, 1) or (m, 2); what is dominated does not matter.
    reference
        Where the hypervolume ends, shape (1,) or (2,).
    """
    front = _front(front, reference)
    if means.shape[1] == 1:
        best = front[0] if len(front) else reference
        return _expected_below(best, means, errors)[:, 0]
    edges = np.append(front[:, 0], reference[0])
    heights = np.concatenate([[reference[1]], front[:, 1]])
    reach = _expected_below(edges, means[:, :1], errors[:, :1])
    widths = np.diff(reach, axis=1, prepend=0.0)
    gain: Array = np.sum(widths * _expected_below(heights, means[:, 1:], errors[:, 1:]), axis=1)
    return gain


def _expected_below(limits: Array, means: Array, errors: Array) -> Array:
    """Return the mean of max(limit − y, 0) for y normal, shape (n, limits)."""
    from scipy.special import ndtr

    # So far out the density is 0 in floating point; without errors all is.
    z = np.clip((limits - means) / np.maximum(errors, 1e-100), -_FAR, _FAR)
    density = np.exp(-0.5 * z**2) / np.sqrt(2.0 * np.pi)
    found: Array = np.maximum((limits - means) * ndtr(z) + errors * density, 0.0)
    return found


def _front(values: Array, reference: Array) -> Array:
    """Return the points that are not dominated and lie below the reference, sorted by the first objective."""
    below = values[(values < reference).all(axis=1)]
    kept = below[non_dominated(below)] if len(below) else below
    return kept[np.argsort(kept[:, 0])]
