"""The page of a validation, in Markdown: of each drum what is said of it, its numbers beside ours, and its figure."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.files import write_whole
from drumrs.pages import provenance, text_of
from drumrs.progress import format_duration
from drumrs.validation.check import AGREES, DIFFERS, NOTHING, UNDECIDED, Check

if TYPE_CHECKING:
    from drumrs.validation.drum import PublishedDrum
    from drumrs.validation.results import Results


# Stands in what is said of a drum where the numbers go.
_COMPARISON = "{comparison}"


def write(
    drums: "Sequence[PublishedDrum]", checks: Mapping[str, Sequence[Check]], results: "Results", path: Path
) -> None:
    """Write the page.

    Parameters
    ----------
    drums
        The drums, in their order.
    checks
        Comparisons by the drum's name; a drum without has a case that failed.
    results
        The finished cases.
    path
        File of the page; figures are linked as ``figures/NAME.png``.

    Raises
    ------
    OSError
        Where the file cannot be written.
    """
    lines = [*_opening(checks, results)]
    for drum in drums:
        lines += _drum(drum, checks.get(drum.name))
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _opening(checks: Mapping[str, Sequence[Check]], results: "Results") -> Iterator[str]:
    facts = results.sweep.facts(results.folder)
    cost = sum(case.cost for case in results.sweep.cases)
    yield "# Published drums"
    yield ""
    yield (
        f"Written by `drumrs validate`: {len(facts)} runs, {cost:.2g} particle-steps, "
        f"{format_duration(float(facts['wall_time'].sum()))} of running time. "
        f"drumrs {provenance.versions()['drumrs']}. [table.parquet](table.parquet) has one row a run."
    )
    yield ""
    yield (
        "Drums of others, simulated anew. Values are means over two random starts or more, with half their 95 % "
        "interval. A number *agrees* where that interval lies within what the tolerance allows, *differs* where it is "
        "outside, and is *undecided* across its edge. Numbers without a tolerance are shown, not judged. Nothing was "
        "fitted."
    )
    yield ""
    yield "Of what is published:"
    yield ""
    yield "| drum | agrees | differs | undecided |"
    yield "|---|---|---|---|"
    for name, found in checks.items():
        verdicts = [check.verdict for check in found if check.published != NOTHING]
        counts = [verdicts.count(verdict) for verdict in (AGREES, DIFFERS, UNDECIDED)]
        yield f"| [{name}](#{name}) | {' | '.join(map(str, counts))} |"
    yield ""


def _drum(drum: "PublishedDrum", checks: Sequence[Check] | None) -> Iterator[str]:
    yield f"## {drum.name}"
    yield ""
    said = text_of("drumrs.validation", f"{drum.name}.md")
    yield said.replace(
        _COMPARISON, "\n".join(_comparison(drum, checks)) if checks else "Not compared: a run failed."
    )


def _comparison(drum: "PublishedDrum", checks: Sequence[Check]) -> Iterator[str]:
    yield "| | published | simulated | agrees within | |"
    yield "|---|---|---|---|---|"
    for check in checks:
        verdict = f"**{check.verdict}**" if check.verdict == DIFFERS else check.verdict
        words = (check.quantity, check.published, check.measured_text, check.tolerated_text, verdict)
        yield f"| {' | '.join(words)} |"
    yield ""
    yield f"![The numbers of {drum.name} beside ours](figures/{drum.name}.png)"
