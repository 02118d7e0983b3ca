"""What several commands take: settings, seeds, threads, folders."""

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter, Token

import drumrs
from drumrs.config import Config, merge, nest, parse_settings, read_layer
from drumrs.errors import ConfigError

Settings = Annotated[
    list[str] | None,
    Parameter(
        name="--set",
        negative="",
        help="KEY=VALUE, in place of the file's value; may be repeated. VALUE is as in TOML; a bare word is a string.",
    ),
]


def _whole(_: object, tokens: Sequence[Token]) -> int:
    """Read a whole number, also one that is written as 1e3; anything else would be rounded in silence."""
    text = tokens[0].value
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not number.is_integer():
        raise ValueError(f"{text} is not a whole number")
    return int(text) if text.lstrip("+-").isdigit() else int(number)


def _number(_: object, tokens: Sequence[Token]) -> float:
    """Read a number, also one that is written as 1%, as in --set."""
    text = tokens[0].value
    number = parse_settings([f"number={text}"])["number"]
    if isinstance(number, bool) or not isinstance(number, (int, float)):
        raise ValueError(f"{text} is not a number")  # noqa: TRY004 - the exception that becomes a message
    return float(number)


def _path(_: object, tokens: Sequence[Token]) -> Path:
    """Read a path; an empty one, as of a variable that is not set in the shell, would be the current folder."""
    if not tokens[0].value:
        raise ValueError("the path is empty; the current folder is '.'")
    return Path(tokens[0].value)


# The types of options that are a number, a whole number, or a path.
NUMBER = Parameter(converter=_number)
WHOLE = Parameter(converter=_whole)
PATH = Parameter(converter=_path)
Seed = Annotated[int | None, WHOLE, Parameter(help="Seed of the random start, in place of run.seed.")]
Threads = Annotated[
    int, WHOLE, Parameter(help="Threads that share a step; the result is the same for any number.")
]
Jobs = Annotated[int | None, WHOLE, Parameter(help="Cases at once; one a usable core unless given.")]


def layered(case: Path | None, settings: Sequence[str] | None, seed: int | None) -> Config:
    """Return the baseline with the keys of a case file, then of settings, then the seed in place of its own."""
    if case is not None and str(case).endswith(("]", "}")) and not case.exists():
        raise cut_by_shell(str(case))
    upper = nest(parse_settings(settings or []))
    layers = [read_layer(case), upper] if case is not None else [upper]
    if seed is not None:
        layers.append({"run": {"seed": seed}})
    # Layers are merged before anything is validated: an upper one may mend what a lower one breaks.
    values = drumrs.baseline().model_dump(exclude_none=True)
    for layer in layers:
        values = merge(Config, values, layer)
    return Config.model_validate(values)


def cut_by_shell(words: str) -> ConfigError:
    """Return the error that the shell has cut words off a value, with how to keep them together."""
    hint = "a value with spaces needs quotes: --set 'KEY=[1, 2]'"
    return ConfigError(repr(words), words, problem="stands alone", hint=hint)


def check_folder(folder: Path, option: str = "--out") -> None:
    """Refuse a folder that cannot be written, before anything is simulated or created."""
    try:
        existing = next(path for path in (folder.absolute(), *folder.absolute().parents) if path.exists())
    except OSError as error:
        raise ConfigError(option, folder, f"a folder that can be written: {error.strerror}") from None
    if not existing.is_dir():
        raise ConfigError(option, folder, f"a folder: {str(existing)!r} is a file")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise ConfigError(option, folder, "a folder that can be written")
