"""Documentation that runs: README, docs/*.md, and the examples in docstrings.

Pages run from the first block to the last, in a folder of their own, each section (``##``) with names of its own:

- ``python`` is run, and a ``text`` block after it must be what it printed, whatever the numbers are;
- ``toml`` is written to the file that its first line names;
- ``sh``: lines that begin with ``drumrs`` are called, where the page says ``<!-- commands: run -->``; elsewhere
  they must be commands that drumrs knows, with options that it takes.

Runs last for a tenth of a second here, whatever duration the page gives them. Other languages, and other lines of
``sh``, do not run; nor does what follows ``<!-- skip: next "reason" -->``.
"""

import contextlib
import doctest
import io
import os
import re
import shlex
import tempfile
import webbrowser
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from unittest import mock

from sybil import Document, Example, Region, Sybil
from sybil.evaluators.python import PythonEvaluator
from sybil.parsers.markdown import CodeBlockParser, SkipParser
from sybil.parsers.rest import DocTestParser
from sybil.region import Lexeme

import drumrs
from drumrs.cli.app import app, run_command

_MOMENT = 0.1
_RUNS_COMMANDS = "<!-- commands: run -->"


class Page:
    """What the blocks of a page share: a folder, and what was printed last."""

    def __init__(self) -> None:
        self._open = contextlib.ExitStack()
        self._printed = ""

    def begin(self, _namespace: dict[str, Any]) -> None:
        """Enter an empty folder, where the baseline is as short as the rest and no browser opens."""
        baseline, folder = drumrs.baseline, self._open.enter_context(tempfile.TemporaryDirectory())
        self._open.callback(os.chdir, Path.cwd())
        os.chdir(folder)
        for target, name, substitute in (
            (drumrs, "baseline", lambda *a, **k: baseline(*a, **k).replace({"run.duration": _MOMENT})),
            (webbrowser, "open", lambda *_: True),
        ):
            self._open.enter_context(mock.patch.object(target, name, substitute))

    def end(self, _namespace: dict[str, Any]) -> None:
        """Go back, and remove the folder."""
        self._open.close()

    def python(self, example: Example) -> None:
        """Run Python, and keep what it prints."""
        example.parsed = Lexeme(_short(example.parsed), 0, example.parsed.line_offset)
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            PythonEvaluator()(example)
        self._printed = printed.getvalue()

    def text(self, example: Example) -> str | None:
        """Compare what was printed last with what the page says."""
        if _without_numbers(example.parsed) == _without_numbers(self._printed):
            return None
        return f"the page says\n{example.parsed}\nbut printed was\n{self._printed}"

    def toml(self, example: Example) -> str | None:
        """Write a file."""
        name = re.match(r"# ([\w.]+)", example.parsed)
        if name is None:
            return "the first line of a TOML block must name its file"
        Path(name[1]).write_text(_short(example.parsed), encoding="utf-8")
        return None

    def sh(self, example: Example) -> str | None:
        """Call the commands, or see that they could be."""
        for line in re.findall(r"^drumrs (.*)$", _short(example.parsed), re.MULTILINE):
            words = shlex.split(line.partition(" > ")[0], comments=True)
            if _RUNS_COMMANDS not in example.document.text:
                app.parse_args(words, exit_on_error=False, print_error=False)
                continue
            said = io.StringIO()
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
                status = run_command(words)
            if status != 0:
                return f"drumrs {line} returned {status} and said\n{said.getvalue()}"
        return None


def _short(text: str) -> str:
    """Return code whose runs last for a moment."""
    return re.sub(r"""(duration["']?\s*[=:]\s*)[\d.]+""", rf"\g<1>{_MOMENT}", text)


def _without_numbers(text: str) -> str:
    return " ".join(re.sub(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", "0", text).split())


def _sections(document: Document) -> Iterable[Region]:
    """Give every heading of a section: names of the one before are forgotten there."""
    for heading in re.finditer(r"^## .*$", document.text, re.MULTILINE):
        yield Region(heading.start(), heading.end(), heading[0], lambda example: example.namespace.clear())


_page = Page()
_pages = Sybil(
    parsers=[
        _sections,
        SkipParser(),
        *(
            CodeBlockParser(language, getattr(_page, language))
            for language in ("python", "text", "toml", "sh")
        ),
    ],
    patterns=["*.md"],
    excludes=["*_generated/*"],  # copies, made for the documentation site
    setup=_page.begin,
    teardown=_page.end,
)
_docstrings = Sybil(
    parsers=[DocTestParser(optionflags=doctest.ELLIPSIS)],
    path="python/drumrs",
    patterns=["*.py"],
)

pytest_collect_file = (_pages + _docstrings).pytest()
