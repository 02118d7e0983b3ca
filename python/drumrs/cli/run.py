"""`drumrs run`: one case, from the start or from a checkpoint."""

import math
import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.analysis.phases import phases_of
from drumrs.cli.messages import note
from drumrs.cli.options import NUMBER, PATH, Seed, Settings, Threads, check_folder, layered
from drumrs.cli.tables import print_paths, print_phases, print_species, print_table
from drumrs.config import Config
from drumrs.config.softening import softening
from drumrs.errors import ConfigError, UnstableError
from drumrs.folders import RUN_FILES, require_own, require_unused
from drumrs.frames import Frames
from drumrs.limits import require_disk
from drumrs.precision import Goal, run_until_precise
from drumrs.run_folder import RunFolder
from drumrs.runs import packing, run_to_end
from drumrs.simulation import Simulation
from drumrs.unstable import refuse_to_repeat

# Bundles times frames that are read for means by species.
_MOST_PLACES = 2_000_000


def run(
    case: Path | None = None,
    /,
    *,
    set_: Settings = None,
    seed: Seed = None,
    threads: Threads = 1,
    out: Annotated[Path | None, PATH] = None,
    json: Annotated[bool, Parameter(negative="")] = False,
    resume: Annotated[Path | None, PATH] = None,
    until: Annotated[float | None, NUMBER] = None,
    limit: Annotated[float | None, NUMBER] = None,
    softer: Annotated[float | None, NUMBER] = None,
    force: Annotated[bool, Parameter(negative="")] = False,
) -> None:
    """Run a case: the paper's baseline, a TOML file laid over it, settings laid over the file.

    The last word wins: baseline, CASE.toml, `--set`, `--seed`. One of a choice (`load.fill`, `.count`,
    `.bulk_fill` or `.mass`, `restitution` or `normal_damping`, `rotation.rpm`, `.program` or `.phase`) takes the place
    of the others from a lower layer. `drumrs config` lists the keys.

    Parameters
    ----------
    case
        TOML file with some keys of `drumrs config`.
    out
        Folder for summary.json, series.parquet, frames.parquet, config.toml, pictures, player.html and checkpoints, and
        for phases.parquet where the drum turns by phases. A run that ends unstable leaves unstable.json instead of
        summary.json and pictures; the rest shows its end. While it runs, series and frames go to its folder "records"
        as they come.
    json
        Print the summary as one JSON object, and nothing else, on standard output.
    resume
        Go on from the checkpoint in this folder; the results are those of a run without a break.
    until
        Go on beyond the duration until the standard error of the specific power is this share of it: 0.01 is 1 %. The
        averages' window then ends with the run.
    limit
        Simulated time [s] at which to give that up; ten times the duration unless given.
    softer
        Lower both stiffnesses by this factor, over all layers, and lengthen the time step by its square root: 100 makes
        a run four to six times faster and overlaps ten times larger. docs/accuracy.md has what it does to the results.
    force
        Replace the run that the folder of `--out` holds. Files that drumrs did not write are never overwritten.
    """
    if resume is not None:
        if case is not None or set_ or seed is not None or out is not None or softer is not None or force:
            others = "CASE, --set, --seed, --softer, --out and --force"
            problem = f"takes the case from its folder, so {others} must not be given"
            raise ConfigError("--resume", resume, problem=problem)
        out = resume
        begun = RunFolder(out)
        simulation = begun.load(threads)
        refuse_to_repeat(out, simulation)
        goal = _goal(until, limit, _first_duration(out, simulation.config))
        check_folder(out, "--resume")
        # A checkpoint alone may have come from anywhere; what would be written beside it takes nobody's place.
        require_own(out, "run", [name for name in RUN_FILES if name != "checkpoint.bin"], "--resume")
        begun.restore(simulation)
        folder: RunFolder | None = begun
    else:
        config = _soften(layered(case, set_, seed), softer)
        goal = _goal(until, limit, config.run.duration)
        if out is not None:
            check_folder(out)
            _require_folder(out, case, force=force)
        with packing(config, show=True):
            simulation = Simulation(config, threads=threads, in_memory=out is None)
        folder = _open_folder(out, simulation)
        note(simulation.facts)
    try:
        reached = _finish(simulation, folder, goal)
    except UnstableError as error:
        _keep_unstable(simulation, folder, error)
        if softer is not None and softer > 1.0:
            note(
                f"the springs are {softer:g} times softer than the case's: overlaps go with the root of --softer"
            )
        raise
    summary, written = folder.conclude(simulation) if folder is not None else (simulation.summary(), [])
    if json:
        sys.stdout.write(f"{summary.to_json()}\n")
    else:
        print_table({"": summary})
        if simulation.config.rotation.phase:
            print_phases(phases_of(simulation.config, simulation.series))
        if simulation.config.load.species:
            _print_species(simulation, folder, (summary.window_start, summary.window_end))
        print_paths(written)
    if reached:
        note(reached)


