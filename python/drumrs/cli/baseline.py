"""`drumrs baseline`: the paper's drum without and with baffles, side by side."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

import drumrs
from drumrs.cli.messages import note
from drumrs.cli.options import PATH, Seed, Settings, check_folder
from drumrs.cli.tables import print_paths, print_table
from drumrs.config import Config, merge, nest, parse_settings
from drumrs.folders import claim, require_own
from drumrs.output import require_folder
from drumrs.pictures import attempt
from drumrs.result import Result
from drumrs.runs import run_side_by_side


def baseline(
    *,
    fill: float = 0.25,
    out: Annotated[Path, PATH] = Path("out/baseline"),
    set_: Settings = None,
    seed: Seed = None,
    force: Annotated[bool, Parameter(negative="")] = False,
) -> None:
    """Run the paper's drum without and with baffles, side by side, and compare them.

    Parameters
    ----------
    fill
        Fill N d²/D²; 0.25 is 100 bundles.
    out
        Folder for the results of both and a picture that shows them next to each other.
    force
        Replace the results of other cases in the folder. Files that drumrs did not write are never overwritten.
    """
    check_folder(out)
    layer = nest(parse_settings(set_ or []))
    if seed is not None:
        layer = merge(Config, layer, {"run": {"seed": seed}})
    cases = {
        name: drumrs.baseline(fill, baffles=baffles).replace(layer)
        for name, baffles in (("without baffles", False), ("with baffles", True))
    }
    folders = {name: out / name.replace(" ", "_") for name in cases}
    require_own(out, "baseline", ["baseline.png"], "--out")
    for name, config in cases.items():
        require_folder(folders[name], config, force=force, option="--out")
    first = next(iter(cases.values()))
    note(first.facts)
    results = run_side_by_side(cases)
    claim(out, "baseline", first.title, first.digest)
    written = [
        path for name, result in results.items() for path in drumrs.save(result, folders[name], force=force)
    ]
    print_table({name: result.summary for name, result in results.items()})
    print_paths([*_draw_together(results, out), *(path for path in written if path.suffix == ".png")])


def _draw_together(results: dict[str, Result], out: Path) -> list[Path]:
    path = out / "baseline.png"
    path.unlink(missing_ok=True)
    with attempt(path):
        from drumrs import figures

        views = [figures.View(result.frames, -1, name) for name, result in results.items()]
        figures.write(figures.snapshots(views), path)
        return [path]
    return []
