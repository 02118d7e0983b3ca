"""`Calibration`: what measured numbers leave of the parameters, as tables, a figure and sentences."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.decide.measurement import Experiment, Measurement
from drumrs.decide.posterior import Posterior
from drumrs.result import with_error

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure

# A parameter is found where its scatter has become smaller than this part of that of its range, and open where it is
# above the second; parameters whose ranks are correlated more than the third trade off against each other.
_FOUND, _OPEN, _TRADED = 0.4, 0.85, 0.6
# The model cannot give what was measured where they differ by more than so many errors.
_FAR_OFF = 3.0
# What is next measured is worth its time from so many bits on.
_WORTH = 0.2


@dataclass(frozen=True, eq=False)
class Calibration:
    """What a calibration has found.

    Attributes
    ----------
    experiment
        What was asked.
    posterior
        The parameters' probability, with the emulators.
    """

    experiment: Experiment
    posterior: Posterior

    @property
    def samples(self) -> "pl.DataFrame":
        """Parameters drawn with their probability, a column each."""
        import polars as pl

        return pl.DataFrame(
            self.posterior.in_units(self.posterior.samples), schema=self.posterior.space.keys, orient="row"
        )

    @property
    def table(self) -> "pl.DataFrame":
        """Each parameter: its median, the ends of its 90 % interval, and its scatter over that of its range."""
        import polars as pl

        low, median, high = self.posterior.quantiles()
        columns = {"parameter": self.posterior.space.keys, "median": median, "low": low, "high": high}
        return pl.DataFrame({**columns, "narrowing": self.posterior.narrowing()})

    @property
    def fits(self) -> "pl.DataFrame":
        """What was measured beside what the model gives there: means, errors, and their difference over both errors."""
        import polars as pl

        rows = []
        for k, one in enumerate(self.experiment.measured):
            mean, scatter, own = self.posterior.predict(k)
            off = (mean - self.posterior.values[k]) / np.hypot(self.posterior.errors[k], own)
            rows.append((str(one), one.value, one.error, mean, float(np.hypot(scatter, own)), float(off)))
        names = ("measured", "value", "error", "model", "model_error", "off")
        return pl.DataFrame(rows, schema=names, orient="row")

    @property
    def next(self) -> list[tuple[Measurement, float]]:
        """Candidates with what measuring each would tell of the parameters, in bits, the most telling one first.

        Candidates that the file does not name are what was measured, once more.
        """
        first, found = len(self.experiment.measured), []
        for k, one in enumerate(self.experiment.candidates):
            discrepancy = self.experiment.discrepancy * abs(self.posterior.predict(first + k)[0])
            found.append(
                (one, self.posterior.information(first + k, float(np.hypot(one.error, discrepancy))))
            )
        return sorted(found, key=lambda pair: -pair[1])

    @property
    def sentence(self) -> str:
        """What was found, how sure it is, what it cannot tell apart, and what to measure next."""
        return " ".join([*self._parameters(), *self._ridges(), *self._misfits(), self._advice()])

    def figure(self) -> "Figure":
        """Draw the parameters' probability, alone and pair by pair, and what was measured beside the model."""
        from drumrs.decide.calibration_figure import draw

        return draw(self.experiment, self.posterior)

    def _parameters(self) -> Iterator[str]:
        on_ridge = {key for pair in self.ridges for key in pair}
        for key, median, low, high, narrowing in self.table.iter_rows():
            if narrowing > _OPEN and key in on_ridge:
                yield f"{key} alone stays open, {low:.3g} to {high:.3g} with 90 %."
            elif narrowing > _OPEN:
                yield f"The measurements say nothing of {key}."
            else:
                extent = "" if narrowing <= _FOUND else ", still a good part of its range"
                yield f"{key} is {median:.3g} ({low:.3g} to {high:.3g} with 90 %){extent}."

    def _ridges(self) -> Iterator[str]:
        """Name the pairs that trade off: along a ridge of parameters that fit alike neither is known alone."""
        keys, narrowing, correlation = (
            self.posterior.space.keys,
            self.posterior.narrowing(),
            self.posterior.correlation(),
        )
        for first, second in self.ridges:
            i, j = keys.index(first), keys.index(second)
            how = (
                "more of one goes with less of the other" if correlation[i, j] < 0.0 else "both rise together"
            )
            is_open = max(narrowing[i], narrowing[j]) > _FOUND
            what = "are not told apart, a ridge and not a point" if is_open else "are correlated"
            yield f"{first} and {second} {what}: {how} (rank correlation {correlation[i, j]:.2f})."

    @property
    def ridges(self) -> list[tuple[str, str]]:
        """The pairs of parameters that trade off against each other."""
        keys, correlation = self.posterior.space.keys, self.posterior.correlation()
        pairs = zip(*np.triu_indices(len(keys), 1), strict=True)
        return [(keys[i], keys[j]) for i, j in pairs if abs(correlation[i, j]) > _TRADED]

    def _misfits(self) -> Iterator[str]:
        for name, value, error, model, model_error, off in self.fits.iter_rows():
            if abs(off) > _FAR_OFF:
                yield (
                    f"No parameters in the ranges give {name} as measured: {with_error(value, error)}, where the model "
                    f"has {with_error(model, model_error)}."
                )

    def _advice(self) -> str:
        one, bits = self.next[0]
        again = ", once more," if one in self.experiment.measured else ""
        if bits < _WORTH:
            return (
                f"None of the further measurements would tell much: {one}{again} the most, {bits:.1f} bits."
            )
        return f"Of further measurements {one}{again} would tell most, {bits:.1f} bits."
