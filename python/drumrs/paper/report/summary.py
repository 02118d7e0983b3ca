"""The study on one page of Markdown, for those who keep its results: findings, verdicts with their numbers, figures."""

from collections.abc import Container, Iterable, Iterator, Sequence
from pathlib import Path

from drumrs.files import write_whole
from drumrs.pages import provenance
from drumrs.paper.data import StudyData
from drumrs.paper.report import facts, headline
from drumrs.paper.report.pictures import Picture
from drumrs.paper.verdict import FAILS, HOLDS, IN_PART, OUTCOMES, UNDECIDED, Verdict
from drumrs.progress import format_duration

_MARKS = {HOLDS: "Yes.", IN_PART: "**In part.**", FAILS: "**No.**", UNDECIDED: "*Open.*"}


def write(data: StudyData, drawn: Sequence[Picture], thumbnails: Container[str], path: str | Path) -> None:
    """Write the summary of a study.

    Parameters
    ----------
    data
        The finished study.
    drawn
        Its figures, which are linked as ``figures/….png``.
    thumbnails
        Claims of which there is a picture, linked in the same way.
    path
        Markdown file.

    Raises
    ------
    OSError
        Where the file cannot be written.
    """
    lines = [*_opening(data), *_overview(data), *_claims(data, thumbnails), *_figures(drawn)]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _opening(data: StudyData) -> Iterator[str]:
    run = next(iter(data.configs.values())).run
    seeds = headline.seeds(data)
    told = facts.times(data)
    spent = float(data.sweep.facts(data.folder)["wall_time"].sum())
    yield f"# The paper's study, {data.scale} scale"
    yield ""
    yield " ".join(headline.takeaway(data))
    yield ""
    yield (
        f"Written by `drumrs reproduce`: {told['runs finished']} runs of {run.duration:g} s, averaged over "
        f"{run.averaging_window[0]:g}–{run.averaging_window[1]:g} s, {seeds} seed{'s' if seeds > 1 else ''} "
        f"a case{headline.more_seeds(data)}{headline.softer(data)}; "
        f"{told['particle-steps']} particle-steps, which took {format_duration(spent / 2.0)} on two cores "
        f"({told.get('speed of one run', 'speed not known')} each). drumrs {provenance.versions()['drumrs']}."
    )
    yield ""
    yield from (f"- {sentence.text}" for sentence in headline.sentences(data))
    yield ""


def _overview(data: StudyData) -> Iterator[str]:
    evidence = any(verdict.is_evidence for verdict in data.verdicts)
    yield f"| verdict | claims |{' evidence for the baffle |' if evidence else ''}"
    yield f"|---|---|{'---|' if evidence else ''}"
    for outcome in OUTCOMES:
        found = [verdict for verdict in data.verdicts if verdict.verdict == outcome]
        cells = [_links(one for one in found if not one.is_evidence)]
        cells += [_links(one for one in found if one.is_evidence)] if evidence else []
        yield f"| {outcome} | {' | '.join(cells)} |"
    yield ""
    yield headline.HOW_JUDGED
    if evidence:
        yield ""
        yield headline.EVIDENCE
    yield ""


def _links(verdicts: Iterable[Verdict]) -> str:
    return ", ".join(f"[{one.claim}](#{one.claim.lower()})" for one in verdicts) or "–"


def _claims(data: StudyData, thumbnails: Container[str]) -> Iterator[str]:
    for verdict in data.verdicts:
        yield from _claim(verdict, thumbnails)


def _claim(verdict: Verdict, thumbnails: Container[str]) -> Iterator[str]:
    yield f"## {verdict.claim}"
    yield ""
    where = f" Surely holds: {verdict.where}." if verdict.where else ""
    yield f"{verdict.statement} **{verdict.verdict.capitalize()}.**{where}{_evidence(verdict)}"
    yield ""
    for part in verdict.parts:
        yield f"- {_MARKS[part.verdict]} {part.heading}. {part.sentence}"
    yield ""
    if verdict.claim in thumbnails:
        yield f"![Curves of {verdict.claim}](figures/{verdict.claim}.png)"
        yield ""
    if verdict.others:
        yield f"Otherwise read: {'; '.join(map(str, verdict.others))}."
        yield ""
    if verdict.why:
        yield f"Why: {verdict.why}"
        yield ""
    yield f"Read as: {verdict.criterion}"
    yield ""


def _evidence(verdict: Verdict) -> str:
    return " Evidence for the baffle." if verdict.is_evidence else ""


def _figures(drawn: Sequence[Picture]) -> Iterator[str]:
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
