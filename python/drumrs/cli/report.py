"""`drumrs report`: one page of a finished run, for a trade."""

from pathlib import Path
from typing import Annotated

from drumrs.cli.options import PATH
from drumrs.cli.tables import print_paths
from drumrs.errors import ConfigError
from drumrs.pages import check_page


def report(run: Path, /, *, page: str = "research", out: Annotated[Path | None, PATH] = None) -> None:
    """Write one page of a finished run: numbers with errors, pictures, the player, the energy ledger.

    The page is one HTML file that needs no network. Each answers the question of a trade:

    - `washer`: falls, knocking and rubbing, slip, unbalance, phase by phase
    - `dryer`: openness, curtain, falls
    - `mill`: power beside two models of mills, toe and shoulder, collisions, wear of the liner
    - `coater`: visits to the spray, circulation, mixing, the flowing layer
    - `research`: all that is measured

    Collisions need `run.record = ["contacts"]`, wear `"wall_profile"`, knocking and rubbing by whom `"ledger_split"`,
    what discs receive `"discs"`: a page says what it lacks, and is whole without.

    Parameters
    ----------
    run
        Folder of a finished run: drumrs run CASE.toml --out FOLDER.
    page
        washer, dryer, mill, coater or research.
    out
        File of the page. Without it: report.html in the folder.
    """
    from drumrs import reports
    from drumrs.result import load

    reports.require_page(page, "--page")
    path = out or run / reports.REPORT
    check_page(path, "the page" if out is None else "--out")
    if out is not None and out.suffix != ".html":
        raise ConfigError("--out", out, "a file whose name ends in .html")
    try:
        print_paths([reports.report(load(run), page, path)])
    except OSError as error:
        limit = f"a file that can be written (--out): {error.strerror}"
        raise ConfigError("the page", path, limit) from None
