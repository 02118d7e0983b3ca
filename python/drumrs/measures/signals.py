"""Spectra over frequency, and peaks, of torque and forces as the series has them."""

from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import SeriesWindow
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    import polars as pl


def frequency_spectrum(
    series: "pl.DataFrame",
    column: str,
    window: tuple[float, float],
    *,
    segments: int = 7,
    taper: str = "hann",
) -> "pl.DataFrame":
    """Return the power spectral density of a column of the series, by Welch's method.

    The window is cut into segments that overlap by half, each without its mean and tapered; their spectra are averaged
    (P. D. Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70).

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    column
        Such as ``"drum_torque"`` or ``"baffle_1_force_x"``. These are means between samples, so what is faster than a
        sample is damped: at half the sampling rate to 2/π of its amplitude.
    window
        Start and end [s].
    segments
        Number of segments. With more, lines are broader and the noise between them is less.
    taper
        ``"hann"``, ``"boxcar"``, or another window of `scipy.signal.get_window`. Lines n_b Ω/2π of n_b baffles are
        narrow and leak less with ``"hann"``; with ``"boxcar"`` and one segment the density integrates to the variance
        exactly (Parseval).

    Returns
    -------
    polars.DataFrame
        ``frequency`` [Hz] and ``density``, in the square of the column's unit per Hz, one-sided.

    Raises
    ------
    ConfigError
        Where the window holds too few samples for so many segments.

    Examples
    --------
    >>> import numpy as np, polars as pl
    >>> from drumrs.measures import frequency_spectrum
    >>> time = 0.01 * np.arange(1001)
    >>> series = pl.DataFrame({"time": time, "drum_torque": 2.0 + np.sin(2.0 * np.pi * 5.0 * time)})
    >>> spectrum = frequency_spectrum(series, "drum_torque", (0.0, 10.0), segments=1)
    >>> round(spectrum["frequency"][spectrum["density"].arg_max()], 1)
    5.0
    """
    import polars as pl
    from scipy.signal import welch

    rows = SeriesWindow.of(series, window)
    # The first row closes an interval before the window.
    values = rows.column(column)[1:]
    length = 2 * len(values) // (segments + 1)
    if length <= 1:
        raise ConfigError("segments", segments, f"fewer than {len(values)}, the samples of the window")
    frequency, density = welch(
        values, 1.0 / rows.interval, window=taper, nperseg=length, noverlap=length // 2, detrend="constant"
    )
    return pl.DataFrame({"frequency": frequency, "density": density})


def peak_factor(series: "pl.DataFrame", column: str, window: tuple[float, float]) -> float:
    """Return the greatest magnitude of a column over its root mean square: √2 for a sine about 0.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    column
        Such as ``"drum_torque"``.
    window
        Start and end [s].

    Raises
    ------
    ConfigError
        Where the window holds fewer than two samples.
    """
    values = SeriesWindow.of(series, window).column(column)[1:]
    return float(np.abs(values).max() / np.sqrt(np.mean(values**2)))
