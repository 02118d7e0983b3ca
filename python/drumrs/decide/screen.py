"""`screen`: which keys of a machine matter, by Morris's effects first and Sobol's indices of what they leave."""

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.analysis import Interval
from drumrs.analysis.blocks import Array
from drumrs.config import Config
from drumrs.decide.evaluate import Evaluator
from drumrs.decide.file import DecisionFile, listed, whole
from drumrs.decide.sensitivity import Effect, Indices, morris, noise_of, saltelli, sobol, trajectories
from drumrs.decide.space import Space
from drumrs.decide.targets import Target
from drumrs.errors import ConfigError
from drumrs.folders import claim, require_own
from drumrs.pictures import attempt
from drumrs.sweep import Case
from drumrs.tables import write_table

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure

KIND, FILES = "screen", ("table.parquet", "runs")
_KEYS = ("targets", "trajectories", "points")
# A screening is where many keys are looked at for the first time.
_MOST_KEYS = 30
_TRAJECTORIES, _FEWEST_TRAJECTORIES = 10, 4
_POINTS, _MOST_POINTS = 64, 2**14
# Points of Sobol's design that are run with another seed as well, to know the noise.
_AGAIN = 16
# Seeds of runs, from that of the base on: of trajectories, of their starts again, of Sobol's points, of those again.
_FIRST_SEEDS = (0, 1_000_000, 2_000_000, 3_000_000)
_PERCENT = 100.0


@dataclass(frozen=True)
class ScreeningPlan:
    """What is to be screened.

    Attributes
    ----------
    base
        What all runs share.
    space
        The keys, with their ranges or choices.
    targets
        What they are to be screened for.
    trajectories
        How often each key is changed on its own, by Morris.
    points
        Points of each of Sobol's columns, a power of 2; 0 leaves it at Morris.

    Examples
    --------
    >>> from drumrs.decide import ScreeningPlan
    >>> ranges = {"rotation.rpm": [30, 60], "load.fill": [0.2, 0.4]}
    >>> plan = ScreeningPlan.read({"ranges": ranges, "screen": {"targets": ["drum_specific_power"]}})
    >>> plan.first_runs, plan.most_runs
    (40, 312)
    """

    base: Config
    space: Space
    targets: tuple[Target, ...]
    trajectories: int = _TRAJECTORIES
    points: int = _POINTS

    @classmethod
    def read(
        cls,
        source: "str | Path | Mapping[str, Any]",
        targets: Sequence[str | Target] = (),
        *,
        trajectories: int | None = None,
        points: int | None = None,
    ) -> "ScreeningPlan":
        """Read what is to be screened.

        Parameters
        ----------
        source
            TOML file with the tables ``[base]``, as a sweep file has it, ``[ranges]`` with ``key = [low, high]``,
            ``[axes]`` with choices, and ``[screen]`` with ``targets``, ``trajectories`` and ``points``; or a mapping
            of the same form, whose ``base`` may be a `Config`.
        targets, trajectories, points
            In place of those of the file.

        Raises
        ------
        ConfigError
            Where the file cannot be read, or a key or value is not accepted.
        """
        file = DecisionFile.read(source, "screen")
        space, wanted = file.space(_MOST_KEYS), file.options(*_KEYS)
        named = list(targets) or listed(wanted, "targets", ("drum_specific_power",))
        count = wanted.get("trajectories", _TRAJECTORIES) if trajectories is None else trajectories
        whole(count, "screen.trajectories", _FEWEST_TRAJECTORIES)
        columns = wanted.get("points", _POINTS) if points is None else points
        whole(columns, "screen.points", 0, _MOST_POINTS)
        if columns & (columns - 1) or columns == 1:
            raise ConfigError("screen.points", columns, "0 or a power of 2 from 2 on: Sobol's design is one")
        return cls(file.base, space, tuple(map(Target.parse, named)), count, columns)

    @property
    def first_runs(self) -> int:
        """Runs of Morris's design."""
        return self.trajectories * (len(self.space) + 2)

    @property
    def most_runs(self) -> int:
        """Runs in all, where no key is dead."""
        further = self.points * (len(self.space) + 2) + min(self.points, _AGAIN)
        return self.first_runs + (further if self.points else 0)

    @property
    def cost(self) -> float:
        """Particle-steps of all runs, by those of a few points."""
        some = [config for point in self.space.spread(8) if (config := self.space.config(self.base, point))]
        return self.most_runs * float(np.mean([Case(config).cost for config in some or [self.base]]))


