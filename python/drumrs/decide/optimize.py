"""`optimize`: the best values of a few keys, with as few runs as it takes; goes on where it was interrupted."""

import json
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

import numpy as np

from drumrs.config import Config
from drumrs.decide.confirmed import Confirmed
from drumrs.decide.emulator import Array, require_packages
from drumrs.decide.evaluate import Evaluator
from drumrs.decide.optimization import Optimization
from drumrs.decide.problem import Problem
from drumrs.decide.search import Model, Search
from drumrs.errors import ConfigError
from drumrs.files import read_object, write_whole
from drumrs.folders import claim, require_own
from drumrs.jobs import effective_jobs
from drumrs.pictures import attempt
from drumrs.progress import Task

# What an optimization writes into its folder.
FILES = ("points.json", "history.parquet", "optimization.png", "best.toml", "runs")
# Seeds of the confirmation begin so far behind those of the search, which has fewer runs.
_FRESH = 10_000
# The runner-up differs from the winner by this part of the range of some key.
_APART = 0.1
# Points of a front that are confirmed.
_MOST_CONFIRMED = 5


def optimize(
    problem: Problem | str | Path | Mapping[str, Any],
    out: str | Path,
    *,
    executor: Executor | str | None = None,
    jobs: int | None = None,
    progress: bool = True,
) -> Optimization:
    """Find the best values of up to six keys for one or two targets, under constraints.

    After 2k + 2 points of a Sobol sequence, k being the number of keys, a Gaussian process for each target, which knows
    the statistical error of every run, says where runs are expected to improve most on the best mean. The search stops
    where a gain of more than the tolerance has become less likely than 5 %. The best of many noisy runs looks better
    than it is; so winner and runner-up, or points along the front of two objectives, are run again with fresh seeds,
    and what these say is the result.

    Parameters
    ----------
    problem
        TOML file with ``[base]``, ``[ranges]``, ``[axes]`` and ``[optimize]``, or what `Problem.read` takes else.
    out
        Folder for history.parquet, optimization.png, best.toml and the runs. The same call goes on where an earlier one
        was interrupted, with the same points; nothing is simulated twice.
    executor, jobs
        Who runs the cases, and how many at once, as for `drumrs.Sweep.run`. Of an executor that is given nobody knows
        how many it takes: say it in ``optimize.batch``, or as jobs.
    progress
        Whether to show progress.

    Raises
    ------
    ConfigError
        Where scikit-learn is missing, a key or value is not accepted, the folder is not one of this optimization, every
        run fails, or no run meets the constraints.
    OSError
        Where results cannot be written; what is finished is kept.
    KeyboardInterrupt
        After Ctrl-C; what is finished is kept.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> problem = {
    ...     "base": drumrs.baseline(fill=0.05).replace({"run.duration": 0.2}),
    ...     "ranges": {"rotation.rpm": [30, 60]},
    ...     "optimize": {"minimize": "drum_specific_power", "runs": 5, "confirm": 2},
    ... }
    >>> found = drumrs.optimize(problem, tempfile.mkdtemp(), progress=False)
    >>> 30.0 <= found.best["rotation.rpm"] <= 60.0
    True
    """
    require_packages("an optimization", "sklearn")
    wanted = problem if isinstance(problem, Problem) else Problem.read(problem)
    folder = Path(out)
    require_own(folder, "optimization", FILES)
    log = _Log(folder, wanted, effective_jobs(jobs))
    ask = Evaluator(
        [goal.target for goal in wanted.goals],
        folder / "runs",
        executor=executor,
        jobs=jobs,
        progress=progress,
    )
    search = Search(
        wanted.space,
        len(wanted.objectives),
        lambda point: wanted.space.config(wanted.base, point) is not None,
        wanted.tolerance.amount,
        wanted.tolerance.is_relative,
        log.batches,
    )
    for config in _configs(wanted, search.start(), 0):
        ask.case(config)
    claim(folder, "optimization", " and ".join(map(str, wanted.objectives)), wanted.digest)
    with Task("optimization", wanted.runs, detail="0 runs", show=progress) as task:

        def evaluate(points: Array, first: int) -> tuple[Array, Array]:
            found = _measure(wanted, ask, points, first)
            done, chance = first + len(points), search.chances[-1:] or [1.0]
            task.update(done, f"{done} runs, chance of a further gain {chance[0]:.0%}")
            return found

        model = search.run(evaluate, wanted.runs, log.batch, log.write)
    found = Optimization(wanted, search, model, ())
    found.write_table(folder / "history.parquet")
    if not model.ranked:
        raise found.nothing_feasible()
    found = Optimization(wanted, search, model, _confirm(wanted, ask, model))
    write_whole(folder / "best.toml", found.config.to_toml().encode())
    with attempt(folder / "optimization.png"):
        from drumrs.figures import write

        write(found.figure(), folder / "optimization.png")
    return found


