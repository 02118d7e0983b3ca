"""`Experiment`: what was measured and may be fitted, as a file or a mapping says it: parameters, data, candidates."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.config import Config
from drumrs.config.layers import flat
from drumrs.decide.emulator import Array
from drumrs.decide.file import DecisionFile, share, whole
from drumrs.decide.posterior import fewest_runs
from drumrs.decide.space import Space
from drumrs.decide.targets import Target
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from pathlib import Path

_KEYS = ("runs", "discrepancy")
_MOST_PARAMETERS = 5
_RUNS_PER_PARAMETER = 12


@dataclass(frozen=True)
class Measurement:
    """A number that was measured, or, as a candidate, may be.

    Attributes
    ----------
    target
        What it is of a run.
    value
        What was measured, in the unit of the target; `None` of a candidate.
    error
        Its standard error.
    settings
        Keys in which its drum differs from the base, such as the speed; as pairs, so that those of one drum are equal.
    """

    target: Target
    value: float | None
    error: float
    settings: tuple[tuple[str, Any], ...]

    def __str__(self) -> str:
        """Name the target, and the settings where there are some."""
        settings = ", ".join(f"{key} = {value}" for key, value in self.settings)
        return f"{self.target.title} at {settings}" if settings else self.target.title


@dataclass(frozen=True)
class Experiment:
    """What parameters are to be found from what was measured.

    Attributes
    ----------
    base
        What all runs share.
    space
        The parameters and their ranges, within which all values are equally likely beforehand.
    measured
        What was measured.
    candidates
        What may be measured next; where the file names none, what was measured, once more.
    runs
        Points of the space that are simulated, each once for every drum that differs.
    discrepancy
        Standard deviation of what the model is off by, as a share of each measured value.
    """

    base: Config
    space: Space
    measured: tuple[Measurement, ...]
    candidates: tuple[Measurement, ...]
    runs: int
    discrepancy: float

    @classmethod
    def read(cls, source: "str | Path | Mapping[str, Any]") -> "Experiment":
        """Read an experiment.

        Parameters
        ----------
        source
            TOML file with the tables ``[base]``, ``[ranges]``, ``[[measured]]``, ``[[candidate]]`` and
            ``[calibrate]``, or a mapping of the same form, whose ``base`` may be a `Config`.

        Raises
        ------
        ConfigError
            Where the file cannot be read, or a key or value is not accepted.

        Examples
        --------
        >>> from drumrs.decide.measurement import Experiment
        >>> power = {"target": "drum_specific_power", "value": 3.1, "error": 0.1, "set": {"rotation.rpm": 40}}
        >>> experiment = Experiment.read({"ranges": {"contact.bundle.friction": [0.1, 0.6]}, "measured": [power]})
        >>> str(experiment.measured[0]), experiment.runs
        ('drum specific power at rotation.rpm = 40', 12)
        """
        file = DecisionFile.read(source, "calibrate")
        space, wanted = file.space(_MOST_PARAMETERS), file.options(*_KEYS)
        default = _RUNS_PER_PARAMETER * len(space)
        runs = whole(wanted.get("runs", default), "calibrate.runs", fewest_runs(len(space)))
        discrepancy = share(wanted.get("discrepancy", "3 %"), "1", "calibrate.discrepancy")
        if not discrepancy.is_relative:
            raise ConfigError("calibrate.discrepancy", wanted["discrepancy"], "a share such as '3 %'")
        measured = _measurements(file, "measured")
        if not measured:
            raise ConfigError("measured", [], "one table [[measured]] at least: target, value, error, set")
        candidates = _measurements(file, "candidate") or measured
        return cls(file.base, space, measured, candidates, runs, discrepancy.amount)

    @property
    def numbers(self) -> tuple[Array, Array]:
        """What was measured, and its standard errors with the model's discrepancy in them."""
        values = np.array([one.value for one in self.measured], float)
        errors = np.hypot([one.error for one in self.measured], self.discrepancy * np.abs(values))
        return values, errors

    @property
    def drums(self) -> list[tuple[tuple[str, Any], ...]]:
        """The settings of all drums that differ, those of candidates last."""
        return list(dict.fromkeys(one.settings for one in (*self.measured, *self.candidates)))


def _measurements(file: DecisionFile, name: str) -> tuple[Measurement, ...]:
    tables = file.content.get(name, [])
    if not isinstance(tables, (list, tuple)) or not all(isinstance(table, Mapping) for table in tables):
        raise ConfigError(name, tables, f"tables [[{name}]]")
    return tuple(_measurement(file, table, f"{name}[{k}]") for k, table in enumerate(tables))


def _measurement(file: DecisionFile, table: Mapping[str, Any], at: str) -> Measurement:
    file.refuse_unknown(table, ("target", "value", "error", "set"), f"{at}.")
    target = Target.parse(table.get("target", ""))
    value = None if at.startswith("candidate") else _number(table, "value", at, target)
    error = _number(table, "error", at, target)
    if not error > 0.0:
        raise ConfigError(f"{at}.error", error, f"positive, the standard error in {target.unit}")
    settings = table.get("set", {})
    if not isinstance(settings, Mapping):
        raise ConfigError(f"{at}.set", settings, "a table of keys, such as { rotation.rpm = 30 }")
    dotted = flat(settings)
    file.base.replace(dotted)
    return Measurement(target, value, error, tuple(sorted(dotted.items())))


def _number(table: Mapping[str, Any], key: str, at: str, target: Target) -> float:
    value = table.get(key)
    unit = "a number" if target.unit == "1" else f"a number in {target.unit}"
    if value is None:
        raise ConfigError(f"{at}.{key}", problem=f"is missing, but must be {unit}")
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ConfigError(f"{at}.{key}", value, unit)
    return float(value)