@dataclass(frozen=True)
class Factor:
    """What a key does to a target.

    Attributes
    ----------
    key
        The key.
    effect
        Its effect by Morris: change of the target over the range of the key.
    first, total
        Share of the spread of the target that it explains by itself, and with all that it does together with others,
        by Sobol; `None` where it was found dead, or only Morris was asked for.
    """

    key: str
    effect: Effect
    first: Interval | None = None
    total: Interval | None = None


@dataclass(frozen=True)
class Screening:
    """Which keys matter for a target.

    Attributes
    ----------
    target
        What they were screened for.
    factors
        What each key does, those that matter most first.
    noise
        Standard deviation of single runs of the same configuration.
    chance
        Share of noise in the spread of single runs over the design, with its interval; `None` without Sobol.
    """

    target: Target
    factors: tuple[Factor, ...]
    noise: float
    chance: Interval | None = None

    @property
    def sentences(self) -> tuple[str, ...]:
        """What came out, in a sentence for each key, and one on chance."""
        told = [_sentence(factor, self.target) for factor in self.factors]
        if self.chance is not None:
            told.append(f"{_share(self.chance)} of the spread of single runs is chance.")
        return tuple(told)

    def table(self) -> "pl.DataFrame":
        """Return a row for each key.

        Columns: ``key``; by Morris ``effect`` with its sign, ``effect_size`` μ*, ``effect_scatter``, ``noise_floor`` of
        μ* and whether it is ``dead``; by Sobol ``first`` and ``total`` with ``first_half_width`` and
        ``total_half_width`` of their intervals, null where there are none.
        """
        import polars as pl

        return pl.DataFrame(
            [
                {
                    "target": self.target.text,
                    "key": factor.key,
                    "effect": factor.effect.mean,
                    "effect_size": factor.effect.size,
                    "effect_scatter": factor.effect.scatter,
                    "noise_floor": factor.effect.floor,
                    "dead": factor.effect.is_dead,
                    **{
                        f"{name}{ending}": None if share is None else getattr(share, field)
                        for name, share in (("first", factor.first), ("total", factor.total))
                        for ending, field in (("", "mean"), ("_half_width", "half_width"))
                    },
                }
                for factor in self.factors
            ],
            infer_schema_length=None,
        )

    def figure(self) -> "Figure":
        """Draw bars with intervals: the indices, or Morris's effects where there are none."""
        from drumrs import figures

        if self.chance is None:
            effects = {factor.key: factor.effect for factor in self.factors}
            floor = self.factors[0].effect.floor
            rows = {key: (effect.size, effect.spread, effect.is_dead) for key, effect in effects.items()}
            return figures.effects(rows, floor, f"change of {self.target.label} over the range")
        shares = {factor.key: (factor.first, factor.total) for factor in self.factors}
        return figures.indices(shares, self.chance, f"share of the spread of {self.target.title}")


