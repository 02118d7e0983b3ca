"""The player's JavaScript modules, joined into one, so that a page opens from disk without a server.

Joining is plain text: each file once, after those it imports, without their lines ``import { name } from "./file.js";``
and the word ``export``. So each import is one such line, only declarations are exported, but for the default of an
entry, and no two files declare one name. `assets.js` and `studio_assets.js` are made here: the texts of HTML and CSS
files.
"""

import json
import re
from functools import cache
from importlib.resources import files

_IMPORT = re.compile(r'^import \{[^}]+\} from "\./(\w+\.js)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:class|const|function) (\w+))", re.MULTILINE)


@cache
def module(*entries: str) -> str:
    """Return one JavaScript module that needs no other and exports what the entries export.

    Parameters
    ----------
    *entries
        Names of files of this folder, such as ``"player.js"`` and ``"recording.js"``; their first comments say how to
        use them.

    Examples
    --------
    >>> from drumrs.viewer import module
    >>> module("player.js", "recording.js").splitlines()[-1]
    'export { Player, Recording, DIRECTIONS, unpack, unpackFrame, unpackPanel, mix };'
    """
    texts: dict[str, str] = {}
    for entry in entries:
        _add(entry, texts)
    names = [name for entry in entries for name in _EXPORT.findall(_read(entry))]
    joined = "\n".join(_EXPORT.sub("", _IMPORT.sub("", text)) for text in texts.values())
    return f"{joined}\nexport {{ {', '.join(names)} }};" if names else joined


def _add(name: str, texts: dict[str, str]) -> None:
    """Add a file to those found so far, after the files that it imports."""
    if name in texts:
        return
    text = _read(name)
    for imported in _IMPORT.findall(text):
        _add(imported, texts)
    texts[name] = text


def _read(name: str) -> str:
    if name not in _ASSETS:
        return _file(name)
    # A text within a page's script must not end it.
    quoted = {key: json.dumps(_file(file)).replace("</", "<\\/") for key, file in _ASSETS[name].items()}
    return "".join(f"export const {key} = {text};\n" for key, text in quoted.items())


_ASSETS = {
    "assets.js": {"MARKUP": "player.html", "STYLE": "player.css"},
    "studio_assets.js": {"STUDIO_MARKUP": "studio.html", "STUDIO_STYLE": "studio.css"},
}


def _file(name: str) -> str:
    return files(__package__ or "drumrs.viewer").joinpath(name).read_text(encoding="utf-8")
