"""The study on one page of Markdown, for those who keep its results: findings, verdicts with their numbers, figures."""

from collections.abc import Iterator
from pathlib import Path

from drumrs.files import write_whole
from drumrs.pages import provenance
from drumrs.paper.data import StudyData
from drumrs.paper.report import facts, headline
from drumrs.paper.report.pictures import Picture
from drumrs.paper.verdict import FAILS, HOLDS, UNDECIDED, Verdict
from drumrs.progress import format_duration

_MARKS = {HOLDS: "", FAILS: "**No.** ", UNDECIDED: "*Open.* "}


def write(data: StudyData, drawn: list[Picture], path: str | Path) -> None:
    """Write the summary of a study.

    Parameters
    ----------
    data
        The finished study.
    drawn
        Its figures, which are linked as ``figures/….png``.
    path
        Markdown file.

    Raises
    ------
    OSError
        Where the file cannot be written.
    """
    lines = [*_opening(data), *_overview(data), *_claims(data), *_figures(drawn)]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _opening(data: StudyData) -> Iterator[str]:
    run = next(iter(data.configs.values())).run
    seeds = len({config.run.seed for config in data.configs.values()})
    told = facts.times(data)
    spent = float(data.sweep.facts(data.folder)["wall_time"].sum())
    yield f"# The paper's study, {data.scale} scale"
    yield ""
    yield (
        f"Written by `drumrs reproduce`: {told['runs finished']} runs of {run.duration:g} s, averaged over "
        f"{run.averaging_window[0]:g}–{run.averaging_window[1]:g} s, {seeds} seed{'s' if seeds > 1 else ''} a case; "
        f"{told['particle-steps']} particle-steps, which took {format_duration(spent / 2.0)} on two cores "
        f"({told.get('speed of one run', 'speed not known')} each). drumrs {provenance.versions()['drumrs']}."
    )
    yield ""
    yield from (f"- {sentence.text}" for sentence in headline.sentences(data))
    yield ""


def _overview(data: StudyData) -> Iterator[str]:
    yield "| verdict | claims |"
    yield "|---|---|"
    for outcome in headline.count_of_verdicts(data):
        claims = [verdict.claim for verdict in data.verdicts if verdict.verdict == outcome]
        yield f"| {outcome} | {', '.join(f'[{claim}](#{claim.lower()})' for claim in claims) or '–'} |"
    yield ""
    yield (
        "A claim is judged part by part; one part that fails decides. Values are means with half their 95 % interval. "
        "Open is what an interval reaches across, what lacks runs, and what only drifting loads would decide."
    )
    yield ""


def _claims(data: StudyData) -> Iterator[str]:
    for verdict in data.verdicts:
        yield from _claim(verdict)


def _claim(verdict: Verdict) -> Iterator[str]:
    yield f"## {verdict.claim}"
    yield ""
    yield f"{verdict.statement} **{verdict.verdict.capitalize()}.**"
    yield ""
    yield from (f"- {_MARKS[part.outcome]}{part.sentence}" for part in verdict.parts)
    yield ""
    yield f"Read as: {verdict.criterion}"
    yield ""


def _figures(drawn: list[Picture]) -> Iterator[str]:
    yield "## Figures"
    for picture in drawn:
        figure = picture.figure
        yield ""
        if picture.reason:
            yield f"{figure.number}, {figure.title}: not drawn. {picture.reason}"
            continue
        yield f"![{figure.title}](figures/{figure.number}.png)"
        yield ""
        # The paper's own figures have a number.
        number = f"{figure.number}. " if figure.number[1:].isdigit() else ""
        yield f"**{number}{figure.title}.** {figure.caption}"
