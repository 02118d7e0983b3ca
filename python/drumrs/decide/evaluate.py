"""`evaluate`: what targets are for configurations, each run simulated once and kept in the folder of a sweep."""

import math
import warnings
from collections.abc import Iterable, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.analysis import Estimate, Mean
from drumrs.decide.readings import Readings
from drumrs.decide.targets import Target
from drumrs.errors import ConfigError, DrumrsWarning
from drumrs.progress import Task
from drumrs.sweep import Case, Sweep
from drumrs.sweep.store import Store

if TYPE_CHECKING:
    from drumrs.config import Config
    from drumrs.sweep import Failure

_NOTHING = Mean(math.nan, None)
# Failures that are named one by one.
_MOST_NAMED = 3


class Evaluator:
    """Asks configurations for targets: simulates what the folder does not hold yet, and measures each run once.

    Parameters
    ----------
    targets
        What is asked: texts that `Target.parse` reads, or targets.
    out
        Folder of a sweep, in which the runs are kept; made where there is none. What it holds is never simulated
        again, so a study that was interrupted goes on where it was.
    executor, jobs
        Who runs the cases, and how many at once, as for `drumrs.Sweep.run`.
    retry
        Whether cases that failed in an earlier study are run again.
    progress
        Whether to show progress.

    Attributes
    ----------
    targets : tuple of Target
        What is asked.

    Raises
    ------
    ConfigError
        Where a target is none.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> from drumrs.decide import Evaluator
    >>> ask = Evaluator(["drum_specific_power"], tempfile.mkdtemp(), progress=False)
    >>> ((power,),) = ask.means([drumrs.baseline(fill=0.1).replace({"run.duration": 0.2})])
    >>> power.value > 0.0
    True
    """

    def __init__(
        self,
        targets: Iterable[str | Target],
        out: str | Path,
        *,
        executor: Executor | str | None = None,
        jobs: int | None = None,
        retry: bool = False,
        progress: bool = True,
    ) -> None:
        self.targets = tuple(Target.parse(target) for target in targets)
        if not self.targets:
            raise ConfigError("targets", [], "a list of at least one target")
        self._store = Store(out)
        self._how = (executor, jobs)
        self._retry, self._progress = retry, progress
        self._known: dict[str, tuple[Mean, ...]] = {}

    def case(self, config: "Config") -> Case:
        """Return the case that is run for a configuration: it records what the targets need.

        Raises
        ------
        ConfigError
            Where the run will not have a target, see `Target.check`.
        """
        wanted = [record for target in self.targets for record in target.records]
        record = tuple(dict.fromkeys((*config.run.record, *wanted)))
        case = Case(config if record == config.run.record else config.replace({"run.record": record}))
        for target in self.targets:
            target.check(case.config)
        return case

    def missing(self, configs: "Iterable[Config]") -> list[Case]:
        """Return the cases that the folder does not hold yet: what `means` would simulate."""
        cases = {case.id: case for case in map(self.case, configs)}
        return [
            case for case in cases.values() if case.id not in self._known and not self._store.is_settled(case)
        ]

    def means(self, configs: "Sequence[Config]") -> list[tuple[Mean, ...]]:
        """Return the targets of each configuration, seed inside, in the order of both.

        A run that fails, as one that ends unstable, is told in a warning; its targets are not numbers.

        Parameters
        ----------
        configs
            The configurations.

        Raises
        ------
        ConfigError
            Where every run failed, or a run has no number for a target by its nature: a phase that is not there.
        OSError
            Where results cannot be written; what is finished is kept.
        KeyboardInterrupt
            After Ctrl-C; what is finished is kept.
        """
        cases = [self.case(config) for config in configs]
        new = {case.id: case for case in cases if case.id not in self._known}
        if new:
            self._run(list(new.values()))
        return [self._known[case.id] for case in cases]

    def estimates(
        self, configs: "Sequence[Config]", seeds: Iterable[int] | None = None
    ) -> list[tuple[Estimate, ...]]:
        """Return the targets of each configuration over seeds, in the order of both.

        Parameters
        ----------
        configs
            The configurations.
        seeds
            Seeds with which each is run; its own alone unless given. Arguments and errors are those of `means` else.
        """
        chosen = None if seeds is None else list(seeds)
        if chosen == []:
            raise ConfigError("seeds", [], "a list of at least one seed")
        by_seed = [
            [config] if chosen is None else [config.replace({"run.seed": seed}) for seed in chosen]
            for config in configs
        ]
        found = iter(self.means([config for group in by_seed for config in group]))
        grouped = [[next(found) for _ in group] for group in by_seed]
        return [
            tuple(
                target.of_seeds(column)
                for target, column in zip(self.targets, zip(*group, strict=True), strict=True)
            )
            for group in grouped
        ]

    def _run(self, cases: Sequence[Case]) -> None:
        executor, jobs = self._how
        sweep = Sweep.from_configs(case.config for case in cases)
        outcome = sweep.run(self._store.folder, executor, jobs, retry=self._retry, progress=self._progress)
        failed = {failure.case.id for failure in outcome.failures}
        _tell(outcome.failures, len(cases))
        with Task("measuring", len(cases), "runs", show=self._progress) as task:
            for case in cases:
                if case.id in failed:
                    self._known[case.id] = (_NOTHING,) * len(self.targets)
                else:
                    readings = Readings(self._store.result(case))
                    self._known[case.id] = tuple(target.mean(readings) for target in self.targets)
                task.advance()


