"""`drumrs config`: every key of a case as a file, with the laws of its species; presets; a schema for editors."""

import json
import sys
import textwrap
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

import drumrs
from drumrs.cli.options import layered
from drumrs.config import Config, laws
from drumrs.config.presets import presets_toml
from drumrs.config.schema import editor_schema

# Keys that do not count with a base law.
_OF_OTHER_BASES = {
    "linear": {"young_modulus", "poisson_ratio"},
    "hertz": {"normal_stiffness", "stiffness_ratio", "rolling_friction", "tangential_damping_ratio"},
}


Flag = Annotated[bool, Parameter(negative="")]


def config(case: Path | None = None, *, species: Flag = False, schema: Flag = False) -> None:
    """Print every key with its value, unit and meaning, as TOML: `drumrs config > case.toml`.

    Of a load of several species, how much there is of each and what acts between any two of them, and between each and
    the drum, stands at the end as a comment.

    Parameters
    ----------
    case
        TOML file with some keys; the baseline's values without it.
    species
        Print the presets of species instead, each number with its source: `preset = "steel-ball"` in a table
        `[[load.species]]` is density and contact keys of that material; keys beside it win.
    schema
        Print a JSON schema of the keys instead: `drumrs config --schema > drumrs.schema.json`. With the first line
        `#:schema drumrs.schema.json` of a case file beside it, editors that know TOML (Even Better TOML in VS Code,
        Taplo, Tombi) complete keys, show meanings and units, and mark mistakes.
    """
    if schema:
        _print(json.dumps(editor_schema(Config), ensure_ascii=False, indent=2) + "\n")
    elif species:
        _print(presets_toml())
    elif case is None:
        opening = "# The baseline of drumrs, the paper's Table 1. Keep what differs, delete the rest.\n\n"
        _print(opening + drumrs.baseline().to_toml())
    else:
        whole = layered(case, None, None)
        tables = [_species(whole), _laws(whole)] if whole.load.species else []
        comments = "".join("\n" + textwrap.indent("\n".join(rows), "# ") + "\n" for rows in tables)
        _print(whole.to_toml() + comments)


def _species(config: Config) -> list[str]:
    """Say how much there is of each species."""
    found = config.derived.species
    rows = [
        (name, str(own.count), f"{own.mass:.4g}", f"{own.smallest:.4g}", f"{own.largest:.4g}")
        for name, own in found.items()
    ]
    return _table([("species", "bundles", "mass [kg/m]", "smallest [m]", "largest [m]"), *rows])


def _laws(config: Config) -> list[str]:
    """Say what acts, pair by pair, in all keys that count."""
    found = laws(config.load, config.contact)
    values = [law.table.model_dump(exclude=_OF_OTHER_BASES[config.contact.base]) for law in found]
    keys = [key for key in values[0] if any(own[key] is not None for own in values)]
    rows = [
        (" - ".join(law.between), *(_text(own[key]) for key in keys), law.key)
        for law, own in zip(found, values, strict=True)
    ]
    return _table([("between", *keys, "from"), *rows])


def _text(value: object) -> str:
    return "-" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def _table(rows: list[tuple[str, ...]]) -> list[str]:
    """Align texts in columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows
    ]


def _print(text: str) -> None:
    """Print what is to become a file in UTF-8, whatever the system writes to its terminals."""
    if sys.stdout.isatty():
        sys.stdout.write(text)
    else:
        sys.stdout.flush()
        sys.stdout.buffer.write(text.encode())
        sys.stdout.flush()
