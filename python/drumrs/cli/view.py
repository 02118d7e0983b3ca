"""`drumrs view`: a run in the browser."""

import webbrowser
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.cli.messages import note
from drumrs.cli.options import PATH
from drumrs.cli.tables import print_paths
from drumrs.errors import ConfigError
from drumrs.pages import check_page


def view(
    run: Path,
    /,
    *,
    case: Annotated[list[str] | None, Parameter(negative="")] = None,
    out: Annotated[Path | None, PATH] = None,
    show: Annotated[bool, Parameter(name="--open")] = True,
) -> None:
    """Show a run in the browser: play it, step through it, color it by what matters.

    Parameters
    ----------
    run
        Folder of a run, its frames.parquet, or a sweep's folder with the beginning of a case's id: out/study/3f2a. A
        folder with several runs is answered with what there is.
    case
        Which case of a sweep's folder: KEY=VALUE of its configuration; may be repeated.
    out
        File of the page, which is then written and not opened. Without it: player.html beside the frames.
    show
        Whether to open the page in the browser.
    """
    from drumrs import viewer

    frames = viewer.find(run, case or [])
    if out is not None:
        check_page(out, "--out")
    page = out or viewer.default_page(frames)
    player = viewer.read(frames)
    try:
        player.save(page)
    except OSError as error:
        limit = f"a file that can be written (--out): {error.strerror}"
        raise ConfigError("the page", page, limit) from None
    print_paths([page])
    if show and out is None and not _opens(page):
        note(
            f"found no browser here; open {page.absolute().as_uri()} in one, or take the file to where "
            "there is one: it needs nothing else"
        )


def _opens(page: Path) -> bool:
    try:
        return webbrowser.open(page.absolute().as_uri())
    except webbrowser.Error:
        return False
