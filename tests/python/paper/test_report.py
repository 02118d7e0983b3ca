"""The report of a small study: it says what the table says, holds all it needs, and can be read in a browser."""

import json
import math
import re
from dataclasses import replace
from html import unescape
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import paper
from drumrs.pages import provenance
from drumrs.paper import FIGURES, report
from drumrs.paper.claims import EVIDENCE
from drumrs.paper.drums import BAFFLED
from drumrs.paper.report import Pictures, checks, facts, headline, page, pictures, table1
from drumrs.sweep import Failure, Sweep
from small_study import SMALL
from worlds import world


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """Return the data of a small study, half a minute of work for one core."""
    folder = tmp_path_factory.mktemp("study")
    sweep = Sweep.from_configs(paper.cases(SMALL))
    outcome = sweep.run(folder, progress=False)
    assert not outcome.failures
    return paper.StudyData(paper.measure(sweep, folder), sweep, folder, "quick", wall_time=75.0)


@pytest.fixture(scope="module")
def written(data, tmp_path_factory):
    """Return the report's file, and what was drawn."""
    folder = tmp_path_factory.mktemp("report")
    return folder / "report.html", report.write(data, folder / "report.html", folder / "figures")


@pytest.fixture(scope="module")
def text(written) -> str:
    """Return the report's words, tags and data left out."""
    return words(written[0].read_text(encoding="utf-8"))


def words(html: str) -> str:
    without = re.sub(r"<(script|style|template)\b.*?</\1>", "", html, flags=re.DOTALL)
    return " ".join(unescape(re.sub(r"<[^>]+>", " ", without)).split())


def test_every_claim_has_its_verdict_and_numbers(data, text):
    assert [verdict.claim for verdict in data.verdicts] == [f"C{k}" for k in range(1, 15)]
    for verdict in data.verdicts:
        assert f"{verdict.claim} {verdict.statement} {verdict.verdict}" in text
        assert " ".join(verdict.criterion.split()) in text
        for part in verdict.parts:
            assert " ".join(part.sentence.split()) in text
            assert all(number.text in part.sentence for number in part.numbers)
    for outcome, count in headline.count_of_verdicts(data.verdicts).items():
        assert count == sum(verdict.verdict == outcome for verdict in data.verdicts)


def test_every_claim_has_a_card_with_its_parts_and_its_curves(data, written):
    html = written[0].read_text(encoding="utf-8")
    cards = dict(re.findall(r'<li id="(C\d+)"(.*?)</details>', html, re.DOTALL))
    assert list(cards) == [verdict.claim for verdict in data.verdicts]
    for verdict in data.verdicts:
        card = cards[verdict.claim]
        assert re.search(r'<img class="thumbnail" src="data:image/png;base64,\w+', card)
        told = words(card.split("<details>")[0].partition(">")[2])
        for part in verdict.parts:
            assert " ".join([part.heading, *map(str, part.deciding)]) in told
        assert (f"Surely holds: {verdict.where}." in told) == bool(verdict.where)
        assert all(str(other) in told for other in verdict.others)
        assert ("Why." in told) == bool(verdict.why)
        assert (written[0].parent / "figures" / f"{verdict.claim}.png").is_file()


def test_a_range_and_a_reason_are_told():
    ratio = "gross_work_ratio"
    table = world().with_columns(
        pl.when(pl.col("load.fill") < 0.2).then(0.3).otherwise(pl.col(ratio)).alias(ratio),
        pl.when((pl.col("drum.baffles.count") > 0) & (pl.col("load.fill") > 0.6))
        .then(pl.col("drum_power") * 0.4)
        .otherwise(pl.col("drum_power"))
        .alias("drum_power"),
    )
    verdicts = {one.claim: one for one in paper.judge(table)}
    assert verdicts["C6"].where.startswith("about 1 below 40 % fill, from 20 % fill on")
    share = BAFFLED.baffles_share
    assert f"Baffles take {100.0 * share:.1f} % of the drum’s area" in verdicts["C2"].why
    assert f"{75.0 / (1.0 - share):.0f} % of what they leave free is full" in verdicts["C2"].why


