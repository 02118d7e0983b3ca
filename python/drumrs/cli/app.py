"""The command `drumrs`: its list of commands, and what an error becomes."""

import errno
import io
import logging
import os
import platform
import shlex
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Any

from cyclopts import App, CycloptsError, Group, Parameter, UnknownOptionError, UnusedCliTokensError

import drumrs
from drumrs.cli.baseline import baseline
from drumrs.cli.calibrate import calibrate
from drumrs.cli.compare import compare
from drumrs.cli.config import config
from drumrs.cli.export import export
from drumrs.cli.info import info
from drumrs.cli.init import init
from drumrs.cli.messages import complain, speaking, warn
from drumrs.cli.movie import movie
from drumrs.cli.optimize import optimize
from drumrs.cli.options import PATH, cut_by_shell
from drumrs.cli.pack import pack
from drumrs.cli.quantities import quantities
from drumrs.cli.report import report
from drumrs.cli.reproduce import reproduce
from drumrs.cli.run import run
from drumrs.cli.scale import scale
from drumrs.cli.screen import screen
from drumrs.cli.signals import Asked, like_interrupts
from drumrs.cli.status import status
from drumrs.cli.studio import studio
from drumrs.cli.sweep import sweep
from drumrs.cli.validate import validate
from drumrs.cli.verify import verify
from drumrs.cli.view import view
from drumrs.config import Config, dotted_keys
from drumrs.errors import CheckpointError, ConfigError, DrumrsWarning, PictureWarning, UnstableError
from drumrs.files import NO_ROOM

_NO_PICTURE = 3
_BAD_INPUT = 2
_FAILED = 1

Flag = Annotated[bool, Parameter(negative="")]
_LOG = logging.getLogger("drumrs.command")

app = App(
    name="drumrs",
    help="Simulate a load tumbling in a rotating drum, with an energy balance that closes.",
    help_format="markdown",
    help_epilogue=(
        "Examples:\n\n"
        "- `drumrs init my-mill --template ball-mill` writes a machine to start from; `drumrs init` lists them\n"
        "- `drumrs studio` shows a drum that turns while you change it\n"
        "- `drumrs reproduce --quick` runs the paper's study in small and writes out/report.html\n"
        "- `drumrs baseline` runs the paper's drum without and with baffles\n"
        "- `drumrs config > case.toml` writes every key, with unit and meaning\n"
        "- `drumrs run case.toml --set contact.bundle.friction=0.3 --out out/case`\n"
        "- `drumrs run --set 'run.window=[5, 15]' --set run.duration=15 --seed 2 --json`\n"
        "- `drumrs run --resume out/case` goes on after Ctrl-C or a power cut\n"
        "- `drumrs view out/case` plays the run in the browser\n"
        "- `drumrs export out/case --to vtkhdf` writes it for ParaView\n"
        "- `drumrs movie out/case --out drum.mp4` writes it as a film\n"
        "- `drumrs report out/case --page mill` writes one page of it, for a trade\n"
        "- `drumrs sweep sweep.toml --out out/sweep` runs many cases; `drumrs status out/sweep` tells how far it is\n"
        "- `drumrs compare a.toml b.toml --by drum_specific_power` finds the better of two machines\n"
        "- `drumrs optimize search.toml` finds the best values of a few keys\n"
        "- `drumrs calibrate data.toml` finds what friction makes a measured drum come out right\n"
        "- `drumrs screen screen.toml --by drum_specific_power` says which keys matter\n"
        "- `drumrs scale case.toml --factor 4 --out large.toml` makes a larger machine of it\n"
        "- `drumrs quantities ratio` says what is measured under a name with that word\n"
        "- `drumrs verify` holds drumrs against formulas and its own promises\n"
        "- `drumrs validate tracer` simulates a drum that others measured, and compares"
    ),
    version=drumrs.__version__,
    suppress_keyboard_interrupt=False,
    result_action="return_value",
)

for _command in (
    init,
    studio,
    run,
    baseline,
    reproduce,
    sweep,
    status,
    pack,
    compare,
    optimize,
    calibrate,
    scale,
    screen,
    view,
    export,
    movie,
    report,
    verify,
    validate,
    config,
    quantities,
    info,
):
    app.command(_command, help_epilogue="")


app.meta.group_parameters = Group("Options of every command", sort_key=10)
app.register_install_completion_command(help="Make the shell complete commands and options of drumrs.")


