"""Pages of a run, one for each trade: whole with and without records, one file, right numbers, readable."""

import math
import re
from html import unescape
from itertools import pairwise

import pytest

import drumrs
from drumrs.analysis import rate_with_error
from drumrs.measures import flights, hogg_fuerstenau, morrell
from drumrs.reports import PAGES, catalog, content, power
from drumrs.reports.page import render
from drumrs.reports.run_data import RunData

RECORDS = ("contacts", "wall_profile", "ledger_split", "discs")
SHORT = {"run.duration": 1.2, "run.window": (0.4, 1.2), "run.frame_every": 0.02}
TO_AND_FRO = [
    {"name": "start", "duration": 0.45, "ramp": (20.0, 54.0)},
    {"name": "tumble", "duration": 0.4, "rpm": 54.0},
    {"name": "rest", "duration": 0.15, "rpm": 0.0},
    {"name": "back", "duration": 0.2, "rpm": -54.0},
]


def run(**keys) -> drumrs.Result:
    config = drumrs.baseline(fill=0.2, baffles=True).softer(100.0)
    return drumrs.run(config.replace({**SHORT, **keys}), progress=False)


@pytest.fixture(scope="module")
def plain() -> drumrs.Result:
    return run()


@pytest.fixture(scope="module")
def recorded() -> drumrs.Result:
    return run(**{"run.record": RECORDS})


@pytest.fixture(scope="module")
def program() -> drumrs.Result:
    return run(**{"rotation.phase": TO_AND_FRO})


@pytest.fixture(scope="module")
def pages(recorded) -> dict[str, str]:
    """Return each page of the run of which all is recorded."""
    return {name: rendered(recorded, name) for name in PAGES}


_RENDERED: dict[tuple[int, str], str] = {}


def rendered(result: drumrs.Result, page: str) -> str:
    """Return a page of one of the runs above, made once."""
    key = (id(result), page)
    if key not in _RENDERED:
        _RENDERED[key] = render(result, page)
    return _RENDERED[key]


def words(html: str) -> str:
    without = re.sub(r"<(script|style|template|pre)\b.*?</\1>", "", html, flags=re.DOTALL)
    return " ".join(unescape(re.sub(r"<[^>]+>", " ", without)).split())


def section(html: str, anchor: str) -> str:
    return words(re.search(rf'<section id="{anchor}">(.*?)</section>', html, re.DOTALL)[1])


@pytest.mark.parametrize("name", PAGES)
def test_a_page_has_its_question_its_sections_and_its_limits(name, pages):
    html, told = pages[name], words(pages[name])
    assert PAGES[name].question in told
    assert re.findall(r'<section id="([\w-]+)">', html) == [
        *(one.anchor for one in PAGES[name].sections if one.anchor != "phases"),
        "limits",
        "provenance",
    ]
    assert all(sentence in told for sentence in PAGES[name].all_limits)
    assert html.count("<drumrs-player ") == 1
    assert "Every joule is accounted for" in told


@pytest.mark.parametrize("name", PAGES)
def test_a_page_lacks_nothing_where_all_is_recorded(name, pages):
    assert "not shown" not in pages[name]
    assert "Not drawn" not in pages[name]


def test_a_page_says_which_record_to_add_and_is_whole_without(plain):
    html = rendered(plain, "research")
    lacking = re.findall(r"not shown: (.*?)\.</p>", unescape(html), re.DOTALL)
    for record in RECORDS:
        assert any(f"add '{record}' to it and run again" in one for one in lacking)
    assert "Every joule is accounted for" in section(html, "ledger")
    # What the window tells does not need the record.
    assert "knocking [W/kg]" in section(html, "handling")


def test_research_has_every_section():
    sections = {one for page in PAGES.values() for one in page.sections}
    missing = sections - set(PAGES["research"].sections)
    assert {one.anchor for one in missing} == {"models"}


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_one_file(name, pages):
    html = pages[name]
    assert set(re.findall(r'(?:src|href)="([^"]{5})', html)) <= {"data:"} | {
        target[:5] for target in re.findall(r'href="(#[^"]*)', html)
    }
    assert "http" not in re.sub(r"data:[^\"]*|<script type=\"application/json\">[^<]*", "", html)
    targets = set(re.findall(r'href="#([^"]+)"', html))
    names = re.findall(r' id="([^"]+)"', html)
    assert targets <= set(names)
    assert len(names) == len(set(names))


