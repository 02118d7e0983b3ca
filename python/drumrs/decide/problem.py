"""`Problem`: what is to be optimized, as a file or a mapping says it: keys that vary, goals, when to stop."""

import hashlib
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from drumrs.analysis import Mean
from drumrs.config import Config
from drumrs.decide.difference import Difference
from drumrs.decide.file import DecisionFile, listed, share, whole
from drumrs.decide.space import Space
from drumrs.decide.targets import Target
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

_KEYS = ("minimize", "maximize", "subject_to", "tolerance", "runs", "batch", "confirm")
_CONSTRAINT = re.compile(r"(?P<target>.+?)\s*(?P<sign>[<>]=?)\s*(?P<limit>[-+.\deE]+)\s*(?P<unit>.*)")
_MOST_OBJECTIVES = 2
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
        file = DecisionFile.read(source, "optimize")
        space, wanted = file.space(), file.options(*_KEYS)
        objectives = [
            Goal(Target.parse(text), sign)
            for key, sign in (("minimize", 1.0), ("maximize", -1.0))
            for text in listed(wanted, key)
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
            file.base,
            space,
            tuple(objectives),
            tuple(Goal.constraint(text) for text in listed(wanted, "subject_to")),
            tolerance,
            whole(wanted.get("runs", _RUNS_PER_KEY * len(space)), "optimize.runs", 2 * len(space) + 2),
            whole(wanted.get("batch", 0), "optimize.batch", 0),
            whole(wanted.get("confirm", 4), "optimize.confirm", 2),
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


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
