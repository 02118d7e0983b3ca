"""`Problem`: what is to be optimized, as a file or a mapping says it: keys that vary, goals, when to stop."""

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from drumrs.analysis import Mean
from drumrs.config import Config, anchored, read_layer
from drumrs.config.layers import flat
from drumrs.decide.compare import Difference
from drumrs.decide.space import Space
from drumrs.decide.targets import Target
from drumrs.errors import ConfigError
from drumrs.sweep.sweep_file import read_base, table_of

_WHAT = "an optimization"
_TABLES = ("base", "ranges", "axes", "optimize")
_KEYS = ("minimize", "maximize", "subject_to", "tolerance", "runs", "batch", "confirm")
_CONSTRAINT = re.compile(r"(?P<target>.+?)\s*(?P<sign>[<>]=?)\s*(?P<limit>[-+.\deE]+)\s*(?P<unit>.*)")
_MOST_OBJECTIVES = 2
_MOST_RUNS = 1000
# Runs for each key that varies, unless the file says how many.
_RUNS_PER_KEY = 20


@dataclass(frozen=True)
class Goal:
    """A target that is to be small or large, or at most or at least a limit.

    Attributes
    ----------
    target
        What is measured.
    sign
        1 where less is better, -1 where more is.
    limit
        Of a constraint, in the unit of the target; `None` of an objective.
    """

    target: Target
    sign: float
    limit: float | None = None

    @classmethod
    def constraint(cls, text: Any) -> "Goal":
        """Read a constraint: a target, <= or >=, a number, and its unit where one wants it checked.

        Raises
        ------
        ConfigError
            Where the text is none, or the unit is not that of the target.
        """
        found = _CONSTRAINT.fullmatch(text.strip()) if isinstance(text, str) else None
        limit = _number(found["limit"]) if found else None
        if found is None or limit is None:
            raise ConfigError(
                "optimize.subject_to", text, "a target, <= or >=, and a number: 'falls_per_turn >= 0.5'"
            )
        target = Target.parse(found["target"])
        if found["unit"] and found["unit"] != target.unit:
            raise ConfigError("optimize.subject_to", text, f"in the unit of {target}, {target.unit}")
        return cls(target, 1.0 if found["sign"].startswith("<") else -1.0, limit)

    def __str__(self) -> str:
        """Return it as one writes it."""
        if self.limit is None:
            return f"{'least' if self.sign > 0.0 else 'greatest'} {self.target.title}"
        return f"{self.target} {'<=' if self.sign > 0.0 else '>='} {self.limit:g}"

    def signed(self, value: float) -> float:
        """Return what is to be minimized, or to be at most 0 of a constraint."""
        return self.sign * (value - (self.limit or 0.0))

    def unsigned(self, value: float) -> float:
        """Return the target's own value."""
        return self.sign * value + (self.limit or 0.0)

    def signed_mean(self, mean: Mean) -> tuple[float, float]:
        """Return signed value and error; not a number where there is none."""
        return self.signed(mean.value), float("nan") if mean.error is None else mean.error