def screen(
    source: "str | Path | Mapping[str, Any] | ScreeningPlan",
    targets: Sequence[str | Target] = (),
    *,
    out: str | Path,
    executor: Executor | str | None = None,
    jobs: int | None = None,
    progress: bool = True,
) -> tuple[Screening, ...]:
    """Find out which keys of a machine matter.

    First each key is changed on its own along trajectories through the space (Morris); what cannot be told from the
    noise of single runs, for any target, is dead and left at the base's value. Then the spread of the target is shared
    out among the keys that are left (Sobol). Every run has a seed of its own, and some points are run twice, so that
    the noise is known and taken off. Nothing is simulated twice: the same call goes on after an interruption, and more
    trajectories or points add to those that are there.

    Parameters
    ----------
    source
        What `ScreeningPlan.read` reads, or a plan.
    targets
        What the keys are screened for, in place of the file's; texts that `Target.parse` reads, or targets.
    out
        Folder for the table, figures and runs.
    executor, jobs
        Who runs the cases, and how many at once, as for `drumrs.Sweep.run`.
    progress
        Whether to show progress.

    Returns
    -------
    tuple of Screening
        One for each target, with `sentences`, `table` and `figure`.

    Raises
    ------
    ConfigError
        Where an argument is not accepted, values in the ranges do not go together, or too few runs have a value.
    OSError
        Where results cannot be written; what is finished is kept.
    KeyboardInterrupt
        After Ctrl-C; what is finished is kept.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> base = drumrs.baseline(fill=0.05).replace({"run.duration": 0.05})
    >>> ranges = {"rotation.rpm": [20, 80], "contact.drum.friction": [0.3, 0.5]}
    >>> plan = {"base": base, "ranges": ranges, "screen": {"trajectories": 4, "points": 0}}
    >>> (found,) = drumrs.screen(plan, ["drum_power"], out=tempfile.mkdtemp(), progress=False)
    >>> sorted(factor.key for factor in found.factors)
    ['contact.drum.friction', 'rotation.rpm']
    """
    plan = (
        replace(source, targets=tuple(map(Target.parse, targets)) or source.targets)
        if isinstance(source, ScreeningPlan)
        else ScreeningPlan.read(source, targets)
    )
    folder = Path(out)
    require_own(folder, KIND, FILES)
    ask = Evaluator(plan.targets, folder / "runs", executor=executor, jobs=jobs, progress=progress)
    ask.case(plan.base)
    claim(folder, KIND, "a screening", "")
    run = _Runs(plan, ask)
    effects, noises = _effects(plan, run)
    live = [key for key in range(len(plan.space)) if not all(of_target[key].is_dead for of_target in effects)]
    shares = _shares(plan, run, live) if live and plan.points else [None] * len(plan.targets)
    of_targets = zip(plan.targets, effects, noises, shares, strict=True)
    found = tuple(_screening(plan.space.keys, live, *of_target) for of_target in of_targets)
    _write(found, folder)
    return found


class _Runs:
    """Runs at points, with seeds of their own; the values of all targets."""

    def __init__(self, plan: ScreeningPlan, ask: Evaluator) -> None:
        self._plan, self._ask = plan, ask

    def __call__(self, designs: Sequence[tuple[Array, Sequence[int]]]) -> list[Array]:
        """Return the values at the points of several designs, each with its seeds; shape (points, targets) each."""
        configs = [
            self._config(point, seed)
            for points, seeds in designs
            for point, seed in zip(points, seeds, strict=True)
        ]
        values = np.array([[mean.value for mean in means] for means in self._ask.means(configs)])
        ends = np.cumsum([len(points) for points, _ in designs])
        return np.split(values, ends[:-1])

    def _config(self, point: Array, seed: int) -> Config:
        base = self._plan.base
        values = {
            one.key: one.value(float(place))
            for one, place in zip(self._plan.space.parameters, point, strict=True)
            if np.isfinite(place)
        }
        try:
            return base.replace({**values, "run.seed": base.run.seed + seed})
        except ConfigError as error:
            told = ", ".join(f"{key} = {value}" for key, value in values.items())
            error.hint = f"narrow the ranges: this is at {told}"
            raise