def test_evidence_is_counted_apart(data):
    told = [replace(one, is_evidence=one.claim in EVIDENCE) for one in data.verdicts]
    sentence = headline._counted(told)
    assert "8 of them served as evidence for the shape of the lost baffle" in sentence
    assert "and of the other 6 " in sentence
    some = replace(data)
    object.__setattr__(some, "verdicts", told)
    html = page.render(some, Pictures())
    assert html.count('class="evidence"') == len(EVIDENCE)
    assert headline.EVIDENCE in words(html)
    none = replace(data)
    object.__setattr__(none, "verdicts", [replace(one, is_evidence=False) for one in told])
    assert headline.EVIDENCE not in words(page.render(none, Pictures()))
    assert "evidence" not in headline._counted(none.verdicts)


def test_softer_springs_are_shown_beside_stiff_ones(data):
    soft = data.table.with_columns(
        pl.col("contact.bundle.normal_stiffness") / 100.0, pl.col("drum_specific_power") * 0.97
    )
    # The curve that has more points is the one shown.
    more = soft.filter(pl.col("load.fill") == 0.25).with_columns(pl.lit(0.6).alias("load.fill"))
    some = replace(data, table=pl.concat([data.table, soft, more]))
    found = [(one.drum, one.fill, one.factor) for one in checks.softness(some)]
    bare, baffled = (
        [fill for drum, fill, _ in found if drum == name] for name in ("without baffles", "with baffles")
    )
    assert (bare, baffled) == (["25 %", "50 %", "75 %"], ["25 %", "50 %"])
    assert all(one.ratio.startswith("0.97") for one in checks.softness(some))
    assert {factor for _, _, factor in found} == {100.0}
    assert "Softer springs" in words(page.render(some, Pictures()))
    assert checks.softness(data) == []


def test_runs_with_softer_springs_are_told(data):
    assert headline.softer(data) == ""
    beside = replace(SMALL, duration=0.3, window=(0.2, 0.3), softer=100.0)
    both = replace(data, sweep=Sweep.from_configs(paper.cases(replace(SMALL, beside=beside))))
    count = len(data.sweep)
    told = f"; {count} of the runs, for power alone, are mostly of 0.3 s with springs softer by 100"
    assert headline.softer(both) == told


def test_the_headline_is_what_the_table_says(data, text):
    row = data.table.row(
        by_predicate=(pl.col("load.fill") == 0.25) & (pl.col("drum.baffles.count") == 0), named=True
    )
    line = next(line for line in headline.table(data) if line.quantity.name == "drum_power")
    shown = float(line.values[0].split(" ± ")[0])
    assert shown == pytest.approx(row["drum_power"], rel=0.01)
    assert f"drum power [W/m] {' '.join(line.values)}" in text
    # 75 % with baffles is no case of this study.
    assert line.values[-1] == "–"
    assert "Of the fills that were run, drum power is greatest at" in text


def test_sentences_without_their_cases_are_left_out(data):
    none = replace(data, table=data.table.filter(pl.col("drum.baffles.count") == 0))
    assert all("with baffles" not in sentence.text for sentence in headline.sentences(none))
    assert headline.sentences(replace(data, table=data.table.clear())) == []


def test_figures_are_drawn_and_those_that_cannot_be_say_why(written, text):
    path, drawn = written
    assert [one.figure.number for one in drawn.figures] == list(FIGURES)
    for one in drawn.figures:
        files = {
            (path.parent / "figures" / f"{one.figure.number}{ending}").exists() for ending in (".png", ".svg")
        }
        assert files == {bool(one.address)}
        assert one.figure.title in text
    missing = [one for one in drawn.figures if one.reason]
    assert [one.figure.number for one in missing] == ["F3", "states"]
    assert missing[0].reason in text
    assert "75 % fill with baffles" in missing[0].reason