@app.meta.default
def _main_command(
    *words: Annotated[str, Parameter(show=False, allow_leading_hyphen=True)],
    quiet: Flag = False,
    debug: Flag = False,
    log_file: Annotated[Path | None, PATH] = None,
) -> int:
    """Run a command.

    Parameters
    ----------
    quiet
        Say nothing on standard error but warnings and errors: no progress, no notes.
    debug
        Show where in the code an error comes from.
    log_file
        File to which lines of JSON are added: what is said, and what became of each case.
    """
    with speaking(quiet=quiet, debug=debug, log_file=log_file), like_interrupts() as asked:
        line = shlex.join(["drumrs", *words])
        log = {"version": drumrs.__version__, "host": platform.node(), "process": os.getpid()}
        _LOG.info("%s begins", line, extra={"fields": log})
        status = _outcome(words, asked)
        _LOG.info("%s ends", line, extra={"fields": {"status": status}})
    return status


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and leave with its exit status."""
    _write_utf8()
    with suppress(BrokenPipeError):
        status = run_command(arguments)
        sys.stdout.flush()
        sys.exit(status)
    # Whoever read our output has what they want: `drumrs config | head`.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    sys.exit(_FAILED)


def run_command(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status.

    0; 1: the run failed; 2: bad input; 3: the numbers are complete, but a picture could not be made; 130: Ctrl-C, and
    128 + n another signal that asks for the end.
    """
    words = sys.argv[1:] if arguments is None else list(arguments)
    try:
        status = app.meta(words, exit_on_error=False, print_error=False)
    except (CycloptsError, ConfigError) as error:
        # Of options of every command alone; of a command's own, `_outcome` tells.
        with speaking():
            complain(_advice(error) if isinstance(error, CycloptsError) else str(error), error)
        return _BAD_INPUT
    return status if isinstance(status, int) else 0


def _outcome(words: Sequence[str], asked: Asked) -> int:
    """Run a command, say why it failed, and return its exit status."""
    try:
        with _warnings_on_one_line() as raised:
            status = app(list(words), exit_on_error=False, print_error=False)
    except (ConfigError, CheckpointError) as error:
        return _fail(str(error), error, _BAD_INPUT)
    except CycloptsError as error:
        return _fail(_advice(error), error, _BAD_INPUT)
    except UnstableError as error:
        return _fail(str(error), error, _FAILED)
    except BrokenPipeError:
        raise
    except (OSError, MemoryError) as error:
        is_named_wrong = isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG
        return _fail(_system_message(error), error, _BAD_INPUT if is_named_wrong else _FAILED)
    except (KeyboardInterrupt, ImportError) as error:
        # Where Ctrl-C falls into the import of a module in C++, it is the cause of an ImportError.
        interrupt = error if isinstance(error, KeyboardInterrupt) else error.__cause__
        if not isinstance(interrupt, KeyboardInterrupt):
            raise
        sender = f" by {asked.name}" if asked.name else ""
        told = (str(interrupt) or "interrupted").replace("interrupted", f"interrupted{sender}", 1)
        return _fail(told, error, asked.status)
    pictures_failed = any(issubclass(kind, PictureWarning) for kind in raised)
    return (status if isinstance(status, int) else 0) or (_NO_PICTURE if pictures_failed else 0)


def _write_utf8() -> None:
    """Write UTF-8 to files and pipes, whatever the system's encoding is, and to terminals what they can show."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            if stream.isatty():
                stream.reconfigure(errors="replace")
            else:
                stream.reconfigure(encoding="utf-8", errors="replace")


def _advice(error: CycloptsError) -> str:
    """Return what to write instead of a key given as an option, a list without quotes, or a word too many."""
    if isinstance(error, UnknownOptionError) and error.target in (run, baseline):
        option = error.token.keyword or error.token.value
        word = option.lstrip("-").replace("-", "_")
        keys = [key for key in dotted_keys(Config) if key.rpartition(".")[2] == word]
        if keys:
            settings = " or ".join(f"--set {key}=VALUE" for key in keys)
            return f"{option} is not an option; write {settings}"
    words = (error.unused_tokens or []) if isinstance(error, UnusedCliTokensError) else []
    if words and words[-1].endswith(("]", "}")):
        return str(cut_by_shell(" ".join(words)))
    if words:
        return f"{' '.join(words)!r} is more than the command takes; drumrs COMMAND --help shows what it does"
    return " ".join(str(error).split())


def _system_message(error: OSError | MemoryError) -> str:
    """Return the message of an error of the operating system, or of memory."""
    if isinstance(error, OSError) and error.errno in NO_ROOM and error.strerror:
        return f"cannot write: {error.strerror}"
    if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
        return f"{str(error.filename)!r} cannot be the name of a file: {error.strerror}"
    return str(error) or "out of memory"


@contextmanager
def _warnings_on_one_line() -> Iterator[list[type[Warning]]]:
    """Show warnings of drumrs on one line each, and list their classes; show others as Python does."""
    raised: list[type[Warning]] = []
    with warnings.catch_warnings():
        warnings.simplefilter("default", DrumrsWarning)
        shown = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
            if issubclass(category, DrumrsWarning):
                raised.append(category)
                warn(f"{message}" if issubclass(category, PictureWarning) else f"note that {message}")
            else:
                shown(message, category, *place, **more)

        warnings.showwarning = show
        yield raised


def _fail(message: str, error: BaseException, status: int) -> int:
    complain(message, error)
    return status