def _effects(plan: ScreeningPlan, run: _Runs) -> tuple[list[list[Effect]], list[float]]:
    """Return the effects of all keys on each target, and the noise of each."""
    keys = len(plan.space)
    paths = trajectories(plan.trajectories, keys)
    points = plan.space.even(paths.reshape(-1, keys))
    starts = points[:: keys + 1]
    along, again = _FIRST_SEEDS[:2]
    values, others = run(
        [(points, range(along, along + len(points))), (starts, range(again, again + len(starts)))]
    )
    effects, noises = [], []
    for column in range(len(plan.targets)):
        of_paths = values[:, column].reshape(plan.trajectories, keys + 1)
        noises.append(noise_of(of_paths[:, 0], others[:, column]))
        effects.append(morris(paths, of_paths, noises[-1], plan.trajectories))
    return effects, noises


def _shares(plan: ScreeningPlan, run: _Runs, live: Sequence[int]) -> list[Indices | None]:
    """Return the indices of the keys that are live, for each target; the others stay at the base's value."""
    blocks = saltelli(plan.points, len(live))
    # Columns one after the other, so that a larger design begins with the smaller one.
    columns = blocks.swapaxes(0, 1).reshape(-1, len(live))
    points = np.full((len(columns), len(plan.space)), 0.5)
    points[:, live] = columns
    points = plan.space.even(points)
    dead = [key for key in range(len(plan.space)) if key not in live]
    points[:, dead] = np.nan
    starts = points[:: len(live) + 2][:_AGAIN]
    first, again = _FIRST_SEEDS[2:]
    values, others = run(
        [(points, range(first, first + len(points))), (starts, range(again, again + len(starts)))]
    )
    found: list[Indices | None] = []
    for column in range(len(plan.targets)):
        of_blocks = values[:, column].reshape(plan.points, len(live) + 2).T
        found.append(sobol(of_blocks, (of_blocks[0, : len(starts)], others[:, column])))
    return found


def _screening(
    keys: Sequence[str],
    live: Sequence[int],
    target: Target,
    effects: Sequence[Effect],
    noise: float,
    shares: Indices | None,
) -> Screening:
    factors = [Factor(key, effect) for key, effect in zip(keys, effects, strict=True)]
    if shares is not None:
        for place, first, total in zip(live, shares.first, shares.total, strict=True):
            factors[place] = replace(factors[place], first=first, total=total)
    factors.sort(key=_weight, reverse=True)
    return Screening(target, tuple(factors), noise, None if shares is None else shares.chance)


def _weight(factor: Factor) -> tuple[float, float]:
    """Return what factors are sorted by."""
    return -1.0 if factor.total is None else max(factor.total.mean, 0.0), factor.effect.size


def _write(found: Sequence[Screening], folder: Path) -> None:
    import polars as pl

    write_table(folder / "table.parquet", pl.concat([each.table() for each in found]), {})
    for number, each in enumerate(found, 1):
        path = folder / (f"screening_{number}.png" if found[1:] else "screening.png")
        with attempt(path):
            from drumrs import figures

            figures.write(each.figure(), path)


def _sentence(factor: Factor, target: Target) -> str:
    if factor.first is None or factor.total is None:
        effect = factor.effect
        if effect.is_dead:
            return f"{factor.key} makes no difference to {target.title} that can be told from noise."
        unit = "" if target.unit == "1" else f" {target.unit}"
        return (
            f"{factor.key} changes {target.title} by {effect.mean:+.3g}{unit} over its range, {effect.size:.3g} "
            f"without the sign, of which noise makes {effect.floor:.2g}."
        )
    return (
        f"{factor.key} explains {_share(factor.first)} of the spread of {target.title} by itself, "
        f"{_share(factor.total)} with all that it does together with others."
    )


def _share(share: Interval) -> str:
    """Say a share with its interval; what is below 0 or above 1 by chance is that."""
    low, high = (_PERCENT * min(max(end, 0.0), 1.0) for end in (share.low, share.high))
    return f"{_PERCENT * min(max(share.mean, 0.0), 1.0):.0f} % ({low:.0f}–{high:.0f} %)"
