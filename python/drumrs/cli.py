"""The command line: `drumrs run`, `drumrs baseline`, `drumrs config`, `drumrs info`."""

import math
import os
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Annotated

from cyclopts import App, CycloptsError, Parameter

import drumrs
from drumrs.config import Config, merge, nest, parse_settings, read_toml_file
from drumrs.errors import CheckpointError, ConfigError, UnstableError
from drumrs.progress import board
from drumrs.protocol import announce, finish, run_side_by_side
from drumrs.result import Result, Summary
from drumrs.simulation import Simulation

_BAD_INPUT = 2
_FAILED = 1
_INTERRUPTED = 130
_CHECKPOINT = "checkpoint.bin"

app = App(
    name="drumrs",
    help="Simulate a load tumbling in a rotating drum, with an energy balance that closes.",
    help_format="markdown",
    help_epilogue=(
        "Examples:\n\n"
        "- `drumrs baseline --out out` runs the paper's drum without and with baffles\n"
        "- `drumrs config > case.toml` writes every key, with unit and meaning\n"
        "- `drumrs run case.toml --set contact.bundle.friction=0.3 --out out`\n"
        "- `drumrs run --set 'run.window=[5, 15]' --set run.duration=15 --seed 2 --json`\n"
        "- `drumrs run --resume out` goes on after Ctrl-C or a power cut"
    ),
    version=drumrs.__version__,
    suppress_keyboard_interrupt=False,
    result_action="return_value",
)

Settings = Annotated[
    list[str] | None,
    Parameter(
        name="--set",
        negative="",
        help="KEY=VALUE, a layer over the file; may be repeated. VALUE is a TOML literal, a bare word a string.",
    ),
]
Seed = Annotated[int | None, Parameter(help="Seed of the random start, over all layers.")]
Threads = Annotated[int, Parameter(help="Threads that share a step; the result is the same for any number.")]


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and leave with its exit status."""
    sys.exit(run_command(arguments))


def run_command(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return 0, 1 (the run failed), 2 (bad input) or 130 (Ctrl-C)."""
    words = sys.argv[1:] if arguments is None else list(arguments)
    try:
        app(words, exit_on_error=False, print_error=False)
    except (ConfigError, CheckpointError) as error:
        return _complain(str(error), _BAD_INPUT)
    except CycloptsError as error:
        return _complain(" ".join(str(error).split()), _BAD_INPUT)
    except (UnstableError, OSError) as error:
        return _complain(str(error), _FAILED)
    except KeyboardInterrupt as interrupt:
        return _complain(str(interrupt) or "interrupted", _INTERRUPTED)
    return 0


def _complain(sentence: str, status: int) -> int:
    sys.stderr.write(f"drumrs: {sentence}\n")
    return status


@app.command
def run(
    case: Path | None = None,
    /,
    *,
    set_: Settings = None,
    seed: Seed = None,
    threads: Threads = 1,
    out: Path | None = None,
    json: Annotated[bool, Parameter(negative="")] = False,
    resume: Path | None = None,
) -> None:
    """Run a case: the paper's baseline, a TOML file laid over it, settings laid over the file.

    The last word wins: baseline, CASE.toml, `--set`, `--seed`. One of a pair (`load.fill` or `load.count`,
    `restitution` or `normal_damping`, `rotation.rpm` or `rotation.program`) takes the place of the other from a
    lower layer. `drumrs config` lists the keys.

    Parameters
    ----------
    case
        TOML file with some keys of `drumrs config`.
    out
        Folder for summary.json, series.parquet, frames.parquet, config.toml, pictures and checkpoints.
    json
        Print the summary as one JSON object, and nothing else, on standard output.
    resume
        Go on from the checkpoint in this folder; the results are those of a run without a break.
    """
    if resume is not None:
        if case is not None or set_ or seed is not None or out is not None:
            raise ConfigError(
                "--resume takes the case from its folder, so CASE, --set, --seed and --out must not be given"
            )
        out = resume
        simulation = Simulation.load(out / _CHECKPOINT, threads)
        _check_folder(out, "--resume")
    else:
        config = _layered(case, set_, seed)
        if out is not None:
            _check_folder(out)
        simulation = Simulation(config, threads=threads)
        _open_folder(out, simulation.config)
    _finish(simulation, out)
    result = simulation.result()
    written = result.save(out) if out is not None else []
    if json:
        sys.stdout.write(f"{result.summary.to_json()}\n")
    else:
        _print_table({"": result})
        _print_paths(written)


@app.command
def baseline(
    *, fill: float = 0.25, out: Path = Path("out"), set_: Settings = None, seed: Seed = None
) -> None:
    """Run the paper's drum without and with baffles, side by side, and compare them.

    Parameters
    ----------
    fill
        Fill N d²/D²; 0.25 is 100 bundles.
    out
        Folder for the results of both and a picture that shows them next to each other.
    """
    _check_folder(out)
    layer = nest(parse_settings(set_ or []))
    if seed is not None:
        layer = merge(Config, layer, {"run": {"seed": seed}})
    cases = {
        name: drumrs.baseline(fill, baffles=baffles).replace(layer)
        for name, baffles in (("without baffles", False), ("with baffles", True))
    }
    results = run_side_by_side(cases)
    written = [path for name, result in results.items() for path in result.save(out / name.replace(" ", "_"))]
    _print_table(results)
    _print_paths([_draw_together(results, out), *(path for path in written if path.suffix == ".png")])


