"""A Gaussian process over shapes for each observable, with the noise of every run known."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drumrs.errors import ConfigError
from drumrs.paper.baffle.evidence import Means, Observable
from drumrs.paper.baffle.sentences import OBSERVABLES
from drumrs.paper.shape import BASES, HEIGHTS, Shape

Array = NDArray[np.float64]

_LOW = np.array([HEIGHTS[0], BASES[0], 0.0])
_RANGE = np.array([HEIGHTS[1], BASES[1], BASES[1]]) - _LOW
# Lengths over which an observable changes, over the range of the shapes, and its variance over that of the values.
_LENGTHS, _VARIANCES = (0.1, 20.0), (1e-2, 1e2)
# Noise below this part of the spread is not believed: a share of exactly 0 has no error of its own.
_LEAST_NOISE = 0.02


def require_library() -> None:
    """Refuse to begin without scikit-learn.

    Raises
    ------
    ConfigError
        Where it is not installed; the sentence says how to install it.
    """
    if find_spec("sklearn") is None:
        raise ConfigError(
            "the inference of the baffle",
            problem="needs scikit-learn, which is not installed",
            hint="install it with drumrs: pip install 'drumrs[decide]'",
        )


@dataclass(frozen=True, eq=False)
class Emulator:
    """What an observable is at shapes that were not run.

    Attributes
    ----------
    process
        The Gaussian process, fitted to values of mean 0 and scatter 1.
    center, scale
        Mean and scatter of the values.
    calibration
        Factor of the stated errors: the root mean square of `strays`.
    strays
        Each value less what the others foretell, over the error of that difference: the check by leave-one-out.
    """

    process: Any
    center: float
    scale: float
    calibration: float
    strays: Array

    @classmethod
    def fit(cls, shapes: Sequence[Shape], means: Array, errors: Array) -> "Emulator":
        """Fit the process, its lengths and variance by maximum likelihood.

        Parameters
        ----------
        shapes
            The shapes that were run, n of them.
        means, errors
            Means and standard errors there, shape (n,).
        """
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import ConstantKernel, Matern
        from threadpoolctl import threadpool_limits

        center, scale = float(means.mean()), float(means.std()) or 1.0
        noise = np.maximum(errors / scale, _LEAST_NOISE)
        kernel = ConstantKernel(1.0, _VARIANCES) * Matern([1.0] * 3, _LENGTHS, nu=2.5)
        process = GaussianProcessRegressor(kernel, alpha=noise**2, n_restarts_optimizer=1, random_state=1)
        # One thread: matrices are small, and the same shapes are confirmed on every machine.
        with warnings.catch_warnings(), threadpool_limits(1):
            # A length at its bound is an observable that does not depend on it.
            warnings.simplefilter("ignore", ConvergenceWarning)
            process.fit(_scaled(np.array([shape.lengths for shape in shapes])), (means - center) / scale)
        inverse = np.linalg.inv(process.L_ @ process.L_.T)
        strays = inverse @ process.y_train_ / np.sqrt(np.diag(inverse))
        return cls(process, center, scale, float(np.sqrt(np.mean(strays**2))), strays)

    @property
    def typical_error(self) -> float:
        """Median error of a run as the process was told, in the unit of the values."""
        return self.scale * float(np.sqrt(np.median(self.process.alpha)))

    def predict(self, shapes: Array) -> tuple[Array, Array]:
        """Return mean and standard error at rows of height, base and tip [m]."""
        mean, error = self.process.predict(_scaled(shapes), return_std=True)
        return self.center + self.scale * mean, self.calibration * self.scale * error


def _scaled(shapes: Array) -> Array:
    scaled: Array = (shapes - _LOW) / _RANGE
    return scaled


def emulate(scanned: Mapping[Shape, Means]) -> dict[Observable, Emulator]:
    """Return an emulator of every observable that a sentence is about.

    Parameters
    ----------
    scanned
        What is known of each shape that was run with softer springs.
    """
    shapes = sorted(scanned)
    return {
        one: Emulator.fit(
            shapes,
            np.array([scanned[shape][one][0] for shape in shapes]),
            np.array([scanned[shape][one][1] for shape in shapes]),
        )
        for one in OBSERVABLES
        if one.baffles
    }
