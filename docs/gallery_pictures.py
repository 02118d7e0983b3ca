"""What the gallery shows of an example: the pictures and the pages that it wrote, in its small form."""

import os
import shutil
from pathlib import Path
from typing import Any

from sphinx_gallery.scrapers import figure_rst

from drumrs.progress import ProgressDisplay

ROOT = Path(__file__).parents[1]
_OUT = ROOT / "out" / "gallery"
_PAGES = ROOT / "docs" / "site" / "gallery"
# What a page shows as output is what the script prints.
ProgressDisplay.is_hidden = True


def arguments(_gallery: dict[str, Any], script: dict[str, Any]) -> list[str]:
    """Return the command line of an example, and empty the folder that it writes to."""
    path = Path(script["src_file"])
    folder = _OUT / path.stem
    shutil.rmtree(folder, ignore_errors=True)
    # Relative, for examples print it.
    return ["--small", "--out", os.path.relpath(folder, path.parent)]


def written(_block: Any, script: dict[str, Any], gallery: dict[str, Any]) -> str:
    """Return what shows the pictures that an example wrote, and its pages, such as players, in frames."""
    name = Path(script["src_file"]).stem
    text = ""
    for picture in sorted((_OUT / name).glob("*.png")):
        copy = next(script["image_path_iterator"])
        shutil.copy(picture, copy)
        text += figure_rst([copy], gallery["src_dir"], fig_titles=f"{picture.stem} of {name}")
    for page in sorted((_OUT / name).glob("*.html")):
        _PAGES.mkdir(parents=True, exist_ok=True)
        shutil.copy(page, _PAGES / f"{name}-{page.name}")
        source = f"../_static/gallery/{name}-{page.name}"
        frame = (
            f'<iframe src="{source}" title="{page.stem} of {name}" class="player" loading="lazy"></iframe>'
        )
        text += f"\n\n.. raw:: html\n\n   {frame}\n\n"
    return text
