"""`drumrs calibrate`: parameters of the model from measured numbers."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from drumrs.cli.messages import note
from drumrs.cli.options import PATH, Jobs, check_folder
from drumrs.cli.tables import print_paths

if TYPE_CHECKING:
    from drumrs.decide import Calibration

_WIDE = 160


def calibrate(
    file: Path,
    /,
    *,
    out: Annotated[Path, PATH] = Path("out/calibrate"),
    jobs: Jobs = None,
) -> int:
    """Find out which parameters measured numbers leave, and how sure that is.

    The file has `[base]` as that of `drumrs sweep`; `[ranges]`, parameters with `[low, high]` each, all values between
    being equally likely beforehand; and a table `[[measured]]` for each number that was measured: `target`, as
    `drumrs compare --by` takes it, `value`, `error`, its standard error, and `set`, the keys in which its drum differs
    from the base. A table `[[candidate]]` of the same form, without `value`, is a number that may be measured next.
    `[calibrate]` has `runs`, how many points of the ranges are simulated, and `discrepancy`, what the model itself may
    be off by (`"3 %"`).

    The same command goes on after Ctrl-C or a power cut; what is finished is not simulated again.

    Parameters
    ----------
    file
        TOML file with `[base]`, `[ranges]`, `[[measured]]`, `[[candidate]]` and `[calibrate]`.
    out
        Folder for posterior.parquet, calibration.png and runs/.
    """
    import drumrs
    from drumrs.decide import Experiment

    check_folder(out)
    experiment = Experiment.read(file)
    runs = experiment.runs * len(experiment.drums)
    parameters = ", ".join(experiment.space.keys)
    note(f"measurements: {len(experiment.measured)}; parameters: {parameters}; runs: {runs}")
    found = drumrs.calibrate(experiment, out, jobs=jobs)
    _print(found)
    print_paths([out / name for name in ("posterior.parquet", "calibration.png")])
    return 0


def _print(found: "Calibration") -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from drumrs.result import number, with_error

    parameters = Table(box=None, highlight=False)
    for column in ("parameter", "median", "90 % interval", "scatter over that of the range"):
        parameters.add_column(column, justify="left" if column == "parameter" else "right")
    for key, median, low, high, narrowing in found.table.iter_rows():
        parameters.add_row(
            escape(key), number(median), f"{number(low)} to {number(high)}", f"{narrowing:.2f}"
        )
    fits = Table(box=None, highlight=False)
    for column in ("measured", "value", "model", "off by errors"):
        fits.add_column(column, justify="left" if column == "measured" else "right")
    for name, value, error, model, model_error, off in found.fits.iter_rows():
        fits.add_row(escape(name), with_error(value, error), with_error(model, model_error), f"{off:+.1f}")
    # What goes to a file or a pipe has room for everything.
    console = Console(highlight=False, width=None if sys.stdout.isatty() else _WIDE)
    console.print(parameters)
    console.print(fits)
    console.print(found.sentence, markup=False, soft_wrap=True)
