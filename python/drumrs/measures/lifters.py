"""A wall profile folded over the lifters of a drum: what one of them and the shell up to the next one undergo."""

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    import polars as pl
    from numpy.typing import NDArray

_RIM = "rim"
# An underside lies at the rim and looks away from the axis: nearer to it than this share of the radius, and with a
# normal whose part along the radius is at least that.
_AT_RIM, _OUTWARD = 0.9, 0.7
# A bin whose normal has at least this part towards the axis belongs to the top of a lifter, others to a face.
_TOP = 0.8


@dataclass(frozen=True, eq=False)
class FoldedLifter:
    """What is recorded along a lifter and the shell up to the next one, over all lifters that are alike.

    Attributes
    ----------
    kind
        What they are called, such as ``"rail"``.
    count
        How many there are.
    profile
        A row a bin, the way the drum turns: ``face``, "trailing", "top" or "leading" face of the lifter, or "shell";
        ``start``, ``end`` [m] along the lifter from its trailing foot, and along the shell from the leading one;
        ``mean``, ``least`` and ``greatest`` over the lifters; ``x``, ``y``, ``normal_x``, ``normal_y`` of the bin
        at the first lifter, in the drum's frame, mirrored for a drum that turns clockwise.
    """

    kind: str
    count: int
    profile: "pl.DataFrame"


def exposed(wall_profile: "pl.DataFrame") -> "pl.DataFrame":
    """Return the bins of a wall profile that a load can touch.

    Undersides of parts that stand on the rim, and the rim under them, belong to the outline, but nothing comes there.

    Parameters
    ----------
    wall_profile
        ``result.wall_profile``, or what `wear` makes of it.

    Returns
    -------
    polars.DataFrame
        The rows that are left; all of them where there is no rim.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import exposed
    >>> changes = {"run.duration": 0.05, "run.record": ["wall_profile"]}
    >>> config = drumrs.baseline(fill=0.1, baffles=True).softer(100.0).replace(changes)
    >>> profile = drumrs.run(config, progress=False).wall_profile
    >>> shown = exposed(profile)
    >>> profile.filter(part="baffle 1").height, shown.filter(part="baffle 1").height
    (9, 7)
    """
    import polars as pl

    middles, normals, half = _geometry(wall_profile)
    is_rim = (wall_profile["part"].cast(pl.String) == _RIM).to_numpy()
    if not is_rim.any():
        return wall_profile
    radius, distance = float(np.median(np.hypot(*middles[is_rim].T))), np.hypot(*middles.T)
    outward = np.einsum("ij,ij->i", normals, middles) / distance
    under = ~is_rim & (outward > _OUTWARD) & (distance > _AT_RIM * radius)
    angles = np.arctan2(middles[:, 1], middles[:, 0])
    covered = np.zeros(len(middles), dtype=bool)
    for place in np.nonzero(under)[0]:
        off = np.abs((angles - angles[place] + np.pi) % (2.0 * np.pi) - np.pi)
        covered |= off < half[place] / radius
    return wall_profile.filter(~(under | (is_rim & covered)))


def folded_lifter(wall_profile: "pl.DataFrame", column: str, *, clockwise: bool = False) -> FoldedLifter:
    """Return a column of the wall profile over one lifter and the shell up to the next, over all lifters.

    Parameters
    ----------
    wall_profile
        ``result.wall_profile``, or what `wear` makes of it.
    column
        What is folded.
    clockwise
        Whether the drum turned clockwise.

    Returns
    -------
    FoldedLifter
        Of the most numerous parts that are alike. The shell's bins are as wide as the rim's, or a little narrower.

    Raises
    ------
    ConfigError
        Where no part of the drum comes twice.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import folded_lifter
    >>> changes = {"run.duration": 0.05, "run.record": ["wall_profile"]}
    >>> config = drumrs.baseline(fill=0.1, baffles=True).softer(100.0).replace(changes)
    >>> folded = folded_lifter(drumrs.run(config, progress=False).wall_profile, "normal_impulse")
    >>> folded.kind, folded.count, folded.profile["face"].unique(maintain_order=True).to_list()
    ('baffle', 3, ['trailing', 'leading', 'shell'])
    """
    import polars as pl

    rows = exposed(wall_profile)
    if clockwise:
        rows = rows.with_columns(-pl.col("x"), -pl.col("normal_x"))
    kind, members = _alike(rows)
    members = [_in_order(one) for one in members]
    first, ends = members[0], np.array([_foot(one) for one in members])
    values = np.array([one[column].to_numpy() for one in members])
    middles, normals, half = _geometry(first)
    edges = np.concatenate([[0.0], np.cumsum(2.0 * half)])
    lifter = _table(_faces(middles, normals), edges, values, first)
    shell = _shell(rows.filter(part=_RIM), column, ends)
    return FoldedLifter(kind, len(members), pl.concat([lifter, shell]) if shell is not None else lifter)