def test_power_is_that_of_the_summary(recorded, pages):
    summary = recorded.summary
    shown = content.value(summary.drum_specific_power, summary.drum_specific_power_error)
    assert f"drum specific power [W/kg] {shown} power of the drum" in section(pages["washer"], "power")
    data = RunData(recorded)
    knocking = rate_with_error(recorded.series, "dissipated_normal", data.window)
    assert knocking.value == pytest.approx(summary.dissipated_normal_power)
    told = content.value(knocking.value / data.mass, knocking.error and knocking.error / data.mass)
    assert f"all {told} " in section(pages["washer"], "handling")


def test_models_are_asked_for_this_mill(recorded, pages):
    config, data = recorded.config, RunData(recorded)
    radius, speed = config.drum.diameter / 2.0, config.derived.angular_velocity
    filling = config.fill / 0.82
    model = morrell.charge(filling, speed * math.sqrt(radius / 9.81))
    flat = hogg_fuerstenau.arm(filling, data.charge["surface_slope"].value)
    scale = data.mass * 9.81 * radius * speed
    told = section(pages["mill"], "models")
    powers = " ".join(content.value(arm * scale / 1e3) for arm in (model.arm, flat))
    assert f" {powers} arm" in told
    assert f" {content.value(math.degrees(model.toe))} – shoulder" in told
    own = recorded.summary.drum_power / scale
    assert f"arm: power over M g R Ω {content.value(own).split(' ')[0][:5]}" in told
    angle = math.degrees(hogg_fuerstenau.lift_angle(filling, own))
    assert f"at a lift angle of α = {angle:.1f}°" in told


def test_models_of_mills_need_one_speed(program):
    told = section(rendered(program, "mill"), "models")
    assert (
        "not shown: rotation lets the drum rest or change its speed, but models of mills are of one speed."
        in told
    )


def test_the_charge_is_told_for_either_way(program):
    told = section(rendered(program, "mill"), "shape")
    assert told.count("toe angle") == 2
    assert "The same while the drum turns the other way, t = " in told


def test_records_add_up(pages):
    told = section(pages["research"], "ledger")
    for record in ("contacts", "ledger_split", "discs"):
        off = re.search(rf"{record} (?:0(?= )|−?\d(?:\.\d)?·10⁻¹(\S))", told)
        assert off, told
        assert off[1] is None or off[1] in "³⁴⁵⁶⁷⁸⁹"


def test_energy_is_split_by_kind_of_part(pages):
    told = section(pages["mill"], "split")
    assert "bundle – baffle " in told
    assert "baffle 1" not in told
    shares = [float(one) for one in re.findall(r"\d+\.\d\d\b", told)]
    assert sum(shares) == pytest.approx(100.0, abs=0.1)


def test_motion_is_measured_at_one_speed(program, plain):
    assert RunData(plain).span == (0.4, 1.2)
    assert RunData(program).span == pytest.approx((0.45, 0.85))
    html = rendered(program, "washer")
    assert "motion is measured over its longest stretch at one speed, t = 0.45–0.85 s" in words(html)
    falls = flights(program.frames, (0.45, 0.85)).filter("is_fall").height
    assert f"energy of {falls} falls, by the angle" in html


def test_phases_have_a_row_each(program):
    rows = re.search(r'<section id="phases">(.*?)</section>', rendered(program, "washer"), re.DOTALL)[1]
    names = re.findall(r'<th scope="row">(\w+ \d)</th>', rows)
    assert names == ["start 1", "tumble 1", "rest 1", "back 1"]
    back = drumrs.phases(program).row(3, named=True)
    shown = content.value(back["drum_specific_power"], back["drum_specific_power_error"])
    assert f"<td>1–1.2</td><td>{shown}</td>" in rows


def test_nothing_slips_in_a_drum_that_rests(program):
    data = RunData(program)
    assert power._in_phase(data, (0.45, 0.85))[2] != "–"
    # It turns at the beginning, then rests.
    assert power._in_phase(data, (0.7, 1.0))[2] == "–"


def test_a_drum_without_a_rim_still_has_a_page():
    square = [[0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2], [0.2, -0.2]]
    shell = {"drum.rim": False, "drum.baffles.count": 0, "drum.liner.outlines": [{"points": square}]}
    told = words(render(run(**shell), "research"))
    assert "not shown: drum.rim is False, but must be true" in told
    assert "Every joule is accounted for" in told