@app.command
def config() -> None:
    """Print every key with its default, unit and meaning, as TOML: `drumrs config > case.toml`."""
    sys.stdout.write("# The baseline of drumrs, the paper's Table 1. Keep what differs, delete the rest.\n\n")
    sys.stdout.write(drumrs.baseline().to_toml())


@app.command
def info() -> None:
    """Print what this copy of drumrs is: versions, build profile, CPU features."""
    for key, value in drumrs.info().items():
        shown = " ".join(map(str, value)) if isinstance(value, (list, tuple)) else value
        sys.stdout.write(f"{key}: {shown}\n")
    sys.stdout.write(f"python: {sys.version.split()[0]}\n")
    for library in ("numpy", "polars", "matplotlib", "pydantic"):
        sys.stdout.write(f"{library}: {version(library)}\n")


def _layered(case: Path | None, settings: Sequence[str] | None, seed: int | None) -> Config:
    layers = [read_toml_file(case)] if case is not None else []
    layers.append(nest(parse_settings(settings or [])))
    if seed is not None:
        layers.append({"run": {"seed": seed}})
    # Layers are merged before anything is validated: an upper one may mend what a lower one breaks.
    values = drumrs.baseline().model_dump(exclude_none=True)
    for layer in layers:
        values = merge(Config, values, layer)
    return Config.model_validate(values)


def _check_folder(folder: Path, option: str = "--out") -> None:
    """Refuse a folder that cannot be written, before anything is simulated or created."""
    existing = next(path for path in (folder.absolute(), *folder.absolute().parents) if path.exists())
    if not existing.is_dir():
        raise ConfigError(f"{option} is {str(folder)!r}, but must be a folder: {str(existing)!r} is a file")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise ConfigError(f"{option} is {str(folder)!r}, but must be a folder that can be written")


def _open_folder(folder: Path | None, config: Config) -> None:
    """Create the folder and mark it as that of a run not finished yet."""
    if folder is None:
        return
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "summary.json").unlink(missing_ok=True)
        (folder / "config.toml").write_text(config.to_toml(), encoding="utf-8")
    except OSError as error:
        raise ConfigError(
            f"--out is {str(folder)!r}, but must be a folder that can be written: {error.strerror}"
        ) from None


def _finish(simulation: Simulation, out: Path | None) -> None:
    checkpoint = out / _CHECKPOINT if out is not None else None
    try:
        with board(show=True) as shown:
            finish(simulation, announce(shown, simulation), checkpoint)
    except KeyboardInterrupt:
        hint = (
            f"go on with: drumrs run --resume {out}" if out is not None else "nothing is kept without --out"
        )
        raise KeyboardInterrupt(f"interrupted at t = {simulation.time:.3f} s; {hint}") from None


def _print_table(results: dict[str, Result]) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    columns = [_rows(result.summary) for result in results.values()]
    table = Table(box=None, show_header=len(results) > 1, highlight=False)
    table.add_column("")
    for name in results:
        table.add_column(name, justify="right", no_wrap=True)
    for label in columns[0]:
        table.add_row(escape(label), *(column[label] for column in columns))
    Console(highlight=False).print(table)


def _rows(summary: Summary) -> dict[str, str]:
    """Return what the table shows of a summary, by label."""
    window = f"{summary.window_start:.4g}–{summary.window_end:.4g}"
    x, y = (f"{1e3 * value:.1f}" for value in summary.center_of_mass)
    return {
        "bundles": str(summary.bundle_count),
        "averages over t = [s]": window,
        "specific power [W/kg]": _with_error(summary.specific_power, summary.specific_power_error),
        "drum power [W/m]": _number(summary.drum_power),
        "torque [N m/m]": _number(summary.drum_torque),
        "normal / tangential power": _number(summary.normal_tangential_ratio),
        "center of mass [mm]": f"({x}, {y})",
        "contacts per bundle": _number(summary.coordination),
        "greatest overlap / radius": _number(summary.max_overlap_ratio),
        "energy residual": f"{summary.energy_residual:.1e}",
        "disagreement of three powers": f"{summary.power_disagreement:.1e}",
        "wall time [s]": f"{summary.wall_time:.1f}",
        "million particle-steps per second": _number(summary.particle_steps_per_second, 1e-6),
    }


def _number(value: float | None, scale: float = 1.0) -> str:
    return "–" if value is None else f"{scale * value:.4g}"


def _with_error(value: float, error: float | None) -> str:
    """Show a value with its standard error, both to the error's second digit."""
    if not error:
        return _number(value)
    digits = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def _print_paths(paths: Sequence[Path]) -> None:
    for path in paths:
        sys.stdout.write(f"wrote {path}\n")


def _draw_together(results: dict[str, Result], out: Path) -> Path:
    from drumrs import figures

    views = [figures.View(result.frames, -1, name) for name, result in results.items()]
    path = out / "baseline.png"
    figures.write(figures.snapshots(views), path)
    return path
