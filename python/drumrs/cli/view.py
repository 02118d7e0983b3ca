"""`drumrs view`: a run in the browser."""

import webbrowser
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.cli.tables import print_paths
from drumrs.errors import ConfigError


def view(
    run: Path,
    /,
    *,
    out: Path | None = None,
    show: Annotated[bool, Parameter(name="--open")] = True,
) -> None:
    """Show a run in the browser: play it, step through it, color it by what matters.

    Parameters
    ----------
    run
        Folder of a run, its frames.parquet, or a case of a sweep (ID.frames.parquet).
    out
        File of the page, which is then written and not opened. Without it: player.html beside the frames.
    show
        Whether to open the page in the browser.
    """
    from drumrs import viewer

    player = viewer.read(run)
    page = out or viewer.default_page(run)
    try:
        player.save(page)
    except OSError as error:
        limit = f"a file that can be written (--out): {error.strerror}"
        raise ConfigError("the page", str(page), limit) from None
    print_paths([page])
    if show and out is None:
        webbrowser.open(page.absolute().as_uri())
