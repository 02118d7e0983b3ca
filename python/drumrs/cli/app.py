"""The command `drumrs`: its list of commands, and what an error becomes."""

import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from cyclopts import App, CycloptsError, UnknownOptionError, UnusedCliTokensError

import drumrs
from drumrs.cli.baseline import baseline
from drumrs.cli.config import config
from drumrs.cli.export import export
from drumrs.cli.info import info
from drumrs.cli.init import init
from drumrs.cli.movie import movie
from drumrs.cli.options import cut_by_shell
from drumrs.cli.quantities import quantities
from drumrs.cli.report import report
from drumrs.cli.reproduce import reproduce
from drumrs.cli.run import run
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
_INTERRUPTED = 130

app = App(
    name="drumrs",
    help="Simulate a load tumbling in a rotating drum, with an energy balance that closes.",
    help_format="markdown",
    help_epilogue=(
        "Examples:\n\n"
        "- `drumrs init my-mill --template ball-mill` writes a machine to start from; `drumrs init` lists them\n"
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
        "- `drumrs sweep sweep.toml --out out/sweep` runs many cases\n"
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
    run,
    baseline,
    reproduce,
    sweep,
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


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and leave with its exit status."""
    sys.exit(run_command(arguments))


def run_command(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status.

    0; 1: the run failed; 2: bad input; 3: the numbers are complete, but a picture could not be made; 130: Ctrl-C.
    """
    words = sys.argv[1:] if arguments is None else list(arguments)
    try:
        with _warnings_on_one_line() as raised:
            status = app(words, exit_on_error=False, print_error=False)
    except (ConfigError, CheckpointError) as error:
        return _fail(str(error), _BAD_INPUT)
    except CycloptsError as error:
        return _fail(_advice(error) or " ".join(str(error).split()), _BAD_INPUT)
    except UnstableError as error:
        return _fail(str(error), _FAILED)
    except (OSError, MemoryError) as error:
        return _fail(_system_message(error), _FAILED)
    except (KeyboardInterrupt, ImportError) as error:
        # Where Ctrl-C falls into the import of a module in C++, it is the cause of an ImportError.
        interrupt = error if isinstance(error, KeyboardInterrupt) else error.__cause__
        if not isinstance(interrupt, KeyboardInterrupt):
            raise
        return _fail(str(interrupt) or "interrupted", _INTERRUPTED)
    pictures_failed = any(issubclass(kind, PictureWarning) for kind in raised)
    return (status if isinstance(status, int) else 0) or (_NO_PICTURE if pictures_failed else 0)


def _advice(error: CycloptsError) -> str | None:
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
    return None


def _system_message(error: OSError | MemoryError) -> str:
    """Return the message of an error of the operating system, or of memory."""
    if isinstance(error, OSError) and error.errno in NO_ROOM and error.strerror:
        return f"cannot write: {error.strerror}"
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
                note = "" if issubclass(category, PictureWarning) else "note that "
                sys.stderr.write(f"drumrs: {note}{message}\n")
            else:
                shown(message, category, *place, **more)

        warnings.showwarning = show
        yield raised


def _fail(message: str, status: int) -> int:
    sys.stderr.write(f"drumrs: {message}\n")
    return status
