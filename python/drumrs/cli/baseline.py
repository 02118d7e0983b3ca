"""`drumrs baseline`: the paper's drum without and with baffles, side by side."""

from pathlib import Path

import drumrs
from drumrs.cli.options import Seed, Settings, check_folder
from drumrs.cli.tables import print_paths, print_table
from drumrs.config import Config, merge, nest, parse_settings
from drumrs.pictures import attempt
from drumrs.protocol import run_side_by_side
from drumrs.result import Result


def baseline(
    *, fill: float = 0.25, out: Path = Path("out"), set_: Settings = None, seed: Seed = None
) -> None:
    """Run the paper's drum without and with baffles, side by side, and compare them.

    Parameters
    ----------
    fill
        Fill N d²/D²; 0.25 is 100 bundles.
    out
        Folder for the results of both and a picture that shows them next to each other.
    """
    check_folder(out)
    layer = nest(parse_settings(set_ or []))
    if seed is not None:
        layer = merge(Config, layer, {"run": {"seed": seed}})
    cases = {
        name: drumrs.baseline(fill, baffles=baffles).replace(layer)
        for name, baffles in (("without baffles", False), ("with baffles", True))
    }
    results = run_side_by_side(cases)
    written = [
        path for name, result in results.items() for path in drumrs.save(result, out / name.replace(" ", "_"))
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
