"""What can go wrong, as four exceptions and two warnings; each makes its message of its fields.

The core raises the same classes, by importing this module: so every error pickles, whichever side it comes from.
"""

from pathlib import Path
from typing import Any, overload

_LONGEST_VALUE = 60


class DrumrsError(Exception):
    """Base of every error that drumrs raises on purpose."""


class ConfigError(DrumrsError, ValueError):
    """A key, a value or a combination of them that no simulation can have.

    The message is "KEY is VALUE, but must be LIMIT; HINT", or "KEY PROBLEM; HINT".

    Parameters
    ----------
    key
        What is refused, as a user writes it: a dotted key, an argument, an option, or the path of a file.
    value
        What was found; words for it, or `None`, where it is no single value.
    limit
        What would have been accepted, in words.
    hint
        What to do instead, where there is more to say than the limit.
    problem
        What is wrong, where it is not that the value is beyond the limit.
    bound
        The limit as a number, where it is a single one.

    Attributes
    ----------
    key, value, limit, hint, problem, bound
        The same.

    Examples
    --------
    >>> import drumrs
    >>> try:
    ...     drumrs.baseline(fill=-0.1)
    ... except drumrs.ConfigError as error:
    ...     print(error)
    ...     print(error.key, error.value)
    load.fill is -0.1, but must be a positive finite number
    load.fill -0.1
    """

    @overload
    def __init__(
        self, key: str | Path, value: Any, limit: str, *, hint: str = ..., bound: float | None = ...
    ) -> None: ...

    @overload
    def __init__(
        self,
        key: str | Path,
        value: Any = ...,
        limit: str = ...,
        *,
        hint: str = ...,
        problem: str,
        bound: float | None = ...,
    ) -> None: ...

    def __init__(
        self,
        key: str | Path,
        value: Any = None,
        limit: str = "",
        *,
        hint: str = "",
        problem: str = "",
        bound: float | None = None,
    ) -> None:
        super().__init__(key)
        self.key = str(key)
        self.value = value
        self.limit = limit
        self.hint = hint
        self.problem = problem or f"is {format_value(value)}, but must be {limit}"
        self.bound = bound
        self._is_path = isinstance(key, Path)

    def __str__(self) -> str:
        """Make the message of the fields."""
        return _with_hint(f"{repr(self.key) if self._is_path else self.key} {self.problem}", self.hint)


class UnstableError(DrumrsError, RuntimeError):
    """The simulation left the range in which the model means anything.

    Parameters
    ----------
    problem
        What happened, with bundle, step, time and place.
    hint
        What to do against it.
    bundle, step, time, position, speed
        Which bundle, and at which step, at what time [s], where [m] and how fast [m/s] it was seen.
    value, limit
        What went beyond which limit, where it is a number: an overlap over the radius, or a displacement in a step [m].

    Attributes
    ----------
    problem, hint, bundle, step, time, position, speed, value, limit
        The same.
    """

    def __init__(  # noqa: PLR0913 - its fields
        self,
        problem: str,
        hint: str = "",
        *,
        bundle: int | None = None,
        step: int | None = None,
        time: float | None = None,
        position: tuple[float, float] | None = None,
        speed: float | None = None,
        value: float | None = None,
        limit: float | None = None,
    ) -> None:
        super().__init__(problem)
        self.problem = problem
        self.hint = hint
        self.bundle = bundle
        self.step = step
        self.time = time
        self.position = position
        self.speed = speed
        self.value = value
        self.limit = limit

    def __str__(self) -> str:
        """Make the message of the fields."""
        return _with_hint(self.problem, self.hint)


class CheckpointError(DrumrsError, ValueError):
    """A checkpoint that is truncated, damaged or of another version.

    Parameters
    ----------
    reason
        Why it cannot be used.
    path
        The file, where it is known.
    hint
        What to do instead.

    Attributes
    ----------
    reason, path, hint
        The same.
    """

    def __init__(self, reason: str, path: str | None = None, hint: str = "") -> None:
        super().__init__(reason)
        self.reason = reason
        self.path = path
        self.hint = hint

    def __str__(self) -> str:
        """Make the message of the fields."""
        which = "this checkpoint" if self.path is None else f"the checkpoint {self.path!r}"
        return _with_hint(f"cannot use {which}: {self.reason}", self.hint)


class DrumrsWarning(UserWarning):
    """Something that a configuration does and that its author may not expect; said at the start, with ways out."""


class PictureWarning(DrumrsWarning):
    """A picture, a player or a plot of a page that could not be made; names it, and why. The numbers are complete."""


def missing_package(what: str, error: ModuleNotFoundError, extra: str) -> ConfigError:
    """Return the error that something cannot be done without a package, with the extra of drumrs that brings it."""
    problem = f"needs the package {error.name}, which is not installed"
    return ConfigError(what, problem=problem, hint=f"install it with: pip install 'drumrs[{extra}]'")


def format_value(value: object) -> str:
    """Show a value on one line, shortened where it is long, but for paths."""
    if isinstance(value, Path):
        return repr(str(value))
    try:
        text = repr(list(value) if isinstance(value, tuple) else value).replace("\n", " ")
    except (RecursionError, ValueError):
        # Nested a thousand deep, or an integer of thousands of digits.
        return f"a {type(value).__name__} too large to be shown"
    return text if len(text) <= _LONGEST_VALUE else f"{text[: _LONGEST_VALUE - 1]}…"


def _with_hint(message: str, hint: str) -> str:
    return f"{message}; {hint}" if hint else message
