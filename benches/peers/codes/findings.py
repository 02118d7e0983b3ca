"""What the codes found: the table of runs, means over seeds side by side, and their figure."""

import json
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from codes.balance import agree
from drumrs.analysis import Estimate
from drumrs.analysis import estimate as over_seeds
from drumrs.figures.shared import drumrs_style

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

QUANTITIES = {"power": "Specific power [W/kg]", "x": "Center of mass x [m]", "y": "Center of mass y [m]"}
_OURS = "drumrs"
_POINT = ("baffles", "fill", "friction")
# Table 1's friction; the fill at which friction varies.
_FRICTION, _FILL = 0.5, 0.5


def collect(folder: Path) -> "pl.DataFrame":
    """Return the kept runs of a folder, one row a run."""
    import polars as pl

    rows = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))]
    return pl.DataFrame(rows, infer_schema_length=None).sort(*_POINT, "code", "seed")


def means(table: "pl.DataFrame") -> list[dict[str, Any]]:
    """Return the means over seeds of each code at each point that drumrs and another code have run.

    Only seeds that both have run are used: starts and windows are then equal.
    """
    found = []
    for point, rows in table.group_by(_POINT, maintain_order=True):
        for code in rows["code"].unique(maintain_order=True):
            if code == _OURS:
                continue
            both = _common(rows, code)
            if not both:
                continue
            for name in QUANTITIES:
                ours, theirs = (_estimate(part, name) for part in both)
                entry = {**dict(zip(_POINT, point, strict=True)), "code": code, "seeds": len(both[0])}
                found.append({**entry, "quantity": name, "ours": ours, "theirs": theirs})
    return found


def _common(rows: "pl.DataFrame", code: str) -> "tuple[pl.DataFrame, pl.DataFrame] | None":
    """Return the rows of drumrs and of a code with the seeds that both have."""
    ours, theirs = (rows.filter(rows["code"] == name) for name in (_OURS, code))
    ours, theirs = ours.join(theirs, on="seed", how="semi"), theirs.join(ours, on="seed", how="semi")
    return (ours, theirs) if len(ours) else None


def _estimate(rows: "pl.DataFrame", name: str) -> Estimate:
    return over_seeds(rows[name].to_list(), rows[f"{name}_error"].to_list())


def verdicts(entries: Iterable[dict[str, Any]]) -> list[str]:
    """Return a table in Markdown: specific powers, their difference, and whether they agree."""
    lines = [
        "| drum | fill | friction | code | seeds | power [W/kg] | drumrs | difference | agree |",
        "|---" * 9 + "|",
    ]
    for entry in entries:
        if entry["quantity"] != "power":
            continue
        ours, theirs = entry["ours"], entry["theirs"]
        difference = ours - theirs
        share = 100.0 * difference.mean / theirs.mean if theirs.mean else 0.0
        words = [
            "three baffles" if entry["baffles"] else "bare",
            f"{100.0 * entry['fill']:.0f} %",
            f"{entry['friction']:g}",
            entry["code"],
            str(entry["seeds"]),
            f"{theirs.mean:.3f} ± {theirs.error:.3f}",
            f"{ours.mean:.3f} ± {ours.error:.3f}",
            f"{difference.mean:+.3f} ± {difference.error:.3f} ({share:+.1f} %)",
            "yes" if agree(ours, theirs) else "no",
        ]
        lines.append(f"| {' | '.join(words)} |")
    return lines


def draw(entries: Sequence[dict[str, Any]]) -> "Figure":
    """Draw each quantity against fill, against friction, and against fill with baffles."""
    from matplotlib.figure import Figure

    columns: tuple[tuple[str, str, Callable[[dict[str, Any]], bool]], ...] = (
        ("Bare drum, friction 0.5", "fill", lambda e: not e["baffles"] and e["friction"] == _FRICTION),
        ("Bare drum, 50 % fill", "friction", lambda e: not e["baffles"] and e["fill"] == _FILL),
        ("Three baffles, friction 0.5", "fill", lambda e: e["baffles"]),
    )
    with drumrs_style():
        figure = Figure(figsize=(9.0, 7.0))
        grid = figure.subplots(len(QUANTITIES), len(columns), squeeze=False, sharex="col")
        for row, name in zip(grid, QUANTITIES, strict=True):
            for axes, (title, along, belongs) in zip(row, columns, strict=True):
                chosen = [entry for entry in entries if entry["quantity"] == name and belongs(entry)]
                _draw_panel(axes, chosen, along)
                if axes in grid[0]:
                    axes.set_title(title)
                if axes in grid[-1]:
                    axes.set_xlabel("Fill [%]" if along == "fill" else "Friction")
            row[0].set_ylabel(QUANTITIES[name])
        for axes in grid[0]:
            axes.set_ylim(bottom=0.0)
            axes.legend(loc="best")
    return figure


def _draw_panel(axes: "Axes", entries: Sequence[dict[str, Any]], along: str) -> None:
    """Draw drumrs as a line, another code as open circles, both with intervals of 95 %."""
    scale = 100.0 if along == "fill" else 1.0
    entries = sorted(entries, key=lambda entry: float(entry[along]))
    places = [scale * entry[along] for entry in entries]
    codes = dict.fromkeys(entry["code"] for entry in entries)
    for side, label in (("ours", _OURS), ("theirs", " ".join(codes))):
        intervals = [entry[side].interval() for entry in entries]
        heights, halves = [i.mean for i in intervals], [i.half_width for i in intervals]
        if side == "ours":
            axes.errorbar(places, heights, halves, label=label, marker=".")
        else:
            axes.errorbar(
                places, heights, halves, label=label, marker="o", mfc="none", ls="none", capsize=3.0
            )
