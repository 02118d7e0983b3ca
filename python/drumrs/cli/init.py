"""`drumrs init`: a folder with a machine to start from; the machines are the folders of drumrs/templates."""

import difflib
import json
import sys
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.cli.messages import note
from drumrs.cli.options import PATH, check_folder
from drumrs.cli.tables import print_paths
from drumrs.config import Config
from drumrs.config.schema import editor_schema
from drumrs.errors import ConfigError

_BAD_INPUT = 2
_TEMPLATES = files("drumrs") / "templates"


def init(
    folder: Annotated[Path | None, PATH, Parameter(name="NAME")] = None, /, *, template: str | None = None
) -> int:
    """Write a folder NAME with a machine to start from: `drumrs init my-mill --template ball-mill`.

    It holds case.toml, in which each number has its source or the word assumed; sweep.toml, a first question to ask; a
    README.md with the commands to type; and drumrs.schema.json, by which editors complete keys and mark mistakes. They
    are yours to change.

    Parameters
    ----------
    folder
        The folder; it must not exist, or be empty.
    template
        Name of the machine; without it they are listed.
    """
    known = {each.name: each for each in sorted(_TEMPLATES.iterdir(), key=lambda each: each.name)}
    if template is None:
        sys.stdout.writelines(f"{name:<13} {_title(each)}\n" for name, each in known.items())
        name = "NAME" if folder is None else folder
        note(f"choose one: drumrs init {name} --template {next(iter(known))}")
        return 0 if folder is None else _BAD_INPUT
    if template not in known:
        close = difflib.get_close_matches(template, known, n=1)
        hint = f"did you mean {close[0]}?" if close else "drumrs init says what they are"
        raise ConfigError("--template", template, f"one of {', '.join(known)}", hint=hint)
    if folder is None:
        hint = f"such as drumrs init my-{template} --template {template}"
        raise ConfigError("NAME", problem="is missing, but must be the folder to write", hint=hint)
    _write(known[template], folder)
    return 0


def _title(template: Traversable) -> str:
    """Return the first line of a template's README."""
    heading, _, _ = template.joinpath("README.md").read_text(encoding="utf-8").partition("\n")
    return heading.removeprefix("# ")


def _write(template: Traversable, folder: Path) -> None:
    check_folder(folder, "NAME")
    if folder.exists() and any(folder.iterdir()):
        limit = "a new folder, or an empty one: nothing is overwritten"
        raise ConfigError("NAME", folder, limit, hint="choose another")
    contents = {each.name: each.read_bytes() for each in template.iterdir()}
    contents["drumrs.schema.json"] = json.dumps(editor_schema(Config), ensure_ascii=False, indent=2).encode()
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    print_paths([folder / name for name in contents])
    note(f"{folder / 'README.md'} says how to go on")