def _configs(problem: Problem, points: Array, first: int) -> list[Config]:
    """Return the configurations of points, each with a seed of its own."""
    values = (problem.space.values(point) for point in points)
    seed = problem.base.run.seed + first
    return [problem.base.replace({**each, "run.seed": seed + k}) for k, each in enumerate(values)]


def _measure(problem: Problem, ask: Evaluator, points: Array, first: int) -> tuple[Array, Array]:
    """Run points, each with a seed of its own; return signed values and errors, shape (n, goals) each."""
    try:
        means = ask.means(_configs(problem, points, first))
    except ConfigError as error:
        # Where all of a later batch fail the search goes on elsewhere.
        if error.key != "configs" or not first:
            raise
        return (np.full((len(points), len(problem.goals)), np.nan),) * 2
    signed = np.array(
        [[goal.signed_mean(mean) for goal, mean in zip(problem.goals, row, strict=True)] for row in means]
    )
    if not first and np.isnan(signed[..., 0]).any(axis=1).all():
        missing = [
            str(goal.target) for k, goal in enumerate(problem.goals) if np.isnan(signed[:, k, 0]).all()
        ]
        named = " and ".join(missing or (str(goal.target) for goal in problem.goals))
        lacks = f"asks for {named}, which none of the first {len(points)} runs has"
        raise ConfigError("optimize", problem=lacks, hint="run longer, or in other ranges")
    return signed[..., 0], signed[..., 1]


def _confirm(problem: Problem, ask: Evaluator, model: Model) -> tuple[Confirmed, ...]:
    """Run what is best with fresh seeds; return it, the best one on these seeds first."""
    chosen = _chosen(model)
    configs = [problem.base.replace(problem.space.values(model.points[k])) for k in chosen]
    first = problem.base.run.seed + _FRESH
    fresh = ask.estimates(configs, range(first, first + problem.confirm))
    found = [Confirmed.of(problem, model, k, estimates) for k, estimates in zip(chosen, fresh, strict=True)]
    if model.objectives > 1:
        return tuple(found)
    return tuple(sorted(found, key=lambda one: (one.misses(problem) != [], one.signed(problem))))


def _chosen(model: Model) -> list[int]:
    ranked = model.ranked
    if model.objectives > 1:
        places = np.linspace(0, len(ranked) - 1, min(_MOST_CONFIRMED, len(ranked)))
        return [ranked[round(place)] for place in places.tolist()]
    apart = np.abs(model.points[ranked] - model.points[ranked[0]]).max(axis=1)
    others = [ranked[k] for least in (_APART, 0.0) for k in np.flatnonzero(apart > least)[:1]]
    return [ranked[0], *others[:1]]


class _Log:
    """The points of a search in its folder, written before they are run: an interrupted search goes on with them."""

    def __init__(self, folder: Path, problem: Problem, jobs: int) -> None:
        self._path, self._problem = folder / "points.json", problem
        kept = read_object(self._path)
        if kept is not None and kept.get("problem") != problem.digest:
            limit = "a new folder or one of the same search: this one is of other keys, ranges, goals or another base"
            raise ConfigError("folder", folder, limit, hint="choose another folder")
        places = problem.space.place
        self.batch: int = kept["batch"] if kept else problem.batch or jobs
        self.batches = (
            [np.array([places(values) for values in each]) for each in kept["batches"]] if kept else []
        )

    def write(self, batches: Sequence[Array]) -> None:
        """Keep the points of all batches."""
        listed = [[self._problem.space.values(point) for point in each] for each in batches]
        content = {"problem": self._problem.digest, "batch": self.batch, "batches": listed}
        write_whole(self._path, f"{json.dumps(content, indent=1)}\n".encode())