def _geometry(rows: "pl.DataFrame") -> tuple[Array, Array, Array]:
    """Return the middles of bins, their normals, and half their lengths."""
    half: Array = 0.5 * (rows["arc_end"] - rows["arc_start"]).to_numpy()
    return rows.select("x", "y").to_numpy(), rows.select("normal_x", "normal_y").to_numpy(), half


def _alike(rows: "pl.DataFrame") -> tuple[str, "list[pl.DataFrame]"]:
    """Return the kind of the most numerous parts that have as many bins, and the bins of each."""
    kinds: dict[tuple[str, int], list[pl.DataFrame]] = {}
    for part in rows.partition_by("part", maintain_order=True):
        kinds.setdefault((re.sub(r" \d+$", "", str(part["part"][0])), part.height), []).append(part)
    kinds.pop(next((key for key in kinds if key[0] == _RIM), (_RIM, 0)), None)
    most = max(kinds, key=lambda key: len(kinds[key]), default=None)
    if most is None or len(kinds[most]) < 2:  # noqa: PLR2004 - one lifter cannot be folded
        raise ConfigError("drum", problem="has no lifters that are alike, of which a mean could be made")
    return most[0], kinds[most]


def _in_order(part: "pl.DataFrame") -> "pl.DataFrame":
    """Return the bins of a lifter in the order in which the drum turns, from its trailing foot to its leading one."""
    import polars as pl

    part = part.sort("arc_start")
    starts, ends = part["arc_start"].to_numpy(), part["arc_end"].to_numpy()
    # Where the underside was, the outline is broken: the bin after it comes first.
    gaps = starts - np.roll(ends, 1)
    gaps[0] = 0.0
    begin = int(gaps.argmax()) if gaps.max() > 1e-9 * ends[-1] else 0
    part = pl.concat([part[begin:], part[:begin]])
    (x, *_, last_x), (y, *_, last_y) = part["x"].to_list(), part["y"].to_list()
    return part if x * last_y - y * last_x > 0.0 else part.reverse()


def _foot(part: "pl.DataFrame") -> float:
    """Return the angle of the leading foot of a lifter [rad]: the outer end of its last bin."""
    middles, normals, half = _geometry(part[-1:])
    along = half[0] * np.array([-normals[0, 1], normals[0, 0]])
    foot = max(middles[0] + along, middles[0] - along, key=lambda point: float(np.hypot(*point)))
    return float(np.arctan2(foot[1], foot[0]))


def _faces(middles: Array, normals: Array) -> list[str]:
    """Name the face that each bin of a lifter belongs to, in a drum that turns counter-clockwise."""
    radial = middles / np.hypot(*middles.T)[:, np.newaxis]
    inward = -np.einsum("ij,ij->i", normals, radial)
    ahead = radial[:, 0] * normals[:, 1] - radial[:, 1] * normals[:, 0]
    return [
        "top" if up >= _TOP else "leading" if on > 0.0 else "trailing"
        for up, on in zip(inward, ahead, strict=True)
    ]


def _table(faces: list[str], edges: Array, values: Array, places: "pl.DataFrame") -> "pl.DataFrame":
    import polars as pl

    columns = {"mean": values.mean(axis=0), "least": values.min(axis=0), "greatest": values.max(axis=0)}
    made = pl.DataFrame({"face": faces, "start": edges[:-1], "end": edges[1:], **columns})
    return pl.concat([made, places.select("x", "y", "normal_x", "normal_y")], how="horizontal")


def _shell(rim: "pl.DataFrame", column: str, feet: Array) -> "pl.DataFrame | None":
    """Return the bins of the shell between lifters, by their way from the leading foot behind them."""
    import polars as pl

    if rim.is_empty():
        return None
    middles, _, half = _geometry(rim)
    radius = float(np.median(np.hypot(*middles.T)))
    angles = np.arctan2(middles[:, 1], middles[:, 0])
    # A bin that reaches across the foot belongs to the way's beginning, not to the end of the one before.
    across = 2.0 * half[0] / radius
    off = (angles[:, np.newaxis] - feet + across) % (2.0 * np.pi) - across
    way = radius * np.maximum(off.min(axis=1), 0.0)
    length = float(way.max() + half[0])
    count = max(1, round(length / (2.0 * half[0])))
    bins: NDArray[np.intp] = np.minimum((way / length * count).astype(np.intp), count - 1)
    found = (
        pl.DataFrame({"bin": bins, "value": rim[column]})
        .group_by("bin")
        .agg(mean=pl.col("value").mean(), least=pl.col("value").min(), greatest=pl.col("value").max())
        .sort("bin")
    )
    at = feet[0] + (found["bin"].to_numpy() + 0.5) * length / count / radius
    width = length / count
    return pl.DataFrame(
        {
            "face": ["shell"] * found.height,
            "start": found["bin"] * width,
            "end": (found["bin"] + 1) * width,
            **{name: found[name] for name in ("mean", "least", "greatest")},
            "x": radius * np.cos(at),
            "y": radius * np.sin(at),
            "normal_x": -np.cos(at),
            "normal_y": -np.sin(at),
        }
    )
