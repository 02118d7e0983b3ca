"""Indices of mixing over square cells, of one moment and one coloring; and how Lacey's grows with turns of the drum.

They are functions of places and colors alone, so any moment and any coloring will do. An index of 1 is what a coloring
at random has on average, so that neither the number of discs nor the size of cells has to be argued away.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.analysis.blocks import Array
from drumrs.measures.colors import Colors, cell_side, cells_of, coloring
from drumrs.measures.frame_window import turn_back, within

if TYPE_CHECKING:
    from drumrs.frames import Frames


# Colorings at random that make a null.
_PERMUTATIONS = 200


def lacey(points: ArrayLike, colors: ArrayLike, side: float, masses: ArrayLike | None = None) -> float:
    """Return Lacey's index M = (σ₀² − σ²) / (σ₀² − σ_r²) over square cells.

    σ² = Σ w_k (c_k − p)² is the variance of the colored share c_k of cell k about that of all, p, with the weights
    w_k = n_k/N; σ₀² = p (1 − p) is that of pure cells. The null is exact for K cells and N discs of whatever
    distribution over them: of colorings at random, without replacement, σ² is σ_r² = σ₀² (K − 1)/(N − 1) on average.
    With masses, shares and weights are by mass, and σ_r² is the mean over 200 permutations of the colors.

    Parameters
    ----------
    points
        Centers of the discs [m], shape (n, 2).
    colors
        Which of them are colored, shape (n,).
    side
        Side of the cells [m].
    masses
        Masses of the discs, where they shall count, shape (n,).

    Returns
    -------
    float
        0 for pure cells, 1 for a load as mixed as chance makes it, on average; more where cells are more alike.

    References
    ----------
    P. M. C. Lacey, J. Appl. Chem. 4 (1954) 257; the null is the variance of sampling without replacement.

    Examples
    --------
    >>> import numpy as np
    >>> from drumrs.measures import lacey
    >>> points = np.array([[0.1, 0.1], [0.2, 0.2], [1.1, 0.1], [1.2, 0.2]])
    >>> pure, alike = [True, True, False, False], [True, False, True, False]
    >>> lacey(points, pure, side=1.0), round(lacey(points, alike, side=1.0), 3)
    (0.0, 1.5)
    """
    cells, colored = cells_of(np.asarray(points, dtype=np.float64), side), np.asarray(colors, dtype=bool)
    weights = np.ones(len(cells)) if masses is None else np.asarray(masses, dtype=np.float64)
    weights = weights / weights.sum()
    share = float(weights[colored].sum())
    pure = share * (1.0 - share)
    if masses is None:
        null = pure * float(cells.max()) / (len(cells) - 1.0)
    else:
        null = _null(colored, lambda other: _variance(cells, other, weights))
    return (pure - _variance(cells, colored, weights)) / (pure - null)


def relative_deviation(points: ArrayLike, colors: ArrayLike, side: float) -> float:
    """Return the relative standard deviation σ/p of the colored share over square cells; see `lacey`."""
    cells, colored = cells_of(np.asarray(points, dtype=np.float64), side), np.asarray(colors, dtype=bool)
    weights = np.full(len(cells), 1.0 / len(cells))
    return float(np.sqrt(_variance(cells, colored, weights)) / colored.mean())


def _variance(cells: NDArray[np.intp], colored: Colors, weights: Array) -> float:
    """Return Σ w_k (c_k − p)² over cells."""
    all_of_it = np.bincount(cells, weights)
    shares = np.bincount(cells, weights * colored) / all_of_it
    return float((all_of_it * (shares - weights[colored].sum()) ** 2).sum())


def entropy(points: ArrayLike, colors: ArrayLike, side: float) -> float:
    """Return the entropy of the colors over square cells, over that of colorings at random.

    S = −Σ w_k Σ c ln c, with the weights and shares of `lacey`, over its mean for 200 permutations of the colors: S
    over its greatest value, ln 2 for equal shares, stays below 1 even for a load that is mixed (Gu & Chen, Chem. Eng.
    Res. Des., 2014).

    Returns
    -------
    float
        0 for pure cells, 1 for a load as mixed as chance makes it, on average.
    """
    cells, colored = cells_of(np.asarray(points, dtype=np.float64), side), np.asarray(colors, dtype=bool)
    counts = np.bincount(cells)

    def of(other: Colors) -> float:
        from scipy.special import entr

        shares = np.bincount(cells, other) / counts
        return float((counts * (entr(shares) + entr(1.0 - shares))).sum())

    return of(colored) / _null(colored, of)


def _null(colored: Colors, index: Callable[[Colors], float]) -> float:
    """Return the mean of an index over colorings at random, the same ones for every coloring of as many discs."""
    draws, in_order = np.random.default_rng(0), np.sort(colored)
    return float(np.mean([index(draws.permutation(in_order)) for _ in range(_PERMUTATIONS)]))


def mixing_curve(
    frames: "Frames", window: tuple[float, float], by: str, sides: Sequence[float] | None = None
) -> tuple[Array, Array]:
    """Return Lacey's index over the turns of the drum, for a coloring of the first frame of a window.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].
    by
        The coloring, as for `coloring`. The verdict depends on it, so try several.
    sides
        Sides of the cells [m]; such as hold 5, 10 and 20 discs unless given.

    Returns
    -------
    turns, index
        Turns of the drum since the first frame, shape (frames,), and the index, shape (sides, frames). Cells are those
        of the turning drum, so that a load that turns with it as one body does not mix.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, or nothing or everything would be colored.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import mixing_curve
    >>> config = drumrs.baseline().replace({"run.duration": 0.4, "run.frame_every": 0.1})
    >>> turns, index = mixing_curve(drumrs.run(config, progress=False).frames, (0.2, 0.4), by="side")
    >>> index.shape, bool((index[:, 0] < 0.5).all())
    ((3, 3), True)
    """
    seen = within(frames, window)
    colors = coloring(seen, by)
    places = [
        positions.astype(np.float64) @ turn_back(angle - seen.drum_angles[0])
        for positions, angle in zip(seen.positions, seen.drum_angles, strict=True)
    ]
    lengths = [cell_side(places[0], count) for count in (5, 10, 20)] if sides is None else sides
    turns: Array = np.abs(seen.drum_angles - seen.drum_angles[0]) / (2.0 * np.pi)
    return turns, np.array([[lacey(points, colors, side) for points in places] for side in lengths])
