"""`compare`: which of a few machines is best, by runs and seeds that are spent where they help."""

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.analysis import Estimate, Interval
from drumrs.analysis.estimate import LEVEL
from drumrs.decide.difference import Difference, with_unit
from drumrs.decide.evaluate import Evaluator
from drumrs.decide.selection import Selection, Standing, Wanted, require_enough, select
from drumrs.decide.targets import Target
from drumrs.errors import ConfigError
from drumrs.folders import claim, require_own
from drumrs.pictures import attempt
from drumrs.progress import Task
from drumrs.tables import write_table

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure

    from drumrs.config import Config

KIND, FILES = "compare", ("table.parquet", "differences.png", "runs")
# Runs, unless more are allowed.
MOST_RUNS = 200
_FEWEST_DESIGNS, _LETTERS = 2, 26
_PERCENT = 100.0


@dataclass(frozen=True)
class Design:
    """One of the designs compared.

    Attributes
    ----------
    name
        Its name.
    standing
        "best", "worse" for sure, "equal" within the difference, or "open" where the runs did not settle it.
    estimate
        Mean of the target over its seeds, with its error.
    behind
        By how much it is behind the best one: with 95 % the intervals of all designs hold together.
    is_paired
        Whether that is of differences seed by seed, since seeds turned out to be correlated.
    seeds
        How many seeds were run.
    """

    name: str
    standing: Standing
    estimate: Estimate
    behind: Interval
    is_paired: bool
    seeds: int


@dataclass(frozen=True)
class Comparison:
    """Which of a few designs is best.

    Attributes
    ----------
    target
        What they are compared by.
    is_greatest
        Whether the greatest value is best, not the least.
    difference
        Difference below which they count as equal.
    designs
        How each stands, in the order in which they were given.
    """

    target: Target
    is_greatest: bool
    difference: Difference
    designs: tuple[Design, ...]

    @property
    def best(self) -> Design:
        """The design with the best mean."""
        return next(design for design in self.designs if design.standing == "best")

    @property
    def is_decided(self) -> bool:
        """Whether every other design is worse for sure, or equal within the difference."""
        return all(design.standing != "open" for design in self.designs)

    @property
    def sentence(self) -> str:
        """What came out, in one sentence."""
        best, target = self.best, self.target
        interval = best.estimate.interval()
        value = f"{interval.mean:.4g} ± {interval.half_width:.2g}"
        told = f"{target.title} {with_unit(value, target.unit)}"
        named = {
            standing: ", ".join(design.name for design in self.designs if design.standing == standing)
            for standing in ("worse", "equal", "open")
        }
        difference = self.difference.text(best.estimate.mean, target.unit)
        if named["open"]:
            return (
                f"It is open whether {named['open']} or {best.name} is best ({told}): the runs allowed do not tell "
                f"differences of {difference}."
            )
        verb = "are" if sum(design.standing == "worse" for design in self.designs) > 1 else "is"
        worse = f"; {named['worse']} {verb} worse for sure" if named["worse"] else ""
        if named["equal"]:
            return (
                f"No difference above {difference} between {best.name} ({told}) and {named['equal']}{worse}."
            )
        least = min(design.behind.low for design in self.designs if design is not best)
        than = "higher" if self.is_greatest else "lower"
        by = with_unit(f"{least:.2g}", target.unit)
        share = f", {_PERCENT * least / abs(best.estimate.mean):.2g} %" if best.estimate.mean else ""
        return f"{best.name} is best ({told}): {than} than every other by {by}{share} at least, with 95 %."

    def table(self) -> "pl.DataFrame":
        """Return a row for each design.

        Columns: ``design``, ``standing``, ``seeds``, ``mean`` with ``error`` of the target, ``behind`` the best with
        the ends of its interval, ``behind_low`` and ``behind_high``, and whether it is ``paired``.
        """
        import polars as pl

        return pl.DataFrame(
            [
                {
                    "design": design.name,
                    "standing": design.standing,
                    "seeds": design.seeds,
                    "mean": design.estimate.mean,
                    "error": design.estimate.error,
                    "behind": design.behind.mean,
                    "behind_low": design.behind.low,
                    "behind_high": design.behind.high,
                    "paired": design.is_paired,
                }
                for design in self.designs
            ]
        )

    def figure(self) -> "Figure":
        """Draw how far each design is behind the best one, `drumrs.figures.differences`."""
        from drumrs import figures

        return figures.differences(
            {design.name: (design.behind, design.standing) for design in self.designs},
            self.difference.of(self.best.estimate.mean),
            f"{self.target.title} behind {self.best.name}"
            + ("" if self.target.unit == "1" else f" [{self.target.unit}]"),
        )


