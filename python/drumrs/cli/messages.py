"""What the command line says beside its results: on standard error, a sentence a line, and in a log file as JSON.

Both are handlers of the standard library's `logging`. The command line speaks as "drumrs.cli"; the log file has what
any part of drumrs says.
"""

import json
import logging
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.errors import ConfigError
from drumrs.progress import hidden

if TYPE_CHECKING:
    from collections.abc import Sequence

    from drumrs.sweep.scheduler import Failure

_ALL = logging.getLogger("drumrs")
_OWN = logging.getLogger("drumrs.cli")


def note(sentence: str) -> None:
    """Say something that one may want to know; `--quiet` keeps it to the log file."""
    _OWN.info(sentence)


def warn(sentence: str) -> None:
    """Say that something is not as it should be, or may not be as it was meant."""
    _OWN.warning(sentence)


def complain(sentence: str, error: BaseException | None = None) -> None:
    """Say why something failed; `--debug` shows where."""
    _OWN.error(sentence, exc_info=error)


def tell_failures(failures: "Sequence[Failure]", total: int, names: "Sequence[str]" = ()) -> None:
    """Say which cases failed, and why, by their titles unless names are given."""
    names = names or [failure.case.config.title for failure in failures]
    for failure, name in zip(failures, names, strict=True):
        complain(f"case {failure.case.id} ({name}) failed: {failure.message}")
    if failures:
        complain(f"{len(failures)} of {total} cases failed; --retry runs them again")


@contextmanager
def speaking(*, quiet: bool = False, debug: bool = False, log_file: Path | None = None) -> Iterator[None]:
    """Say within what is said: on standard error, and in a log file.

    Parameters
    ----------
    quiet
        Whether to leave out progress and notes on standard error.
    debug
        Whether to show where errors come from.
    log_file
        File to which lines of JSON are added.

    Raises
    ------
    ConfigError
        Where the log file cannot be written.
    """
    console: logging.Handler = _Console(logging.WARNING if quiet else logging.INFO)
    console.setFormatter(_Sentence(debug=debug))
    with ExitStack() as stack:
        _listen(stack, _OWN, console)
        if quiet:
            stack.enter_context(hidden())
        if log_file is not None:
            try:
                file: logging.Handler = logging.FileHandler(log_file, encoding="utf-8")
            except OSError as error:
                limit = f"a file that can be written: {error.strerror or error}"
                raise ConfigError("--log-file", log_file, limit) from None
            file.setFormatter(_Json())
            stack.callback(file.close)
            _listen(stack, _ALL, file)
        yield


def _listen(stack: ExitStack, logger: logging.Logger, handler: logging.Handler) -> None:
    level = logger.level
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    stack.callback(logger.setLevel, level)
    stack.callback(logger.removeHandler, handler)


class _Console(logging.Handler):
    """Writes to standard error as it is at the time."""

    def emit(self, record: logging.LogRecord) -> None:
        sys.stderr.write(f"{self.format(record)}\n")
        sys.stderr.flush()


class _Sentence(logging.Formatter):
    def __init__(self, *, debug: bool) -> None:
        super().__init__()
        self._debug = debug

    def format(self, record: logging.LogRecord) -> str:
        sentence = f"drumrs: {record.getMessage()}"
        shown = record.exc_info if self._debug else None
        return f"{self.formatException(shown)}\n{sentence}" if shown and shown[0] else sentence


class _Json(logging.Formatter):
    """Makes a line of a record: time, level, who says it, what, and what was given as `extra={"fields": …}`."""

    def format(self, record: logging.LogRecord) -> str:
        said = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
            **getattr(record, "fields", {}),
        }
        if record.exc_info and record.exc_info[0]:
            said["traceback"] = self.formatException(record.exc_info)
        return json.dumps(said, ensure_ascii=False, default=str)
