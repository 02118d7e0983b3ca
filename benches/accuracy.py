"""What accuracy costs: specific power, N/T and time against the time step, and against softer springs.

Writes docs/accuracy/accuracy.parquet, one row a run, the figure beside it, and the table in docs/accuracy.md. Runs that
are kept in the folder are not run again. N/T has two readings: power dissipated by normal damping over that by sliding,
and gross work along normals over that along tangents. The time is that of one core, CPU time, so other work on the
machine hardly counts; recording the gross work is in it.
"""

import argparse
import json
import math
import re
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import polars as pl

import drumrs
from drumrs import analysis
from drumrs.figures import write
from drumrs.figures.shared import drumrs_style
from drumrs.paper.drums import BARE, TRIANGLES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STEPS_A_COLLISION = (20.0, 35.0, 50.0, 100.0, 200.0)
SOFTER = (10.0, 100.0)
FILL = 0.25
WINDOW = (4.0, 10.0)
SEEDS = (1, 2, 3)
# Colors of the two drums, those of all figures.
COLORS = {"bare": "C0", "three baffles": "C1"}
RECORD = ["gross_work"]
# Readings of N/T: what stands above the line, and below it.
RATIOS = {
    "ratio": ("dissipated_normal", "dissipated_sliding"),
    "gross_ratio": ("gross_work_normal", "gross_work_tangential"),
}
TABLE = re.compile(r"(<!-- table -->\n).*?(<!-- end of table -->)", re.DOTALL)


@dataclass(frozen=True)
class Setting:
    """A drum, how finely it steps through a collision between bundles, how soft it is."""

    baffles: bool
    steps: float
    softer: float = 1.0

    def config(self, seed: int) -> drumrs.Config:
        """Return the paper's drum at this setting."""
        run = {
            "seed": seed,
            "duration": WINDOW[1],
            "window": WINDOW,
            "frame_every": WINDOW[1],
            "record": RECORD,
        }
        base = (TRIANGLES if self.baffles else BARE).config(FILL).replace({"run": run})
        collision = base.derived.bundle.collision_time
        return base.replace({"run.time_step": collision / self.steps}).softer(self.softer)


def settings() -> Iterator[Setting]:
    """List the settings: the reference is fifty steps at full stiffness."""
    for baffles in (False, True):
        yield from (Setting(baffles, steps) for steps in STEPS_A_COLLISION)
        yield from (Setting(baffles, 50.0, softer) for softer in SOFTER)


def measure(setting: Setting, seed: int, folder: Path) -> None:
    """Run a setting, unless its result is kept already, and keep the result."""
    drum = "baffles" if setting.baffles else "bare"
    kept = folder / f"{drum}_{setting.steps:g}_{setting.softer:g}_{seed}.json"
    if kept.exists():
        return
    simulation = drumrs.Simulation(setting.config(seed))
    began = time.process_time()
    simulation.run()
    seconds = (time.process_time() - began) / WINDOW[1]
    summary = simulation.summary()
    ratios = {name: analysis.ratio_with_error(simulation.series, *of, WINDOW) for name, of in RATIOS.items()}
    row = {
        "baffles": setting.baffles,
        "steps_per_collision": setting.steps,
        "softer": setting.softer,
        "seed": seed,
        "time_step": simulation.time_step,
        "power": summary.drum_specific_power,
        "power_error": summary.drum_specific_power_error,
        **{name: ratio.value if ratio is not None else None for name, ratio in ratios.items()},
        **{f"{name}_error": ratio.error if ratio is not None else None for name, ratio in ratios.items()},
        "numerical_share": summary.numerical_power / summary.drum_power,
        "max_overlap_ratio": summary.max_overlap_ratio,
        "seconds": seconds,
    }
    kept.write_text(json.dumps(row), encoding="utf-8")
    print(f"{kept.stem}: {summary.drum_specific_power:.3f} W/kg, {seconds:.2f} s", flush=True)


def means(table: pl.DataFrame) -> list[dict[str, Any]]:
    """Return means over seeds: estimates of power and N/T, plain means of the rest."""
    found = []
    keys = ["baffles", "steps_per_collision", "softer"]
    for key, rows in table.group_by(keys, maintain_order=True):
        entry: dict[str, Any] = dict(zip(keys, key, strict=True))
        for name in ("power", *RATIOS):
            values, errors = rows[name].to_list(), rows[f"{name}_error"].to_list()
            entry[name] = analysis.estimate(values, errors)
        entry["seconds"] = rows["seconds"].median()
        entry["numerical_share"] = float(rows["numerical_share"].to_numpy().mean())
        entry["max_overlap_ratio"] = rows["max_overlap_ratio"].max()
        found.append(entry)
    return found