def compare(  # noqa: PLR0913 - what is compared by what, where, and by whom
    designs: "Mapping[str, Config] | Sequence[Config]",
    by: str | Target = "drum_specific_power",
    *,
    out: str | Path,
    greatest: bool = False,
    difference: str | float = "5 %",
    most: int = MOST_RUNS,
    executor: Executor | str | None = None,
    jobs: int | None = None,
    progress: bool = True,
) -> Comparison:
    """Find out which of a few machines is best: seeds are run until that is sure, or they are as good as equal.

    Each begins with four seeds. Further ones go where they settle most, until every other design is worse than the best
    one for sure, or within the difference of it for sure, all with 95 % together; see `drumrs.decide.selection.select`.
    Seeds are compared one by one only where their values turn out to be significantly positively correlated, which is
    rare: runs of different machines forget a common start. Nothing is simulated twice, so that the same call goes on
    after an interruption, or with more runs.

    Parameters
    ----------
    designs
        The configurations, by name or in a list; seeds are counted from the ``run.seed`` of each.
    by
        What they are compared by: a text that `Target.parse` reads, or a target.
    out
        Folder for the table, the figure and the runs.
    greatest
        Whether the greatest value is best; the least unless given.
    difference
        Difference below which they count as equal: ``"5 %"`` of the best one's mean, or an amount such as
        ``"0.2 W/kg"``.
    most
        Runs at most, of all designs together.
    executor, jobs
        Who runs the cases, and how many at once, as for `drumrs.Sweep.run`.
    progress
        Whether to show progress.

    Returns
    -------
    Comparison
        How each design stands, with `sentence`, `table` and `figure`.

    Raises
    ------
    ConfigError
        Where an argument is not accepted, or a design has no value.
    OSError
        Where results cannot be written; what is finished is kept.
    KeyboardInterrupt
        After Ctrl-C; what is finished is kept.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> base = drumrs.baseline(fill=0.1).replace({"run.duration": 0.1})
    >>> slow, fast = (base.replace({"rotation.rpm": rpm}) for rpm in (20.0, 60.0))
    >>> found = drumrs.compare({"slow": slow, "fast": fast}, "drum_power", out=tempfile.mkdtemp(), progress=False)
    >>> found.best.name, found.is_decided
    ('slow', True)
    """
    configs = _named(designs)
    target = Target.parse(by)
    within = Difference.parse(difference, target.unit)
    folder = Path(out)
    require_own(folder, KIND, FILES)
    require_enough(most, len(configs))
    ask = Evaluator([target], folder / "runs", executor=executor, jobs=jobs, progress=progress)
    for config in configs.values():
        ask.case(config)
    claim(folder, KIND, "designs", "")
    sampler = _Sampler(tuple(configs.values()), ask, -1.0 if greatest else 1.0)
    with Task("comparison", 0, show=progress) as task:

        def tell(found: Selection, runs: int) -> None:
            names = list(configs)
            open_ = [
                name for name, rival in zip(names, found.rivals, strict=True) if rival.standing == "open"
            ]
            left = f", open is {', '.join(open_)}" if open_ else ""
            task.note(f"{runs} runs: {names[found.best]} is ahead{left}")

        found = select(sampler, list(configs), within.of, most=most, level=LEVEL, on_look=tell)
    comparison = Comparison(target, greatest, within, sampler.designs(list(configs), found))
    write_table(folder / "table.parquet", comparison.table(), {"target": target.text, "unit": target.unit})
    with attempt(folder / "differences.png"):
        from drumrs import figures

        figures.write(comparison.figure(), folder / "differences.png")
    return comparison


class _Sampler:
    """Runs of designs, as `select` asks for them: the less the better."""

    def __init__(self, configs: "Sequence[Config]", ask: Evaluator, sign: float) -> None:
        self._configs, self._ask, self._sign = configs, ask, sign
        self._seeds = [0] * len(configs)

    def __call__(self, wanted: Wanted) -> list[float]:
        runs = []
        for k, seed in wanted:
            self._seeds[k] = max(self._seeds[k], seed + 1)
            runs.append(self._configs[k].replace({"run.seed": self._configs[k].run.seed + seed}))
        return [self._sign * mean.value for (mean,) in self._ask.means(runs)]

    def designs(self, names: Sequence[str], found: Selection) -> tuple[Design, ...]:
        """Return how the designs stand, with their own values."""
        return tuple(
            Design(
                name,
                rival.standing,
                replace(estimate, mean=self._sign * estimate.mean),
                rival.behind,
                rival.is_paired,
                seeds,
            )
            for name, rival, estimate, seeds in zip(
                names, found.rivals, found.estimates, self._seeds, strict=True
            )
        )


def _named(designs: "Mapping[str, Config] | Sequence[Config]") -> "dict[str, Config]":
    """Return designs by name; those of a list are called by letters."""
    letters = (chr(ord("A") + k) if k < _LETTERS else f"design {k + 1}" for k in count())
    named = dict(designs) if isinstance(designs, Mapping) else dict(zip(letters, designs, strict=False))
    if len(named) < _FEWEST_DESIGNS:
        raise ConfigError("designs", len(named), f"at least {_FEWEST_DESIGNS} configurations")
    for name, config in named.items():
        twin = next(
            (other for other in named if other != name and named[other].digest == config.digest), None
        )
        if twin is not None:
            problem = f"is the same configuration as {twin}, but must be another"
            raise ConfigError(f"the design {name}", problem=problem)
    return named
