"""Values of a parameter in words, and the range of it over which something holds."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby

_SYMBOLS = {"friction": "μ", "size": "D/d", "restitution": "e", "speed": "rpm"}


@dataclass(frozen=True)
class Piece:
    """A point of a parameter's axis, or a step from one to the next, and what a part of a claim comes to there."""

    low: float
    high: float
    outcome: str


def place(axis: str, low: float, high: float | None = None) -> str:
    """Write a value of a parameter, or a step from one to the next.

    Examples
    --------
    >>> place("fill", 0.425), place("friction", 0.75, 1.0)
    ('42.5 %', 'μ = 0.75 to 1')
    """
    scale, before, after = (
        (100.0, "", " %") if axis == "fill" else (1.0, f"{_SYMBOLS.get(axis, axis)} = ", "")
    )
    told = f"{scale * low:.4g}" if high is None or high == low else f"{scale * low:.4g} to {scale * high:.4g}"
    return f"{before}{told}{after}"


def where(axis: str, pieces: Sequence[Piece], outcome: str) -> str:
    """Write the longest range of neighboring pieces of one outcome; empty where it is all or a single point.

    Only points tell: a range begins and ends at one, and says nothing of what lies beyond.

    Examples
    --------
    >>> found = [Piece(0.1, 0.1, "no"), Piece(0.2, 0.2, "yes"), Piece(0.4, 0.4, "yes")]
    >>> where("fill", found, "yes"), where("friction", found, "yes")
    ('from 20 % fill on', 'for μ ≥ 0.2')
    """
    longest: list[Piece] = max((run for run in _runs(pieces, outcome)), key=len, default=[])
    if not longest or len(longest) == len(pieces) or longest[0].low == longest[-1].high:
        return ""
    low = longest[0].low if longest[0] != pieces[0] else None
    high = longest[-1].high if longest[-1] != pieces[-1] else None
    return _from_to(axis, low, high)


def _runs(pieces: Sequence[Piece], outcome: str) -> Iterable[list[Piece]]:
    for same, run in groupby(pieces, key=lambda piece: piece.outcome == outcome):
        if same:
            yield list(run)


def _from_to(axis: str, low: float | None, high: float | None) -> str:
    if axis == "fill":
        ends = [f"{100.0 * end:.4g}" for end in (low, high) if end is not None]
        if low is None:
            return f"up to {ends[0]} % fill"
        return f"from {ends[0]} % fill on" if high is None else f"from {ends[0]} to {ends[1]} % fill"
    symbol = _SYMBOLS.get(axis, axis)
    if low is None:
        return f"for {symbol} ≤ {high:g}"
    return f"for {symbol} ≥ {low:g}" if high is None else f"for {low:g} ≤ {symbol} ≤ {high:g}"