def lines_of(entries: Sequence[dict[str, Any]]) -> list[str]:
    """Return the table in Markdown."""
    lines = [
        "| drum | t_c / dt | softer | specific power [W/kg] | N/T, dissipated | N/T, gross | numerical "
        "| greatest overlap | s per s |",
        "|---" * 9 + "|",
    ]
    for entry in entries:
        power, ratios = entry["power"], [entry[name] for name in RATIOS]
        words = [
            "three baffles" if entry["baffles"] else "bare",
            f"{entry['steps_per_collision']:g}",
            f"{entry['softer']:g}",
            f"{power.mean:.3f} ± {power.error:.3f}",
            *(f"{ratio.mean:.3f} ± {ratio.error:.3f}" for ratio in ratios),
            f"{100.0 * entry['numerical_share']:+.2f} %",
            f"{100.0 * entry['max_overlap_ratio']:.1f} % of r",
            f"{entry['seconds']:.2f}",
        ]
        lines.append(f"| {' | '.join(words)} |")
    return lines


def draw(entries: Sequence[dict[str, Any]]) -> "Figure":
    """Draw power, N/T and time: against the steps that a collision takes, above, and the softening, below."""
    from matplotlib.figure import Figure

    with drumrs_style():
        figure = Figure(figsize=(9.0, 5.4))
        grid = figure.subplots(2, 3)
        for row, key, label in (
            (grid[0], "steps_per_collision", "Steps in a collision, t_c / dt"),
            (grid[1], "softer", "Stiffness lowered by (t_c / dt = 50)"),
        ):
            other = ("softer", 1.0) if key == "steps_per_collision" else ("steps_per_collision", 50.0)
            for baffles in (False, True):
                chosen = [
                    e for e in entries if e["baffles"] == baffles and math.isclose(e[other[0]], other[1])
                ]
                chosen.sort(key=lambda entry: float(entry[key]))
                _draw_row(row, chosen, key, "three baffles" if baffles else "bare")
            for axes in row:
                axes.set(xscale="log", xlabel=label)
                places = sorted({entry[key] for entry in entries})
                axes.set_xticks(places, [f"{place:g}" for place in places])
                axes.minorticks_off()
            row[0].set_ylabel("Specific power [W/kg]")
            row[1].set_ylabel("N/T: dissipated (—), gross (--)")
            row[2].set(ylabel="Time per simulated second [s]", yscale="log")
        grid[0][2].legend()
    return figure


def _draw_row(row: Any, entries: Sequence[dict[str, Any]], key: str, label: str) -> None:
    places = [entry[key] for entry in entries]
    color = COLORS[label]
    for axes, name, style in (
        (row[0], "power", "-"),
        *zip((row[1], row[1]), RATIOS, ("-", "--"), strict=True),
    ):
        intervals = [entry[name].interval() for entry in entries]
        heights, halves = [i.mean for i in intervals], [i.half_width for i in intervals]
        axes.errorbar(places, heights, halves, marker=".", capsize=3.0, color=color, linestyle=style)
    row[2].plot(places, [entry["seconds"] for entry in entries], marker=".", color=color, label=label)


def main() -> int:
    """Run what is missing, then write table and figure."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--runs", type=Path, default=Path("out/accuracy"), help="folder of the runs' results")
    parser.add_argument("--docs", type=Path, default=Path("docs"), help="folder of the page, accuracy.md")
    options = parser.parse_args()
    options.runs.mkdir(parents=True, exist_ok=True)
    for seed in SEEDS:
        for setting in settings():
            measure(setting, seed, options.runs)
    rows = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(options.runs.glob("*.json"))]
    table = pl.DataFrame(rows, infer_schema_length=None)
    table = table.sort("baffles", "softer", "steps_per_collision", "seed")
    folder = options.docs / "accuracy"
    folder.mkdir(parents=True, exist_ok=True)
    table.write_parquet(folder / "accuracy.parquet", compression="zstd", statistics=False)
    entries = means(table)
    write(draw(entries), folder / "accuracy.png")
    lines = "\n".join([*lines_of(entries), ""])
    page = options.docs / "accuracy.md"
    if page.exists():
        page.write_text(TABLE.sub(rf"\g<1>{lines}\g<2>", page.read_text(encoding="utf-8")), encoding="utf-8")
    print(lines)
    return 0


if __name__ == "__main__":
    sys.exit(main())
