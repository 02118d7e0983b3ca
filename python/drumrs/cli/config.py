"""`drumrs config`: every key, as a file to start from, or as a schema for editors."""

import json
import sys
from typing import Annotated

from cyclopts import Parameter

import drumrs
from drumrs.config import Config
from drumrs.config.schema import editor_schema


def config(*, schema: Annotated[bool, Parameter(negative="")] = False) -> None:
    """Print every key with its default, unit and meaning, as TOML: `drumrs config > case.toml`.

    Parameters
    ----------
    schema
        Print a JSON schema of the keys instead: `drumrs config --schema > drumrs.schema.json`. With the first line
        `#:schema drumrs.schema.json` of a case file beside it, editors that know TOML (Even Better TOML in VS Code,
        Taplo, Tombi) complete keys, show meanings and units, and mark mistakes.
    """
    if schema:
        _print(json.dumps(editor_schema(Config), ensure_ascii=False, indent=2) + "\n")
    else:
        opening = "# The baseline of drumrs, the paper's Table 1. Keep what differs, delete the rest.\n\n"
        _print(opening + drumrs.baseline().to_toml())


def _print(text: str) -> None:
    """Print what is to become a file in UTF-8, whatever the system writes to its terminals."""
    if sys.stdout.isatty():
        sys.stdout.write(text)
    else:
        sys.stdout.flush()
        sys.stdout.buffer.write(text.encode())
        sys.stdout.flush()