def evaluate(  # noqa: PLR0913 - what, where, with which seeds, and by whom
    configs: "Sequence[Config]",
    targets: Iterable[str | Target],
    *,
    out: str | Path,
    seeds: Iterable[int] | None = None,
    executor: Executor | str | None = None,
    jobs: int | None = None,
    progress: bool = True,
) -> list[tuple[Estimate, ...]]:
    """Return what targets are for configurations, with their statistical errors.

    Parameters
    ----------
    configs
        The configurations.
    targets
        What is asked: texts that `Target.parse` reads, or targets.
    out
        Folder of a sweep, in which the runs are kept: what it holds is never simulated again.
    seeds
        Seeds with which each configuration is run; its own alone unless given.
    executor, jobs
        Who runs the cases, and how many at once, as for `drumrs.Sweep.run`.
    progress
        Whether to show progress.

    Returns
    -------
    list of tuple of Estimate
        For each configuration an estimate of each target; not a number, with an infinite error, where no run of it
        has one: it failed, as a warning tells, or nothing falls where the drop of falls is asked.

    Raises
    ------
    ConfigError
        Where a target is none, or is not in what a run can tell; where every run failed.
    OSError
        Where results cannot be written; what is finished is kept.
    KeyboardInterrupt
        After Ctrl-C; what is finished is kept.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> configs = [drumrs.baseline(fill).replace({"run.duration": 0.2}) for fill in (0.05, 0.1)]
    >>> found = drumrs.evaluate(configs, ["drum_power"], out=tempfile.mkdtemp(), seeds=[1, 2], progress=False)
    >>> len(found), found[0][0].mean < found[1][0].mean
    (2, True)
    """
    ask = Evaluator(targets, out, executor=executor, jobs=jobs, progress=progress)
    return ask.estimates(configs, seeds)


def _tell(failures: "Sequence[Failure]", count: int) -> None:
    """Warn of runs that failed; refuse to go on where all did."""
    if not failures:
        return
    named = "; ".join(f"{each.case.config.title}: {each.message}" for each in failures[:_MOST_NAMED])
    if len(failures) == count:
        raise ConfigError("configs", problem=f"fail in every run ({count}): {named}")
    warnings.warn(
        f"{len(failures)} of {count} runs failed and count for nothing: {named}", DrumrsWarning, stacklevel=4
    )
