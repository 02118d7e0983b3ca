"""How large a study is: its seeds, times and points."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from drumrs.errors import ConfigError


@dataclass(frozen=True)
class Scale:
    """Seeds, times and points of a study; the points are those of the figures' horizontal axes.

    Attributes
    ----------
    seeds
        Seeds of the random starts, the same for every point.
    duration
        Simulated time of every case [s].
    window
        Interval of the averages [s, s].
    fills
        Fills N d²/D² of the bare drum.
    fills_with_baffles
        The same for the drum with baffles, which holds less.
    fills_with_triangles, sizes_with_triangles
        Fills and sizes with the baffles once assumed; these cases are those with baffles where the two are the same.
    half_full_seeds, half_full_duration
        Seeds and simulated time [s] of the bare drum about half full, where the load passes between two states; means
        are from the window's start to the end. Without seeds these fills are run as the others.
    end_seeds, end_duration
        Seeds and simulated time [s] at ends of curves that decide a claim alone and vary much from seed to seed: the
        least fill, the least D/d, and at 25 % fill the frictions 0.3 and 1; means are from the window's start to the
        end. Without seeds these points are run as the others.
    sizes
        Drum over bundle diameter, D/d.
    frictions
        Coefficients of friction, of bundles and drum alike.
    speeds
        Speeds of the drum [rpm].
    restitutions
        Coefficients of restitution, of bundles and drum alike.
    softer
        By how much springs are softer than Table 1's, and time steps longer by its root. Power is lower by some 3 % at
        100; no N/T is taken from such runs.
    coarser
        By how much time steps are longer still. At 2.5 times Table 1's, a twentieth of a collision, no mean changes by
        more than its error (docs/accuracy.md).
    beside
        Further points with seeds, times and springs of their own.
    """

    seeds: tuple[int, ...]
    duration: float
    window: tuple[float, float]
    fills: tuple[float, ...]
    fills_with_baffles: tuple[float, ...]
    sizes: tuple[float, ...]
    frictions: tuple[float, ...]
    speeds: tuple[float, ...]
    restitutions: tuple[float, ...]
    half_full_seeds: tuple[int, ...] = ()
    half_full_duration: float = 120.0
    end_seeds: tuple[int, ...] = ()
    end_duration: float = 30.0
    fills_with_triangles: tuple[float, ...] = ()
    sizes_with_triangles: tuple[float, ...] = ()
    softer: float = 1.0
    coarser: float = 1.0
    beside: "Scale | None" = None


_FILLS = (
    *(0.10, 0.15, 0.20, 0.25, 0.30, 0.35, 0.40, 0.425, 0.45, 0.475),
    *(0.50, 0.525, 0.55, 0.60, 0.65, 0.70, 0.75),
)
_SIZES = (10.0, 13.0, 16.0, 20.0, 24.0, 28.0, 32.0, 37.0)
_TEN = tuple(range(1, 11))

# The paper's protocol. Fills lie closest where the power peaks and where the paper lets it peak; frictions where
# the load starts to circulate.
_DEFAULT = Scale(
    seeds=(1, 2, 3),
    duration=30.0,
    window=(20.0, 30.0),
    half_full_seeds=_TEN,
    end_seeds=_TEN,
    fills=(*_FILLS, 0.80),
    fills_with_baffles=_FILLS,
    fills_with_triangles=_FILLS,
    sizes=_SIZES,
    sizes_with_triangles=_SIZES,
    frictions=(0.0, 0.025, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.75, 1.0),
    speeds=(20.0, 30.0, 40.0, 54.0, 60.0, 70.0, 80.0),
    restitutions=(0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9),
)

# The load is steady after about 5 s, and nearly so after 4 s. Of two seeds that disagree nothing is known, so there are
# three, at a time step that is cheaper and as good (docs/accuracy.md).
_QUICK = Scale(
    seeds=(1, 2, 3),
    duration=7.0,
    window=(4.0, 7.0),
    # What N/T needs. At 25 and 30 % fill it is about 1 in the bare drum.
    fills=(0.10, 0.25, 0.30, 0.40, 0.50, 0.60, 0.75),
    fills_with_baffles=(0.15, 0.25, 0.40, 0.50, 0.60, 0.75),
    sizes=(),
    frictions=(0.3, 0.5, 1.0),
    speeds=(),
    restitutions=(),
    coarser=2.5,
    # What power needs costs a tenth with softer springs.
    beside=Scale(
        seeds=(1, 2, 3),
        duration=7.0,
        window=(4.0, 7.0),
        end_seeds=_TEN,
        end_duration=20.0,
        fills=(0.10, 0.15, 0.20, 0.25, 0.30, 0.35, 0.40, 0.45, 0.50, 0.55, 0.60, 0.65, 0.75),
        fills_with_baffles=(0.10, 0.15, 0.25, 0.30, 0.35, 0.40, 0.45, 0.50, 0.55, 0.60, 0.65, 0.75),
        sizes=(10.0, 13.0, 20.0, 37.0),
        frictions=(0.0, 0.025, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0),
        speeds=(20.0, 54.0, 80.0),
        restitutions=(0.1, 0.5, 0.9),
        softer=100.0,
    ),
)

SCALES: Mapping[str, Scale] = MappingProxyType(
    {"quick": _QUICK, "default": _DEFAULT, "full": replace(_DEFAULT, seeds=_TEN)}
)


def scale_of(scale: str | Scale) -> Scale:
    """Return a scale by its name, or the one given.

    Raises
    ------
    ConfigError
        Where there is no scale of that name.
    """
    if isinstance(scale, Scale):
        return scale
    if scale not in SCALES:
        known = " or ".join([", ".join(repr(name) for name in list(SCALES)[:-1]), repr(list(SCALES)[-1])])
        raise ConfigError("scale", scale, known)
    return SCALES[scale]
