"""`drumrs compare`: which of a few machines is best."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from drumrs.cli.messages import note
from drumrs.cli.options import PATH, WHOLE, Jobs, Settings, check_folder, layered
from drumrs.cli.tables import print_paths
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.decide import Comparison

_STYLES = {"best": "green", "equal": "green", "worse": "red", "open": "yellow"}


def compare(
    *cases: Annotated[Path, PATH, Parameter(name="CASE")],
    by: str = "drum_specific_power",
    greatest: Annotated[bool, Parameter(negative="")] = False,
    difference: str = "5 %",
    most: Annotated[int, WHOLE] = 200,
    out: Annotated[Path, PATH] = Path("out/compare"),
    set_: Settings = None,
    jobs: Jobs = None,
) -> int:
    """Find out which of a few machines is best, by as many seeds as that takes.

    Each case is run with four seeds, then with more where they settle most, until every other case is worse than the
    best one for sure, or as good within the difference, with 95 %. The same command goes on after Ctrl-C or a power
    cut, and with more runs allowed; what is finished is not simulated again.

    Parameters
    ----------
    cases
        Case files, two at least; their names without the ending are the names of the designs.
    by
        What they are compared by: a quantity that `drumrs quantities` lists, as it is over run.window or in a phase,
        `falls_per_turn[tumble]`, with an argument where it asks for one, `lacey_index(by='side')`, or an expression of
        several, `mean_drop / drum_specific_power`.
    greatest
        The greatest value is best; the least unless given.
    difference
        What counts as equal: a part of the best one's mean, "5 %", or an amount, "0.2 W/kg".
    most
        Runs at most, of all cases together.
    out
        Folder for table.parquet, differences.png and runs/.
    """
    import drumrs

    check_folder(out)
    again = next((case for k, case in enumerate(cases) if case in cases[:k]), None)
    if again is not None:
        raise ConfigError("CASE", again, "another file than the others", hint="it is given twice")
    names = [str(case) if _is_twice(case, cases) else case.stem for case in cases]
    designs = {name: layered(case, set_, None) for name, case in zip(names, cases, strict=True)}
    for name, config in designs.items():
        note(f"{name}: {config.title}")
    found = drumrs.compare(
        designs, by, out=out, greatest=greatest, difference=difference, most=most, jobs=jobs
    )
    _print(found)
    print_paths([out / name for name in ("table.parquet", "differences.png")])
    return 0


def _is_twice(case: Path, cases: tuple[Path, ...]) -> bool:
    return sum(other.stem == case.stem for other in cases) > 1


def _print(found: "Comparison") -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    shown = Table(box=None, highlight=False)
    for column in ("", found.target.label, "seeds", "behind the best", ""):
        shown.add_column(escape(column), justify="left" if not column else "right")
    for design in found.designs:
        own, behind = design.estimate.interval(), design.behind
        gap = "" if design is found.best else f"{behind.mean:.3g} ({behind.low:.3g} to {behind.high:.3g})"
        paired = ", seed by seed" if design.is_paired else ""
        shown.add_row(
            escape(design.name),
            f"{own.mean:.4g} ± {own.half_width:.2g}",
            str(design.seeds),
            gap,
            f"[{_STYLES[design.standing]}]{design.standing}[/]{paired}",
        )
    console = Console(highlight=False)
    console.print(shown)
    console.print(found.sentence, markup=False, soft_wrap=True)
