"""A Gaussian process that says what runs would give which were not made, with the noise of every run known."""

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib.util import find_spec
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.errors import ConfigError

Array = NDArray[np.float64]

# Lengths over which a quantity changes, over the range of its parameters, and its variance over that of the values.
_LENGTHS, _VARIANCES = (0.1, 20.0), (1e-2, 1e2)
# Variance of a value that is taken for known.
_LIE_NOISE = 1e-6
# Keeps the covariance of samples, whose true eigenvalues may be 0, positive in floating point.
_JITTER = 1e-9


def require_packages(what: str, *names: str) -> None:
    """Refuse to begin without the packages of the extra `decide`.

    Parameters
    ----------
    what
        What is to be done, as the message names it.
    names
        The packages, as they are imported.

    Raises
    ------
    ConfigError
        Where one is not installed; the sentence says how to install it.
    """
    for name in names:
        if find_spec(name) is None:
            problem = f"needs the package {name}, which is not installed"
            raise ConfigError(what, problem=problem, hint="install it with: pip install 'drumrs[decide]'")


@contextmanager
def one_thread() -> Iterator[None]:
    """Keep linear algebra on one thread within: matrices are small, and sums do not depend on the number of cores."""
    from threadpoolctl import threadpool_limits

    with threadpool_limits(1):
        yield


@dataclass(frozen=True, eq=False)
class Emulator:
    """What a quantity is at points that were not run.

    Attributes
    ----------
    process
        The Gaussian process of scikit-learn, fitted to points within 0 … 1 and to values of mean 0 and scatter 1.
    low, span
        Lower end and width of the range of each parameter.
    center, scale
        Mean and scatter of the values.
    loo_residuals
        Each value less what the others predict, over the error of that difference: the check by leave-one-out, in
        closed form (Rasmussen & Williams 2006, eqs. 5.10–5.12).
    calibration
        Factor of the stated errors, such as the root mean square of `loo_residuals`.

    Examples
    --------
    >>> import numpy as np
    >>> from drumrs.decide.emulator import Emulator
    >>> x = np.linspace(0.0, 3.0, 12)[:, None]
    >>> emulator = Emulator.fit(x, np.sin(x[:, 0]), np.full(12, 0.01), [(0.0, 3.0)])
    >>> mean, error = emulator.predict([[1.4]])
    >>> bool(abs(mean[0] - np.sin(1.4)) < 3.0 * error[0] < 0.1)
    True
    """

    process: Any
    low: Array
    span: Array
    center: float
    scale: float
    loo_residuals: Array
    calibration: float = 1.0

    @classmethod
    def fit(
        cls,
        points: ArrayLike,
        values: ArrayLike,
        errors: ArrayLike,
        ranges: Sequence[tuple[float, float]],
        least_noise: float = 1e-3,
    ) -> Self:
        """Fit the process, its lengths and variance by maximum likelihood.

        Parameters
        ----------
        points
            Parameters of the runs, shape (n, k).
        values, errors
            What the runs gave, and standard errors, shape (n,). An error that is not a number is unknown and taken for
            the largest known one; where none is known, all are what makes the values likeliest.
        ranges
            Lower and upper end of each parameter.
        least_noise
            Errors below this part of the scatter of the values are not believed: a share of exactly 0 has no error
            of its own.
        """
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

        known, low = np.asarray(values, float), np.array([low for low, _ in ranges])
        span = np.array([high for _, high in ranges]) - low
        center, scale = float(known.mean()), float(known.std()) or 1.0
        x, y = (np.asarray(points, float) - low) / span, (known - center) / scale
        noise = np.asarray(errors, float) / scale
        kernel = ConstantKernel(1.0, _VARIANCES) * Matern([1.0] * len(low), _LENGTHS, nu=2.5)
        how = {"n_restarts_optimizer": 1, "random_state": 1}
        with warnings.catch_warnings(), one_thread():
            # A length at its bound is a quantity that does not depend on the parameter.
            warnings.simplefilter("ignore", ConvergenceWarning)
            if np.isnan(noise).all():
                noisy = GaussianProcessRegressor(kernel + WhiteKernel(0.1, (1e-6, 1.0)), **how).fit(x, y)
                noise[:] = np.sqrt(noisy.kernel_.k2.noise_level)
            noise = np.maximum(np.where(np.isnan(noise), np.nanmax(noise), noise), least_noise)
            process = GaussianProcessRegressor(kernel, alpha=noise**2, **how).fit(x, y)
        inverse = np.linalg.inv(process.L_ @ process.L_.T)
        loo_residuals = inverse @ process.y_train_ / np.sqrt(np.diag(inverse))
        return cls(process, low, span, center, scale, loo_residuals)

    def calibrated(self) -> Self:
        """Return the emulator with errors as large as leaving one run out finds them."""
        return replace(self, calibration=float(np.sqrt(np.mean(self.loo_residuals**2))))

    def with_points(self, points: ArrayLike, values: ArrayLike) -> Self:
        """Return the emulator that also takes values without noise for known, lengths and variance as they are."""
        from sklearn.base import clone

        process, more = clone(self.process), (np.asarray(values, float) - self.center) / self.scale
        noise = np.append(self.process.alpha, np.full(len(more), _LIE_NOISE))
        process.set_params(kernel=self.process.kernel_, optimizer=None, alpha=noise)
        process.fit(
            np.vstack([self.process.X_train_, self._scaled(points)]), np.append(self.process.y_train_, more)
        )
        return replace(self, process=process)

    @property
    def typical_error(self) -> float:
        """Median error of a run as the process was told, in the unit of the values."""
        return self.scale * float(np.sqrt(np.median(self.process.alpha)))

    def predict(self, points: ArrayLike) -> tuple[Array, Array]:
        """Return mean and standard error of the quantity itself, without the noise of a run, shape (n,) each."""
        from scipy.linalg import solve_triangular

        # As the process itself predicts, without its checks, which take ten times as long for a few points.
        process, scaled = self.process, self._scaled(points)
        if not len(scaled):
            return np.zeros(0), np.zeros(0)
        cross = process.kernel_(scaled, process.X_train_)
        explained = solve_triangular(process.L_, cross.T, lower=True, check_finite=False)
        variance = process.kernel_.diag(scaled) - np.sum(explained**2, axis=0)
        error = np.sqrt(np.maximum(variance, 0.0))
        return self.center + self.scale * (cross @ process.alpha_), self.calibration * self.scale * error

    def sample(self, points: ArrayLike, count: int, rng: np.random.Generator) -> Array:
        """Draw functions that the runs allow, at points: shape (count, n)."""
        mean, covariance = self.process.predict(self._scaled(points), return_cov=True)
        covariance[np.diag_indices_from(covariance)] += _JITTER + 1e-8 * covariance.diagonal().max()
        root = self.calibration * np.linalg.cholesky(covariance)
        drawn: Array = self.center + self.scale * (mean + rng.standard_normal((count, len(mean))) @ root.T)
        return drawn

    def _scaled(self, points: ArrayLike) -> Array:
        scaled: Array = (np.asarray(points, float) - self.low) / self.span
        return scaled
