"""Wear along the outline of the drum, by Archard and by Finnie, from the wall profile; and the outline that it leaves.

Laws of wear have a coefficient that somebody must have measured. Without one, wear over its mean can be trusted, its
amount cannot.
"""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError
from drumrs.measures.recorded import part_names, required

if TYPE_CHECKING:
    import polars as pl

# What the volume of a bin is proportional to, by law.
_LAWS = {"archard": "normal_force_slip", "finnie": "finnie"}
# The angle up to which Finnie's particle leaves the surface again while it cuts: tan γ = 1/3.
_SHALLOW = 1.0 / 3.0


def wear(
    wall_profile: "pl.DataFrame | None", law: str = "archard", coefficient: float = 1.0, turns: float = 1.0
) -> "pl.DataFrame":
    """Return the wear of each bin of the drum's outline.

    Archard: a volume W ∫ F_n ds over the way that is slid (J. F. Archard, J. Appl. Phys. 24 (1953) 981). Finnie: a
    volume k ∫ 2 |v| |F| f(γ) dt while bodies approach, with the angle γ of the velocity to the surface and `finnie_f`
    (I. Finnie, Wear 3 (1960) 87).

    Parameters
    ----------
    wall_profile
        ``result.wall_profile``.
    law
        ``"archard"`` or ``"finnie"``.
    coefficient
        W or k [1/Pa].
    turns
        Turns of the drum over which the profile was recorded: wear is given for one of them.

    Returns
    -------
    polars.DataFrame
        The profile with ``wear_volume`` [m³ per m of depth], ``wear_depth`` [m], the volume over the length of the bin,
        and ``relative_wear``, the depth over its mean along all the outline.

    Raises
    ------
    ConfigError
        Where the profile was not recorded, or there is no such law.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs.measures import wear
    >>> profile = pl.DataFrame({"arc_start": [0.0, 0.1], "arc_end": [0.1, 0.2], "normal_force_slip": [2.0, 6.0]})
    >>> worn = wear(profile, coefficient=1e-12)
    >>> [f"{depth:.0e}" for depth in worn["wear_depth"]], worn["relative_wear"].round(6).to_list()
    (['2e-11', '6e-11'], [0.5, 1.5])
    """
    import polars as pl

    profile = required(wall_profile, "wall_profile", "wear")
    if law not in _LAWS:
        raise ConfigError("law", law, f"one of {', '.join(_LAWS)}")
    length = pl.col("arc_end") - pl.col("arc_start")
    volume, depth = pl.col("wear_volume"), pl.col("wear_depth")
    return (
        profile.with_columns(wear_volume=coefficient / turns * pl.col(_LAWS[law]))
        .with_columns(wear_depth=volume / length)
        .with_columns(relative_wear=depth / (volume.sum() / length.sum()))
    )


def wear_of_parts(wall_profile: "pl.DataFrame | None", turns: float) -> dict[str, float]:
    """Return the wear of the drum and of each part of it in a turn, without a coefficient, and how uneven it is.

    Parameters
    ----------
    wall_profile
        ``result.wall_profile``.
    turns
        Turns of the drum over which it was recorded; 0 leaves no number.

    Returns
    -------
    dict
        By name of the registry: ``archard_wear`` and ``finnie_wear`` [J/m], which the coefficients of `wear` make
        volumes of, and likewise of each part, such as ``rim_archard_wear``; ``wear_peak``, the greatest
        ``relative_wear`` by Archard, of bins as wide as ``run.arc_bin``.

    Raises
    ------
    ConfigError
        Where the profile was not recorded.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs.measures import wear_of_parts
    >>> parts = pl.Series("part", ["rim", "wall 1"], pl.Enum(["rim", "wall 1"]))
    >>> profile = pl.DataFrame([parts, pl.Series("arc_start", [0.0, 0.0]), pl.Series("arc_end", [0.3, 0.1])])
    >>> profile = profile.with_columns(normal_force_slip=2.0, finnie=0.5)
    >>> worn = wear_of_parts(profile, turns=2.0)
    >>> worn["archard_wear"], worn["wall_1_finnie_wear"], worn["wear_peak"]
    (2.0, 0.25, 2.0)
    """
    profile = required(wall_profile, "wall_profile", "wear")
    at_part, names = profile["part"].to_physical(), part_names(profile["part"])
    kinds = {"": profile, **{f"{name}_": profile.filter(at_part == k) for k, name in enumerate(names)}}
    found = {
        f"{kind}{law}_wear": float(rows[column].sum()) / turns if turns else math.nan
        for kind, rows in kinds.items()
        for law, column in _LAWS.items()
    }
    relative = wear(profile)["relative_wear"].to_numpy()
    return {**found, "wear_peak": float(relative.max()) if len(relative) else math.nan}


def finnie_f(angle: ArrayLike) -> Array:
    """Return Finnie's f(γ): sin 2γ − 3 sin²γ where tan γ < ⅓, else ⅓ cos²γ; greatest, 0.3028, at 16.85°.

    Parameters
    ----------
    angle
        Angle γ of the velocity to the surface [rad], between 0 and π/2.

    Examples
    --------
    >>> import math
    >>> from drumrs.measures import finnie_f
    >>> round(float(finnie_f(math.radians(16.85))), 4)
    0.3028
    """
    gamma = np.asarray(angle, dtype=np.float64)
    shallow = np.sin(2.0 * gamma) - 3.0 * np.sin(gamma) ** 2
    worn: Array = np.where(np.tan(gamma) < _SHALLOW, shallow, np.cos(gamma) ** 2 / 3.0)
    return worn


def worn_outline(worn: "pl.DataFrame", part: str, turns: float) -> Array:
    """Return the outline of a part of the drum after so many turns of steady wear, to go on with in a new run.

    Each bin's middle is moved against its normal by its depth of wear times the turns, after the depths were smoothed
    over one bin (¼, ½, ¼). Corners finer than a bin are cut off, so bins should be as fine as the part's corners.

    Parameters
    ----------
    worn
        What `wear` returned, for one turn.
    part
        Name of the part, such as ``"baffle 1"``.
    turns
        Turns of the drum. Take few at a time: as the outline changes, so does the wear.

    Returns
    -------
    array
        Points in the drum's own frame [m], shape (bins, 2), in the order of the bins.

    Raises
    ------
    ConfigError
        Where there is no such part, or it would be worn through, so that its outline would cross itself.
    """
    import polars as pl
    import shapely

    rows = worn.filter(pl.col("part") == part).sort("arc_start")
    if rows.is_empty():
        raise ConfigError("part", part, f"one of {', '.join(worn['part'].unique(maintain_order=True))}")
    depth = turns * rows["wear_depth"].to_numpy()
    padded = np.concatenate([depth[:1], depth, depth[-1:]])
    smooth = 0.25 * padded[:-2] + 0.5 * padded[1:-1] + 0.25 * padded[2:]
    middles, normals = rows.select("x", "y").to_numpy(), rows.select("normal_x", "normal_y").to_numpy()
    outline: Array = middles - smooth[:, np.newaxis] * normals
    # Worn through, it would run backwards.
    runs_on = (np.diff(outline, axis=0) * np.diff(middles, axis=0)).sum(axis=1) > 0.0
    if not (runs_on.all() and shapely.LineString(outline).is_simple):
        raise ConfigError("turns", turns, "few enough that the part is not worn through")
    return outline
