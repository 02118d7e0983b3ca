"""The inference in one go: scan with softer springs, emulate, weigh, confirm at full stiffness, weigh again, write."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from drumrs.config import Config
from drumrs.decide.emulator import require_packages
from drumrs.errors import ConfigError
from drumrs.folders import claim, require_own
from drumrs.jobs import effective_jobs
from drumrs.paper.baffle import page
from drumrs.paper.baffle.design import Plan, Point
from drumrs.paper.baffle.emulator import emulate
from drumrs.paper.baffle.evidence import Means
from drumrs.paper.baffle.findings import Inference
from drumrs.paper.baffle.observations import Key, known_by_shape, observe
from drumrs.paper.baffle.posterior import (
    measured_corrections,
    posterior,
    predict,
    provisional_corrections,
    round_shapes,
    spread_over,
)
from drumrs.paper.baffle.sentences import log_likelihood
from drumrs.paper.shape import TRIANGLE, Shape, shapes_in_region
from drumrs.progress import Task
from drumrs.sweep import Failure, Sweep

if TYPE_CHECKING:
    import polars as pl

# What an inference writes into its folder.
FILES = ("baffle.md", "baffle.parquet", "figures", "runs")
# Shapes at which the posterior is known.
_DENSE = 20_000
# Factors of the tolerances.
FACTORS = (0.5, 1.0, 2.0)


def infer_baffle(
    folder: str | Path, plan: Plan | None = None, jobs: int | None = None, *, progress: bool = True
) -> Inference:
    """Infer the shape of the paper's baffle, whose drawing is lost, from what the paper says of it.

    Shapes spread over a region are run with softer springs; a Gaussian process predicts the others; every sentence
    that speaks of baffles weighs them. The likeliest, spread over what the sentences leave, are run at full stiffness,
    which also tells what softer springs change; then all is weighed again. The best of the confirmed is the inferred.

    Parameters
    ----------
    folder
        Gets baffle.md, baffle.parquet, figures/ and runs/, the results of every case.
    plan
        How many shapes, how long; the usual unless given.
    jobs
        Cases at once; one a usable core unless given.
    progress
        Whether to show how far it is.

    Raises
    ------
    ConfigError
        Where scikit-learn is missing, the number of jobs is not accepted, the folder is not one of an inference, or
        too few shapes could be run.
    OSError
        Where something cannot be written; finished cases are kept.
    KeyboardInterrupt
        After Ctrl-C; finished cases are kept, and the same call goes on.

    Examples
    --------
    >>> from drumrs.paper import infer_baffle
    >>> infer_baffle("out/baffle").best  # doctest: +SKIP
    """
    require_packages("the inference of the baffle", "sklearn")
    folder, plan, jobs = Path(folder), plan or Plan(), effective_jobs(jobs)
    require_own(folder, "baffle", FILES)
    claim(folder, "baffle", "the inference of the paper's baffle", "")
    runner = _Runner(folder, jobs, progress=progress)

    scan = plan.scan()
    runner.run({**plan.bare(), **plan.soft(scan)})
    first = runner.known()
    bare = first[None, 1.0]
    emulators = emulate(_with_springs(first, plan.softer))
    candidates = round_shapes()
    guess = predict(emulators, _rows(candidates), bare, provisional_corrections())
    chosen = spread_over(candidates, log_likelihood(guess), plan.confirmed)
    chosen = list(dict.fromkeys([TRIANGLE, *chosen]))

    runner.run(plan.soft(chosen))
    for shape in chosen:
        runner.run(plan.stiff([shape]))
    with Task("posterior, figure and page", 0, show=progress):
        inference = _conclude(plan, runner, bare)
        page.write(inference, folder)
    return inference


def _conclude(plan: Plan, runner: "_Runner", bare: Means) -> Inference:
    """Weigh all shapes again, with what was learned at full stiffness."""
    known = runner.known()
    soft, stiff = _with_springs(known, plan.softer), _with_springs(known, 1.0)
    both = [shape for shape in stiff if shape in soft]
    if not both:
        raise ConfigError("plan", plan, "one that leaves shapes run at both stiffnesses")
    emulators = emulate(soft)
    rows = _rows(both)
    measured = {
        one: (
            np.array([stiff[shape][one][0] for shape in both]),
            np.array([stiff[shape][one][1] for shape in both]),
        )
        for one in stiff[both[0]]
    }
    corrections = measured_corrections(predict(emulators, rows, {}, {}), measured)
    dense = shapes_in_region(_DENSE)
    predicted = predict(emulators, dense, bare, corrections)
    confirmed = {shape: {**soft[shape], **bare, **stiff[shape]} for shape in both}
    ranked = sorted(both, key=lambda shape: -float(log_likelihood(confirmed[shape])))
    return Inference(
        plan,
        runner.table(),
        emulators,
        bare,
        corrections,
        {factor: posterior(dense, predicted, factor) for factor in FACTORS},
        predicted,
        {shape: confirmed[shape] for shape in ranked},
        tuple(runner.failures),
    )


class _Runner:
    """Runs cases into one folder and keeps what they tell."""

    def __init__(self, folder: Path, jobs: int, *, progress: bool) -> None:
        self.folder, self.jobs, self.progress = folder, jobs, progress
        self.failures: list[Failure] = []
        self._tables: list[pl.DataFrame] = []

    def run(self, points: dict[Point, Config]) -> None:
        """Run what is not finished, and read what it tells."""
        runs = self.folder / "runs"
        outcome = Sweep.from_configs(points.values()).run(runs, jobs=self.jobs, progress=self.progress)
        self.failures += outcome.failures
        self._tables.append(observe(points, runs))

    def table(self) -> "pl.DataFrame":
        """Return the table of all means."""
        import polars as pl

        return pl.concat(self._tables).unique(maintain_order=True)

    def known(self) -> dict[Key, Means]:
        """Return what is known of each shape."""
        return known_by_shape(self.table())


def _with_springs(known: Mapping[Key, Means], softer: float) -> dict[Shape, Means]:
    return {shape: one for (shape, springs), one in known.items() if shape is not None and springs == softer}


def _rows(shapes: "list[Shape]") -> "np.ndarray":
    return np.array([shape.lengths for shape in shapes])