@dataclass(frozen=True)
class Problem:
    """What is to be optimized.

    Attributes
    ----------
    base
        What all runs share.
    space
        The keys that vary.
    objectives, constraints
        The goals.
    tolerance
        Gain that is not worth another run; of two objectives a share of the hypervolume.
    runs
        Runs at most.
    batch
        Runs that are planned together; 0 for as many as run at once.
    confirm
        Fresh seeds for what is best.
    """

    base: Config
    space: Space
    objectives: tuple[Goal, ...]
    constraints: tuple[Goal, ...]
    tolerance: Difference
    runs: int
    batch: int
    confirm: int

    @classmethod
    def read(cls, source: "str | Path | Mapping[str, Any]") -> "Problem":
        """Read a problem.

        Parameters
        ----------
        source
            TOML file with the tables ``[base]``, ``[ranges]``, ``[axes]`` and ``[optimize]``, or a mapping of the same
            form, whose ``base`` may be a `Config`.

        Raises
        ------
        ConfigError
            Where the file cannot be read, or a key or value is not accepted.

        Examples
        --------
        >>> from drumrs.decide.problem import Problem
        >>> goal = {"minimize": "drum_specific_power", "subject_to": "dissipation_ratio >= 1.2"}
        >>> problem = Problem.read({"ranges": {"rotation.rpm": [30, 60]}, "optimize": goal})
        >>> str(problem.objectives[0]), str(problem.constraints[0]), problem.runs
        ('least drum specific power', 'dissipation_ratio >= 1.2', 20)
        """
        base, content, folder = read_file(source, _TABLES, _WHAT)
        tables = {key: table_of(content, key) or {} for key in _TABLES[1:]}
        ranges, axes = (flat(anchored(tables[key], folder)) for key in ("ranges", "axes"))
        space, wanted = Space.read(ranges, axes), tables["optimize"]
        space.check(base)
        refuse_unknown(wanted, _KEYS, "optimize.", _WHAT)
        objectives = [
            Goal(Target.parse(text), sign)
            for key, sign in (("minimize", 1.0), ("maximize", -1.0))
            for text in _texts(wanted, key)
        ]
        if not 1 <= len(objectives) <= _MOST_OBJECTIVES:
            limit = "one or two targets in optimize.minimize and optimize.maximize together"
            raise ConfigError("optimize", [str(goal) for goal in objectives], limit)
        if len({goal.target for goal in objectives}) < len(objectives):
            raise ConfigError("optimize", problem=f"has {objectives[0].target} as both of its targets")
        tolerance = share(wanted.get("tolerance", "1 %"), objectives[0].target.unit, "optimize.tolerance")
        if len(objectives) > 1 and not tolerance.is_relative:
            limit = "a share such as '1 %' where there are two objectives: of the hypervolume of their front"
            raise ConfigError("optimize.tolerance", wanted["tolerance"], limit)
        return cls(
            base,
            space,
            tuple(objectives),
            tuple(Goal.constraint(text) for text in _texts(wanted, "subject_to")),
            tolerance,
            whole(wanted, "runs", "optimize", _RUNS_PER_KEY * len(space), 2 * len(space) + 2),
            whole(wanted, "batch", "optimize", 0, 0),
            whole(wanted, "confirm", "optimize", 4, 2),
        )

    @property
    def goals(self) -> tuple[Goal, ...]:
        """Objectives, then constraints."""
        return (*self.objectives, *self.constraints)

    @property
    def digest(self) -> str:
        """What tells searches apart that go other ways: all but when to stop and how to confirm."""
        words = repr((self.base.digest, self.space, [(str(goal), goal.target.text) for goal in self.goals]))
        return hashlib.sha256(words.encode()).hexdigest()[:20]


def read_file(
    source: "str | Path | Mapping[str, Any]", known: tuple[str, ...], what: str
) -> tuple[Config, Mapping[str, Any], Path]:
    """Read the file of a decision, or a mapping of the same form, whose ``base`` may be a `Config`.

    Returns
    -------
    tuple
        What all runs share; the content, whose tables are among the known ones; the folder to which paths are relative.

    Raises
    ------
    ConfigError
        Where the file cannot be read, or a table or a key of ``[base]`` is not accepted.
    """
    content, folder = (
        (source, Path()) if isinstance(source, Mapping) else (read_layer(source), Path(source).parent)
    )
    refuse_unknown(content, known, "", what)
    base = content.get("base")
    return base if isinstance(base, Config) else read_base(content, folder), content, folder


def refuse_unknown(table: Mapping[str, Any], known: tuple[str, ...], at: str, what: str) -> None:
    """Refuse keys that a table cannot have.

    Raises
    ------
    ConfigError
        Where there is one; the sentence lists the keys there are.
    """
    for key in table:
        if key not in known:
            hint = (
                "each run has a seed of its own"
                if key == "seeds"
                else f"the keys there are {', '.join(known)}"
            )
            raise ConfigError(f"{at}{key}", table[key], problem=f"is not a key of {what}", hint=hint)


def whole(table: Mapping[str, Any], key: str, at: str, default: int, least: int) -> int:
    """Read a whole number.

    Raises
    ------
    ConfigError
        Where it is none, or out of its limits.
    """
    value = table.get(key, default)
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= _MOST_RUNS:
        raise ConfigError(f"{at}.{key}", value, f"a whole number from {least} to {_MOST_RUNS}", bound=least)
    return value


def share(value: Any, unit: str, key: str) -> Difference:
    """Read a percentage, or a number in a unit.

    Raises
    ------
    ConfigError
        Where it is neither.
    """
    try:
        return Difference.parse(value, unit)
    except ConfigError as error:
        error.key = key
        raise


def _texts(table: Mapping[str, Any], key: str) -> list[Any]:
    value = table.get(key, [])
    return list(value) if isinstance(value, (list, tuple)) else [value]


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