def test_visits_are_told_as_they_were_counted():
    zone = {"name": "right", "corners": [[0.0, -0.3], [0.3, -0.3], [0.3, 0.3], [0.0, 0.3]]}
    result = run(**{"run.zone": [zone], "run.duration": 3.0, "run.window": (1.0, 3.0)})
    told, table = section(render(result, "coater"), "visits"), result.zone_visits
    rate = 60.0 * table["entries"].mean() / (RunData(result).duration - 1.0)
    assert f"visits of a disc in a minute {content.value(rate)} " in told
    inside = table["time_inside"].to_numpy()
    spread = 100.0 * inside.std(ddof=1) / inside.mean()
    assert f"after 2 s, counted [%] {content.value(spread)} " in told
    assert (
        f"after a minute, by one over the root of the time [%] {content.value(spread * math.sqrt(2.0 / 60.0))[:3]}"
        in told
    )


def test_a_picture_that_fails_is_told(recorded, monkeypatch):
    def broken(*_, **__):
        raise ValueError("no font <here>")

    monkeypatch.setattr("drumrs.figures.landing_rose", broken)
    with pytest.warns(drumrs.errors.PictureWarning, match="no font"):
        html = render(recorded, "washer")
    assert "Not drawn: ValueError: no font &lt;here&gt;." in html


@pytest.mark.parametrize(
    ("number", "error", "shown"),
    [(0.0, None, "0"), (-2.5, 0.5, "−2.50 ± 0.50"), (-3.2e-7, None, "−3.2·10⁻⁷"), (math.nan, None, "–")],
)
def test_numbers_are_written_as_people_write_them(number, error, shown):
    assert content.value(number, error) == shown


def test_report_writes_a_file_of_drumrs(plain, tmp_path, monkeypatch):
    monkeypatch.setattr("drumrs.reports.page.render", rendered)
    path = drumrs.report(plain, page="dryer", folder=tmp_path)
    assert path == tmp_path / "report.html"
    assert drumrs.report(plain, folder=tmp_path) == path
    assert catalog.PAGES["research"].question in path.read_text(encoding="utf-8")
    named = drumrs.report(plain, page="dryer", folder=tmp_path / "named.html")
    assert named.is_file()
    (tmp_path / "report.html").write_text("notes", encoding="utf-8")
    with pytest.raises(drumrs.ConfigError, match="another's, and is not overwritten"):
        drumrs.report(plain, folder=tmp_path)
    with pytest.raises(drumrs.ConfigError, match="page is 'kiln', but must be one of washer, dryer, mill"):
        drumrs.report(plain, page="kiln", folder=tmp_path)


def test_the_command_reads_a_folder(recorded, drum, tmp_path):
    drumrs.save(recorded, tmp_path / "run", pictures=False)
    status, printed, _ = drum("report", tmp_path / "run", "--page", "mill")
    assert (status, printed) == (0, f"wrote {tmp_path / 'run' / 'report.html'}\n")
    status, _, _ = drum("report", tmp_path / "run", "--out", tmp_path / "all.html")
    assert status == 0
    assert "All that is measured of a run" in (tmp_path / "all.html").read_text(encoding="utf-8")
    for bad, told in (
        (("--page", "kiln"), "--page is 'kiln', but must be one of"),
        (("--out", tmp_path / "all.txt"), "must be a file whose name ends in .html"),
    ):
        status, _, error = drum("report", tmp_path / "run", *bad)
        assert (status, told in error) == (2, True), error
    status, _, error = drum("report", tmp_path)
    assert (status, "must be the folder of a finished run" in error) == (2, True)


@pytest.fixture
def opened(browser, pages, tmp_path):
    """Open the research page in a browser; at the end nothing may have been asked for or complained about."""
    path = tmp_path / "report.html"
    path.write_text(pages["research"], encoding="utf-8")
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


def test_a_browser_shows_pictures_and_the_player(opened):
    broken = "[...document.images].filter(image => !image.naturalWidth || !image.alt).length"
    assert opened.evaluate(broken) == 0
    assert opened.evaluate("document.images.length") >= 8
    player = opened.locator("drumrs-player")
    assert player.locator(".time").inner_text() == "0.40 s"
    player.locator(".forward").click()
    assert player.locator(".time").inner_text() == "0.42 s"
    levels = opened.evaluate("[...document.querySelectorAll('h1, h2, h3')].map(one => +one.tagName[1])")
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


@pytest.mark.parametrize("width", [360, 800, 1280])
def test_no_page_is_wider_than_its_window(opened, width):
    opened.set_viewport_size({"width": width, "height": 800})
    opened.evaluate("document.querySelectorAll('details').forEach(one => one.open = true)")
    assert opened.evaluate("document.documentElement.scrollWidth") == width
