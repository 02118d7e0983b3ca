"""`Sweep`: the cases of a study, run once each and read back as tables."""

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from drumrs import notebook
from drumrs.config import Config
from drumrs.errors import ConfigError
from drumrs.frames import Frames
from drumrs.sweep import design, table
from drumrs.sweep.case import Case, short_ids
from drumrs.sweep.columns import differing, settings
from drumrs.sweep.plan import write_plan
from drumrs.sweep.scheduler import Outcome, RunOptions, run_cases
from drumrs.sweep.store import Store

if TYPE_CHECKING:
    import polars as pl

    from drumrs.analysis import Mean
    from drumrs.result import Result

# Values of an axis that a notebook shows.
_MOST_SHOWN = 8


class Sweep:
    """A design of many cases, and their results in a folder.

    Each case is named by its configuration, its seed and the version of the physics. What is finished is never
    simulated again: the same sweep, or another that shares cases with it, goes on where the folder stands. Of every
    case the series is kept, and the frames where ``run.frame_every`` is smaller than ``run.duration``.

    Parameters
    ----------
    base
        The configuration that the axes vary.
    axes
        Values by dotted key; every combination is a case.
    seeds
        Seeds with which every combination is run, or their number n for 0 … n − 1; the base's own unless given.

    Attributes
    ----------
    cases : tuple of Case
        The cases, in the order of the design.

    Raises
    ------
    ConfigError
        Where an axis names no key or is empty, a value is not accepted, or a case comes twice.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> base = drumrs.baseline().replace({"run.duration": 0.05})
    >>> sweep = drumrs.Sweep(base, axes={"load.fill": [0.05, 0.1]}, seeds=range(2))
    >>> outcome = sweep.run(tempfile.mkdtemp(), progress=False)
    >>> outcome.finished, outcome.failures
    (4, ())
    >>> sweep.table().select("load.fill", "seed", "bundle_count").collect().rows()
    [(0.05, 0, 20), (0.05, 1, 20), (0.1, 0, 40), (0.1, 1, 40)]
    """

    # The folder of the last `run`.
    _folder: Path | None = None

    def __init__(self, base: Config, axes: design.Axes | None = None, seeds: design.Seeds = None) -> None:
        self.cases = design.from_axes(base, axes, seeds)

    @classmethod
    def from_rows(cls, base: Config, frame: design.Rows, seeds: design.Seeds = None) -> Self:
        """Make a sweep of a table's rows: Latin hypercube, Sobol sequence, a list by hand.

        Parameters
        ----------
        base
            The configuration that the rows vary.
        frame
            Table of polars or pandas, dict of columns or list of dicts; its columns are dotted keys, and null leaves
            the base's value.
        seeds
            As of `Sweep`.

        Raises
        ------
        ConfigError
            Where a column names no key, a value is not accepted, there is no row, or a case comes twice.

        Examples
        --------
        >>> import drumrs, polars
        >>> rows = polars.DataFrame({"load.fill": [0.1, 0.3], "rotation.rpm": [30.0, None]})
        >>> [case.config.rotation.rpm for case in drumrs.Sweep.from_rows(drumrs.baseline(), rows).cases]
        [30.0, 54.0]
        """
        return cls._of(design.from_rows(base, frame, seeds))

    @classmethod
    def from_configs(cls, configs: Iterable[Config]) -> Self:
        """Make a sweep of configurations, seed inside; one that comes again is the same case.

        Raises
        ------
        ConfigError
            Where there is none.

        Examples
        --------
        >>> import drumrs
        >>> len(drumrs.Sweep.from_configs([drumrs.baseline(fill=0.1), drumrs.baseline(fill=0.2)]).cases)
        2
        """
        return cls._of(design.from_configs(configs))

    @classmethod
    def _of(cls, cases: tuple[Case, ...]) -> Self:
        sweep = cls.__new__(cls)
        sweep.cases = cases
        return sweep

    def __len__(self) -> int:
        """Return the number of cases."""
        return len(self.cases)

    def __repr__(self) -> str:
        """Say how many cases there are and what they cost."""
        cost = sum(case.cost for case in self.cases)
        return f"<Sweep of {len(self.cases)} cases, {cost:.2g} particle-steps>"

    def _repr_html_(self) -> str:
        """Show in a notebook how many cases there are, and by what they differ."""
        varied = self.settings().values()
        names = next(iter(varied))
        rows = {name: _listed(dict.fromkeys(str(case[name]) for case in varied)) for name in names}
        cost = f"{sum(case.cost for case in self.cases):.2g}"
        return notebook.table(f"sweep of {len(self)} cases", {**rows, "particle-steps": cost})

    def varied(self) -> list[str]:
        """Return the columns, among parameters and seed, in which the cases differ."""
        return differing(self.cases)

    def settings(self) -> dict[str, dict[str, Any]]:
        """Return what tells each case from the others, by its id: the values of `varied`."""
        varied = self.varied()
        values = ((case.id, settings(case)) for case in self.cases)
        return {case: {name: row[name] for name in varied} for case, row in values}

    def write_plan(self, folder: str | Path) -> None:
        """Write the list of the cases into a folder, which is made where there is none, and the file of each case.

        For workflow engines, which run the cases one by one: ``<id>.toml`` is a case file that is complete.

        Parameters
        ----------
        folder
            Where the results are going to be.

        Raises
        ------
        ConfigError
            Where the folder is not accepted.
        OSError
            Where the files cannot be written.
        """
        store = Store(folder)
        store.open()
        write_plan(store.folder, self.cases)
        for case in self.cases:
            store.write_config(case)

    def short_ids(self, folder: str | Path | None = None) -> dict[str, str]:
        """Return the beginning of each case's id by id, as long as tells it from all cases in the folder.

        `drumrs view FOLDER/ID` takes such a beginning.

        Parameters
        ----------
        folder
            Where the results are; that of the last `run` unless given.
        """
        return short_ids((case.id for case in self.cases), self._store(folder).ids())

    def run(
        self,
        folder: str | Path,
        executor: Executor | str | None = None,
        jobs: int | None = None,
        *,
        shard: tuple[int, int] | None = None,
        retry: bool = False,
        progress: bool = True,
    ) -> Outcome:
        """Run the cases that are not finished yet, long ones first, and keep the results of each at once.

        Parameters
        ----------
        folder
            Where the results are kept; made where there is none.
        executor
            Who runs them: "threads" (the default), "processes" (spawned), or any `concurrent.futures.Executor`, whose
            workers have to reach `folder` under the same name.
        jobs
            Cases at once; one a usable core unless given.
        shard
            Pair (k, n): run only the k-th of n equal parts, k from 1.
        retry
            Whether cases that failed before are run again.
        progress
            Whether to show progress, as a `drumrs.Task` does.

        Returns
        -------
        Outcome
            How many cases are finished, which failed and why. A failed case does not keep the others from running.

        Raises
        ------
        ConfigError
            Where an argument or the folder is not accepted.
        OSError
            Where results cannot be written; what is finished is kept.
        KeyboardInterrupt
            After Ctrl-C, within a second; what is finished is kept.
        """
        self._folder = Path(folder)
        return run_cases(self.cases, self._folder, RunOptions(executor, jobs, shard, retry, progress))

    def table(self, folder: str | Path | None = None) -> "pl.LazyFrame":
        """Scan the results: one row a finished case, sorted by parameters and seed.

        Columns: "case" (the id), the configuration by dotted key (null for "auto"), "seed", the numbers of
        `drumrs.Summary` but for timings (the center of mass as "center_of_mass_x" and "center_of_mass_y"), and those
        of `drumrs.analysis.statistics`: means with errors, and whether the window drifts.

        Parameters
        ----------
        folder
            Where the results are; that of the last `run` unless given.

        Raises
        ------
        ConfigError
            Where a file is damaged or another's; the sentence names it.
        """
        return table.scan(self.cases, self._store(folder))

    def measure(
        self,
        measure: "Callable[[Result], Mapping[str, Mean | float | str | None]]",
        folder: str | Path | None = None,
    ) -> "pl.DataFrame":
        """Return the table with a column for each number that a function measures, from the files: nothing is run.

        Parameters
        ----------
        measure
            Function from a finished case, as its run left it, to numbers by name, such as those of `drumrs.measures`.
            A `Mean` has a column for its error, too; `None` is null; words are a column of text.
        folder
            Where the results are; that of the last `run` unless given.

        Raises
        ------
        ConfigError
            Where a file is damaged or another's, or the function refuses a case: one without frames, say.

        Examples
        --------
        >>> import tempfile, drumrs
        >>> from drumrs import measures
        >>> base = drumrs.baseline(fill=0.1).replace({"run.duration": 0.2, "run.frame_every": 0.02})
        >>> sweep = drumrs.Sweep(base, axes={"rotation.rpm": [30.0, 60.0]})
        >>> outcome = sweep.run(tempfile.mkdtemp(), progress=False)
        >>> table = sweep.measure(lambda result: measures.charge(result.frames, result.config.run.averaging_window))
        >>> table.select("rotation.rpm", "arm").shape
        (2, 2)
        """
        return table.measured(self.cases, self._store(folder), measure)

    def write_table(self, folder: str | Path | None = None) -> Path:
        """Write the table as table.parquet into the folder, and return its path."""
        return table.write(self.cases, self._store(folder))

    def series(self, case: Case, folder: str | Path | None = None) -> "pl.DataFrame":
        """Return the series of a finished case."""
        return self._store(folder).series(case)

    def frames(self, case: Case, folder: str | Path | None = None) -> Frames:
        """Return the frames of a finished case; kept where ``run.frame_every`` is smaller than ``run.duration``."""
        return self._store(folder).frames(case)

    def facts(self, folder: str | Path | None = None) -> "pl.DataFrame":
        """Return time taken and machine of every finished case, in the order of `cases`."""
        return table.facts(self.cases, self._store(folder))

    def _store(self, folder: str | Path | None) -> Store:
        chosen = self._folder if folder is None else Path(folder)
        if chosen is None:
            raise ConfigError("folder", None, "given where the sweep has not been run")
        store = Store(chosen)
        store.check_format()
        return store


def _listed(values: Iterable[str]) -> str:
    """List different values, the first few where they are many."""
    words = list(values)
    more = f", … ({len(words)} values)" if len(words) > _MOST_SHOWN else ""
    return ", ".join(words[:_MOST_SHOWN]) + more