def _soften(config: Config, factor: float | None) -> Config:
    """Lower the stiffnesses by a factor, and say on standard error what that changes."""
    if factor is None:
        return config
    changes = softening(config, factor, "--softer")
    changed = ", ".join(f"{key} {before:.4g} → {after:.4g}" for key, (before, after) in changes.items())
    note(f"--softer {factor:g} changes {changed}")
    return config.softer(factor)


def _goal(until: float | None, limit: float | None, duration: float) -> Goal | None:
    if until is None and limit is not None:
        raise ConfigError("--limit", limit, "left out where --until is not given")
    return Goal.of(until, limit, duration) if until is not None else None


def _first_duration(folder: Path, config: Config) -> float:
    """Return the duration [s] that a run was begun with: its checkpoint may be of one extended since."""
    begun = folder / "config.toml"
    return min(Config.read(begun).run.duration if begun.exists() else math.inf, config.run.duration)


def _require_folder(folder: Path, case: Path | None, *, force: bool) -> None:
    """Refuse a folder that holds another run, or the case file itself."""
    if case is not None and case.resolve().parent == folder.resolve() and case.name in RUN_FILES:
        limit = f"another folder than that of {str(case)!r}, which would be overwritten"
        raise ConfigError("--out", folder, limit)
    require_own(folder, "run", RUN_FILES, "--out")
    if not force:
        require_unused(folder, "run", option="--out")


def _open_folder(path: Path | None, simulation: Simulation) -> RunFolder | None:
    """Create the folder and mark it as that of a run not finished yet."""
    if path is None:
        return None
    require_disk(simulation.config, simulation.time_step, simulation.records.sizes, path)
    folder = RunFolder(path)
    try:
        folder.begin(simulation.config)
    except OSError as error:
        raise ConfigError("--out", path, f"a folder that can be written: {error.strerror}") from None
    return folder


def _keep_unstable(simulation: Simulation, folder: RunFolder | None, error: UnstableError) -> None:
    """Save what was recorded until a run ended unstable, and say where."""
    if folder is None:
        note("nothing is kept of this run without --out")
        return
    folder.conclude_unstable(simulation, error)
    out = folder.path
    note(f"what was recorded is in {out}; look at its end with: drumrs view {out}")


def _print_species(simulation: Simulation, folder: RunFolder | None, window: tuple[float, float]) -> None:
    """Print what each species has, where the averages' window holds frames."""
    from drumrs.measures import by_species

    if 2.0 * simulation.config.run.frame_every <= window[1] - window[0]:
        kept = Frames.load(folder.path / "frames.parquet", _MOST_PLACES) if folder else simulation.frames
        print_species(by_species(simulation.config, kept, window))


def _finish(simulation: Simulation, folder: RunFolder | None, goal: Goal | None) -> str:
    """Run to the end, or on to the goal; return what of that was reached."""
    words = f"--until {goal.precision:g} --limit {goal.limit:g}" if goal is not None else ""
    hint = f"go on with: drumrs run --resume {folder.path} {words}".rstrip() if folder is not None else ""
    hint = hint or "nothing is kept without --out"
    try:
        if goal is not None:
            return run_until_precise(simulation, goal, folder)
        run_to_end(simulation, folder)
    except MemoryError as error:
        raise MemoryError(f"out of memory at t = {simulation.time:.3f} s: {error}; {hint}") from None
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted at t = {simulation.time:.3f} s; {hint}") from None
    return ""
