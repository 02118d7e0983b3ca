"""`verify`: run the cases, on threads, and `Verification`, what came of them."""

import json
import math
import threading
import time
import warnings
from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs import DrumrsWarning, Task, effective_jobs
from drumrs.pages import write_page
from drumrs.verification.advance import PAUSE, broken_off
from drumrs.verification.case import Case, Trial
from drumrs.verification.catalog import chosen, family_of
from drumrs.verification.page import render

if TYPE_CHECKING:
    import polars as pl


@dataclass(frozen=True, eq=False, repr=False)
class Verification:
    """Cases that were run.

    Attributes
    ----------
    trials
        What came of each case, in the catalog's order.
    wall_time
        Time it took [s].
    jobs
        Cases that ran at once.
    """

    trials: tuple[Trial, ...]
    wall_time: float
    jobs: int

    def __repr__(self) -> str:
        """Say how many cases passed."""
        count = sum(trial.passed for trial in self.trials)
        return f"<Verification: {count} of {len(self.trials)} cases passed>"

    @property
    def passed(self) -> bool:
        """Whether every case passed."""
        return all(trial.passed for trial in self.trials)

    @property
    def failures(self) -> tuple[Trial, ...]:
        """The cases that failed."""
        return tuple(trial for trial in self.trials if not trial.passed)

    @property
    def table(self) -> "pl.DataFrame":
        """Polars table, one row a case, with the check that is nearest to failing, or fails by most.

        Its columns: family, case, title, source, quantity, unit, expected, measured, tolerance, ratio (distance over
        tolerance), checks (their number), passed, wall_time [s], error.
        """
        import polars as pl

        texts = ("family", "case", "title", "source", "quantity", "unit", "error")
        types: dict[str, Any] = dict.fromkeys(texts, pl.String)
        types |= dict.fromkeys(("expected", "measured", "tolerance", "ratio", "wall_time"), pl.Float64)
        types |= {"checks": pl.Int64, "passed": pl.Boolean}
        return pl.DataFrame([_row(trial) for trial in self.trials], schema_overrides=types)

    def to_json(self) -> str:
        """Return one JSON object: every case with every check; what is not finite is null."""
        cases = [{**_row(trial), "checks": _checks(trial)} for trial in self.trials]
        told = {"passed": self.passed, "wall_time": self.wall_time, "jobs": self.jobs}
        for row in cases:
            row.update({key: _finite(value) for key, value in row.items()})
        return json.dumps({**told, "cases": cases}, indent=2, ensure_ascii=False, allow_nan=False)

    def save(self, path: str | Path) -> Path:
        """Write the page: one HTML file that needs nothing else, with a plot a case.

        Raises
        ------
        ConfigError
            Where the file is there and was not written by drumrs.
        OSError
            Where the file cannot be written.
        """
        return write_page(path, render(self.trials, self.wall_time, self.jobs))


def _row(trial: Trial) -> dict[str, Any]:
    case, evidence = trial.case, trial.evidence
    worst = evidence.worst if evidence is not None else None
    return {
        "family": family_of(case),
        "case": case.name,
        "title": case.title,
        "source": case.source,
        "quantity": worst.quantity if worst else None,
        "unit": worst.unit if worst else None,
        "expected": worst.expected if worst else None,
        "measured": worst.measured if worst else None,
        "tolerance": worst.tolerance if worst else None,
        "ratio": worst.ratio if worst else None,
        "checks": len(evidence.checks) if evidence is not None else 0,
        "passed": trial.passed,
        "wall_time": trial.wall_time,
        "error": trial.error,
    }


def _checks(trial: Trial) -> list[dict[str, Any]]:
    found = trial.evidence.checks if trial.evidence is not None else ()
    rows = [{**asdict(check), "passed": check.passed} for check in found]
    return [{key: _finite(value) for key, value in row.items()} for row in rows]


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def verify(
    only: Sequence[str] | str | None = None, *, jobs: int | None = None, progress: bool = True
) -> Verification:
    """Hold the simulation against formulas, identities and its own promises: minutes on two cores.

    Parameters
    ----------
    only
        Names of the cases to run; all of them unless given.
    jobs
        Cases at once; one a usable core unless given.
    progress
        Whether to show progress, as a `drumrs.Task` does.

    Returns
    -------
    Verification
        Every case with what it measured.

    Raises
    ------
    ConfigError
        Where there is no case of a name.
    KeyboardInterrupt
        After Ctrl-C; the simulations under way are stopped.

    Examples
    --------
    >>> import drumrs
    >>> found = drumrs.verify(only=["restitution-clipped", "stack"], progress=False)
    >>> found.passed, found.table["case"].to_list()
    (True, ['restitution-clipped', 'stack'])
    """
    cases = chosen([only] if isinstance(only, str) else only)
    workers = effective_jobs(jobs)
    began = time.perf_counter()
    trials = _run(cases, workers, progress=progress)
    return Verification(trials, time.perf_counter() - began, workers)


def _run(cases: Sequence[Case], workers: int, *, progress: bool) -> tuple[Trial, ...]:
    """Run the cases, the long ones first, and return them in their order."""
    order = sorted(cases, key=lambda case: -case.cost)
    trials: dict[str, Trial] = {}
    halt = threading.Event()
    threads = ThreadPoolExecutor(workers, "drumrs", initializer=broken_off.set, initargs=(halt,))
    task = Task(
        "verification", sum(case.cost for case in cases), detail=f"0 of {len(cases)} cases", show=progress
    )
    with warnings.catch_warnings(), task, threads as pool:
        # Some cases stick, or turn slowly, on purpose.
        warnings.simplefilter("ignore", DrumrsWarning)
        waiting = {pool.submit(case.run) for case in order}
        try:
            while waiting:
                # A wait without an end may not hear Ctrl-C.
                done, waiting = wait(waiting, PAUSE, FIRST_COMPLETED)
                for trial in (future.result() for future in done):
                    trials[trial.case.name] = trial
                    task.advance(trial.case.cost, f"{len(trials)} of {len(cases)} cases")
        except BaseException:
            # Threads cannot be interrupted from outside; they look at this.
            halt.set()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return tuple(trials[case.name] for case in cases)