def test_the_smaller_of_two_pictures_is_embedded(tmp_path):
    for name, size in (("a.svg", 900), ("a.png", 300)):
        (tmp_path / name).write_bytes(b"x" * size)
    paths = [tmp_path / "a.svg", tmp_path / "a.png"]
    assert pictures.embedded(paths) == f"data:image/png;base64,{'eHh4' * 100}"
    (tmp_path / "a.png").write_bytes(b"x" * 1000)
    assert pictures.embedded(paths).startswith("data:image/svg+xml;base64,")


def test_the_page_needs_nothing_else(written):
    html = written[0].read_text(encoding="utf-8")
    assert len(html) < 8e6
    assert set(re.findall(r'(?:src|href)="([^"]{5})', html)) <= {"data:"} | {
        target[:5] for target in re.findall(r'href="(#[^"]*)', html)
    }
    assert "http" not in re.sub(r"data:[^\"]*|<script type=\"application/json\">[^<]*", "", html)


def test_links_lead_somewhere(written):
    html = written[0].read_text(encoding="utf-8")
    targets = set(re.findall(r'href="#([^"]+)"', html))
    assert {"claims", "figures", "motion", "model", "checks", "provenance"} <= targets
    assert targets <= set(re.findall(r'id="([^"]+)"', html))


def test_players_show_the_papers_fill_without_and_with_baffles(written):
    html = written[0].read_text(encoding="utf-8")
    shown = [json.loads(data) for data in re.findall(r'<script type="application/json">(.*?)</script>', html)]
    assert [data["title"] for data in shown] == [
        f"100 bundles (25 % fill), {baffles} baffles, 54 rpm, seed 1" for baffles in ("no", "3")
    ]
    assert 'start="0.2"' in html


def test_table_1_is_repaired_by_its_own_formulas(text):
    bundle, drum = table1.contacts(drumrs.baseline())
    for contact in (bundle, drum):
        assert contact.damping == pytest.approx(table1.SCANNED_DAMPING[contact.name], rel=2e-3)
        assert contact.repaired_restitution == pytest.approx(0.1, abs=5e-4)
    assert bundle.scanned_restitution == pytest.approx(0.83, abs=0.005)
    assert bundle.scanned_steps == pytest.approx(4.2, abs=0.1)
    assert "a collision of 4 time steps" in text
    assert "restitution of 0.83" in text
    assert "bundle–bundle k N 9.25·10⁹ N/m 9.25·10⁷ N/m" in text


def test_baffles_take_the_area_that_they_have_in_the_core():
    frames = drumrs.Simulation(drumrs.baseline(fill=0.1, baffles=True)).frames
    radius = frames.drum_radius
    covered = 0.0
    for line in frames.baffles:
        x, y = np.asarray(line).T
        covered += abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2.0
        angle = 2.0 * math.asin(BAFFLED.config().drum.baffles.base / 2.0 / radius)
        covered += radius**2 * (angle - math.sin(angle)) / 2.0
    assert BAFFLED.baffles_share == pytest.approx(covered / (math.pi * radius**2))


def test_balance_is_that_of_the_worst_run(data, text):
    listed = checks.runs(data)
    assert len(listed) == data.table.height == len(data.sweep)
    worst = max(listed, key=lambda run: run.residual)
    assert worst.residual == data.table["energy_residual"].abs().max()
    assert f"residual of the ledger is {table1.scientific(worst.residual)} (run {worst.name})" in text
    other = max(listed, key=lambda run: run.disagreement)
    assert other.disagreement == data.table["power_disagreement"].abs().max()
    assert "Windows of 0.2 s show quick changes only." in text


