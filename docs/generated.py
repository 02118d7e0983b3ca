"""What the program writes for the site: keys, commands, the first drum, copies of pages, the link to the crate."""

import importlib
import shutil
from pathlib import Path
from typing import Any

from sphinx.util import logging

import drumrs
import live_drum
from drumrs.cli.app import app

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "docs" / "_generated"
# Packages and modules for users, a page each; `drumrs` itself has pages of its own.
MODULES = (
    "analysis",
    "config",
    "decide",
    "errors",
    "exports",
    "figures",
    "measures",
    "reports",
    "studio",
    "sweep",
    "validation",
    "verification",
    "viewer",
)
# Where `cargo doc` writes to.
RUST = ROOT / "target" / "doc"
# Pages that the repository shows beside the code.
COPIES = {
    "architecture.md": "ARCHITECTURE.md",
    "changelog.md": "CHANGELOG.md",
    "contributing.md": "CONTRIBUTING.md",
    "speed.md": "benches/README.md",
}


def write() -> None:
    """Write all of them."""
    FOLDER.mkdir(exist_ok=True)
    for copy, original in COPIES.items():
        _put(copy, (ROOT / original).read_text(encoding="utf-8"))
    for picture in (ROOT / "benches").glob("*.png"):
        shutil.copy(picture, FOLDER)
    _put("commands.md", commands())
    _put("keys.md", keys())
    _put("rust.html", _rust())
    for name in MODULES:
        _put(f"drumrs.{name}.rst", module(f"drumrs.{name}"))
    (ROOT / "docs" / "site" / "drum.html").write_text(_drum(), encoding="utf-8")


def commands() -> str:
    """Return every command and its options, for the page that has a title."""
    return app.generate_docs().partition("\n")[2]


def keys() -> str:
    """Return every key of a configuration, with its default, limits and meaning, for the page that has a title."""
    schema = drumrs.Config.model_json_schema()
    lines: list[str] = []
    _tables(schema, schema["$defs"], (), lines)
    return "\n".join(lines) + "\n"


def module(name: str) -> str:
    """Return a page with what a module offers and `drumrs` itself does not, from docstrings; constants have none."""
    offered = getattr(importlib.import_module(name), "__all__", [])
    elsewhere = ", ".join(sorted(set(offered) & set(drumrs.__all__)))
    constants = [f".. autodata:: {name}.{one}\n   :no-value:\n" for one in offered if one.isupper()]
    lines = [name, "=" * len(name), "", f".. automodule:: {name}", "   :members:"]
    lines += [f"   :exclude-members: {elsewhere}"] if elsewhere else []
    return "\n".join([*lines, "", *constants])


def _tables(table: dict[str, Any], known: dict[str, Any], path: tuple[str, ...], lines: list[str]) -> None:
    """Add a table and those below it; `path` has the names of those above."""
    prefix = "".join(f"{name}." for name in path)
    rows, below = [], []
    for name, value in table["properties"].items():
        inner = _table_of(value, known)
        # Phases may hold phases: once is enough.
        if inner is not None and inner is not table:
            below.append((name, inner))
            continue
        default = value.get("default")
        shown = (
            "" if default is None else f"`{str(default).lower() if isinstance(default, bool) else default}`"
        )
        meaning = value.get("description", "").replace("|", "\\|").replace("\n", " ")
        rows.append(f"| `{prefix}{name}` | {shown} | {_limits(value)} | {meaning} |")
    if rows:
        lines += [f"## {prefix.removesuffix('.') or 'At the top'}", ""]
        lines += [table["description"].splitlines()[0], ""] if path and table.get("description") else []
        lines += ["| key | default | limits | meaning |", "|---|---|---|---|", *rows, ""]
    for name, inner in below:
        _tables(inner, known, (*path, name), lines)


def _limits(value: dict[str, Any]) -> str:
    """Return what a plain value may be, beside its type: words to choose from, bounds."""
    found = []
    for one in (value, *value.get("anyOf", [])):
        found += [f"`{word}`" for word in one.get("enum", [])]
        found += [f"`{one['const']}`"] if "const" in one else []
        bounds = [
            f"{sign} {one[key]}"
            for key, sign in (("gt", ">"), ("ge", "≥"), ("lt", "<"), ("le", "≤"))
            if key in one
        ]
        found += [" and ".join(bounds)] if bounds else []
    return ", ".join(found)


def _table_of(value: dict[str, Any], known: dict[str, Any]) -> dict[str, Any] | None:
    """Return the table that a key holds, or each entry of a list that it holds; `None` for a plain value."""
    choices = [value, value.get("items", {}), *value.get("allOf", []), *value.get("anyOf", [])]
    names = [one["$ref"].rpartition("/")[2] for one in choices if "$ref" in one]
    names += [one["items"]["$ref"].rpartition("/")[2] for one in choices if "$ref" in one.get("items", {})]
    found = known[names[0]] if names else {}
    return found if "properties" in found else None


def _rust() -> str:
    """Return the link to the documentation of the crate, where `cargo doc` has made it."""
    if RUST.is_dir():
        return '<p><a href="../rust/drumrs/index.html">Modules, types and functions of the crate</a></p>'
    return "<p><code>cargo doc --no-deps --open</code> shows modules, types and functions of the crate.</p>"


def _drum() -> str:
    """Return the drum of the first page: one that runs there, or the player of a short run."""
    if live_drum.is_built():
        return live_drum.page()
    logging.getLogger(__name__).info(
        "the drum of the first page is a recorded one: make wasm builds the core that would run there"
    )
    changes = {"run.duration": 6.0, "run.window": [3.0, 6.0]}
    config = drumrs.baseline(fill=0.25, baffles=True).softer(100.0).replace(changes)
    return drumrs.player(drumrs.run(config, progress=False)).page()


def _put(name: str, text: str) -> None:
    """Write a page where it is new, so that the rest is not made again."""
    path = FOLDER / name
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