def test_drifting_runs_are_named(data):
    drifting = data.table.with_columns(
        pl.Series("drifting", [True] + [False] * (data.table.height - 1)),
        drift=pl.lit(0.25),
        drift_significance=pl.lit(1e-6),
        share_drift_significance=pl.lit(0.5),
        share_drift=pl.lit(0.01),
        share_switching=pl.lit(None, pl.Float64),
        share_switching_significance=pl.lit(None, pl.Float64),
    )
    some = replace(data, table=drifting)
    runs = [run for run in checks.runs(some) if run.drifting]
    assert [run.reasons for run in runs] == ["power changes by +25%"]
    told = words(page.render(some, Pictures()))
    assert f"1 of {data.table.height} runs drift in their window" in told
    assert "power changes by +25%" in told


def test_failures_are_told_at_the_top_and_escaped(data):
    case = data.sweep.cases[0]
    failed = replace(data, failures=(Failure(case, "UnstableError", "overlap <b> of bundle 3 & more"),))
    html = page.render(failed, Pictures())
    assert "overlap &lt;b&gt; of bundle 3 &amp; more" in html
    assert "1 case failed." in words(html)
    assert "None." in words(page.render(data, Pictures()))


def test_nothing_finished_still_gives_a_report(data):
    nothing = replace(data, table=data.table.clear())
    html = words(page.render(nothing, Pictures()))
    assert "No run is finished." in html
    assert "14 claims undecided" in html
    assert "See it move" not in html


def test_provenance_names_versions_and_times(data, text):
    for name, value in provenance.versions().items():
        assert f"{name} {value}" in text
    assert facts.times(data)["time of the last call"] == "1 min 15 s"
    assert f"runs finished {data.table.height} of {len(data.sweep)}" in text


def test_citation_is_that_of_the_repository(text):
    cited = (Path(__file__).parents[3] / "CITATION.cff").read_text(encoding="utf-8")
    for title in re.findall(r'^ *title: "(.*)"$', cited, re.MULTILINE) or [""]:
        assert title in text
    assert f"version: {drumrs.__version__}\n" in cited
    assert re.search(r'- name: "(.*)"', cited).group(1) == facts.AUTHORS


@pytest.fixture
def opened(browser, written):
    """Open the report in a browser; at the end nothing may have been asked for or complained about."""
    path = written[0]
    troubles = []
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    shown = context.new_page()
    shown.on("console", lambda message: troubles.append(message.text))
    shown.on("pageerror", lambda error: troubles.append(str(error)))
    shown.on(
        "request",
        lambda request: request.url.startswith(("data:", path.as_uri())) or troubles.append(request.url),
    )
    shown.goto(path.as_uri())
    yield shown
    context.close()
    assert troubles == []


def test_a_browser_shows_pictures_and_plays(opened):
    broken = "[...document.images].filter(image => !image.naturalWidth).length"
    assert opened.evaluate(broken) == 0
    assert opened.evaluate("document.images.length") == len(FIGURES) - 2 + len(paper.CLAIMS)
    players = opened.locator("drumrs-player")
    assert players.count() == 2
    # Style of the page must not reach into the player, nor be taken from it.
    assert opened.evaluate("getComputedStyle(document.body).fontFamily").startswith("system-ui")
    players.nth(1).locator(".forward").click()
    assert players.nth(1).locator(".time").inner_text() == "0.24 s"
    assert players.nth(0).locator(".time").inner_text() == "0.20 s"


def test_a_claim_unfolds(opened):
    claim = opened.locator("#C4")
    assert not claim.locator(".criterion").is_visible()
    claim.locator("summary").click()
    assert claim.locator(".criterion").is_visible()


@pytest.mark.parametrize("width", [360, 800, 1280])
def test_no_page_is_wider_than_its_window(opened, width):
    opened.set_viewport_size({"width": width, "height": 800})
    opened.evaluate("document.querySelectorAll('details').forEach(one => one.open = true)")
    assert opened.evaluate("document.documentElement.scrollWidth") == width


def test_print_leaves_out_what_paper_cannot_do(opened):
    assert opened.locator("nav").is_visible()
    opened.emulate_media(media="print")
    assert not opened.locator("nav").is_visible()
    assert not opened.locator("#motion").is_visible()
