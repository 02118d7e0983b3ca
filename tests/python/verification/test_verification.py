"""The verification: quick cases pass, wrong laws and numbers make them fail, and its page needs nothing else."""

import json
import math
import re
from dataclasses import replace

import pytest

import drumrs
from drumrs.verification import FAMILIES, Check, Evidence, Panel, Trace, Trial, Verification, catalog, scenes

CASES = {case.name: case for family in FAMILIES.values() for case in family}
# Of these the dearest takes a second.
QUICK = [name for name, case in CASES.items() if case.cost <= 3e6]
PANEL = Panel("x", "y", (Trace("", [1.0], [1.0], ([0.0, 1.0], [0.0, 1.0])),))


@pytest.fixture(scope="module")
def found():
    """Return the verification by the quick cases."""
    return drumrs.verify(QUICK, progress=False)


def test_quick_cases_pass(found):
    assert [(trial.case.name, trial.evidence.worst) for trial in found.failures] == []
    assert len(found.trials) == len(QUICK) > 20
    assert found.passed


def test_every_case_says_what_it_is():
    assert len(CASES) == sum(map(len, FAMILIES.values())), "a name twice"
    for case in CASES.values():
        assert case.title
        assert case.source
        assert case.formula
        assert len(case.tolerance) > 10, case.name


@pytest.mark.parametrize("wrong", ["beyond", "nan", "infinite"])
def test_one_wrong_number_fails_a_case(found, wrong):
    for trial in found.trials:
        checks = list(trial.evidence.checks)
        for k in (0, len(checks) // 2, -1):
            check = checks[k]
            beyond = check.expected + 1.001 * check.tolerance + math.ulp(check.expected)
            measured = {"beyond": beyond, "nan": math.nan, "infinite": -math.inf}[wrong]
            fed = [*checks]
            fed[k] = replace(check, measured=measured)
            assert not replace(trial, evidence=Evidence(tuple(fed), PANEL)).passed, check
            assert Evidence(tuple(fed), PANEL).worst.ratio > 1.0


def test_no_number_proves_nothing():
    assert not Evidence((), PANEL).passed


WRONG_LAWS = {
    "stiffness": (
        {"contact.bundle.normal_stiffness": 1.01, "contact.drum.normal_stiffness": 1.01},
        ["contact-duration", "two-bodies-head-on", "wall-head-on", "stack"],
    ),
    "friction": (
        {"contact.bundle.friction": 1.02, "contact.drum.friction": 1.02},
        [
            "sliding-impact-clipped",
            "sliding-impact-tension",
            "oblique-impact",
            "tangential-speeds",
            "spins",
            "equal-bodies",
            "unequal-bodies",
            "slip-to-roll",
            "incline",
            "spin-locked-disc",
        ],
    ),
    "damping": ({"contact.drum.normal_damping": 1.02}, ["restitution-tension", "restitution-clipped"]),
    "restitution": (
        {"contact.bundle.restitution": 0.98, "contact.drum.restitution": 0.98},
        ["restitution-sweep", "normal-dissipation", "restitution-order"],
    ),
    "tangential stiffness": ({"contact.drum.stiffness_ratio": 1.01}, ["equal-periods", "stuck-swing"]),
    "rolling friction": (
        {"contact.drum.rolling_friction": 1.02},
        ["rolling-stop", "rolling-incline", "rolling-in-a-drum", "pressed-by-adhesion"],
    ),
    "tangential damping": (
        {"contact.bundle.tangential_damping_ratio": 1.02, "contact.drum.tangential_damping_ratio": 1.02},
        ["tangential-decrement", "tangential-restitution"],
    ),
    "adhesion": (
        {"contact.drum.adhesion": 1.02},
        ["hanging", "over-the-top", "adhesive-impact", "capture", "pressed-by-adhesion"],
    ),
    "modulus": ({"contact.drum.young_modulus": 1.01}, ["hertz-impact"]),
    "restitution of spheres": ({"contact.drum.restitution": 0.98}, ["hertz-restitution"]),
    "speed": ({"rotation.rpm": 1.001}, ["free-disc"]),
}


@pytest.mark.parametrize("law", WRONG_LAWS)
def test_a_wrong_law_fails_the_cases_that_look_at_it(law, monkeypatch):
    factors, names = WRONG_LAWS[law]
    after = scenes.after

    def wrongly(config, *arguments, **options):
        for key, factor in factors.items():
            value = config
            for part in key.split("."):
                value = getattr(value, part)
            if value is not None:
                config = config.replace({key: factor * value})
        return after(config, *arguments, **options)

    monkeypatch.setattr(scenes, "after", wrongly)
    passed = [name for name in names if CASES[name].run().passed]
    assert passed == []


def test_what_cannot_be_simulated_fails(monkeypatch):
    def refuse(*_, **__):
        raise drumrs.UnstableError("bundle 7 left the drum")

    monkeypatch.setattr(scenes, "after", refuse)
    trial = CASES["stack"].run()
    assert not trial.passed
    assert trial.error == "bundle 7 left the drum"
    found = Verification((trial,), 0.1, 1)
    assert found.table["error"].to_list() == ["bundle 7 left the drum"]
    assert json.loads(found.to_json())["cases"][0]["measured"] is None


def test_table_and_json_agree(found):
    table, told = found.table, json.loads(found.to_json())
    assert table["case"].to_list() == [case["case"] for case in told["cases"]] == QUICK
    assert told["passed"] is True
    for row, case in zip(table.iter_rows(named=True), told["cases"], strict=True):
        assert row["checks"] == len(case["checks"])
        assert abs(row["measured"] - row["expected"]) <= row["tolerance"]


def failing(monkeypatch, name: str) -> None:
    """Let a case find a wrong number."""
    evidence = Evidence((Check("speed", "m/s", 1.0, 2.0, 0.1),), PANEL)
    broken = replace(CASES[name], examine=lambda: evidence)
    families = {
        family: tuple(broken if case.name == name else case for case in cases)
        for family, cases in FAMILIES.items()
    }
    monkeypatch.setattr(catalog, "FAMILIES", families)


def test_command_passes(drum):
    status, out, _ = drum("verify", "--only", "stack", "--only", "conservation")
    assert status == 0
    assert re.search(r"stack +statics .* passed", out)
    assert re.search(r"tolerance +unit +verdict", out)
    assert "2 of 2 cases passed" in out


def test_command_fails_with_status_1(drum, monkeypatch):
    failing(monkeypatch, "stack")
    status, out, _ = drum("verify", "--only", "stack")
    assert status == 1
    assert re.search(r"0\.1 +m/s +failed", out)
    assert "stack failed: 1 of 1 numbers, worst the speed: 2 m/s, expected 1 ± 0.1" in out


def test_command_prints_json(drum):
    status, out, _ = drum("verify", "--only", "stack", "--json")
    assert status == 0
    assert len(json.loads(out)["cases"][0]["checks"]) == 8


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--only", "nothing"], "only is 'nothing', but must be one of restitution-tension,"),
        (["--jobs", "0"], "jobs is 0, but must be"),
        (["--html", "."], "--html is '.', but must be a file"),
        (["--html", "file/page.html"], "--html is 'file', but must be a folder"),
    ],
)
def test_bad_input_has_status_2_and_writes_nothing(drum, tmp_path, monkeypatch, words, sentence):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("")
    status, out, err = drum("verify", *words)
    assert (status, out) == (2, "")
    assert err.startswith(f"drumrs: {sentence}")
    assert err.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.fixture(scope="module")
def page(found, tmp_path_factory):
    """Return a page with a case that failed, and one that could not be run."""
    trials = list(found.trials)
    trials[0] = replace(trials[0], evidence=Evidence((Check("a < b", "1", 0.0, 1.0, 0.0),), PANEL))
    trials[1] = Trial(trials[1].case, None, 0.1, "bundle 7 <left> the drum")
    return Verification(tuple(trials), 75.0, 2).save(tmp_path_factory.mktemp("page") / "page.html")


def test_page_tells_all(page, found):
    text = page.read_text(encoding="utf-8")
    assert "bundle 7 &lt;left&gt; the drum" in text
    assert "a &lt; b" in text
    assert "75 s, " in text
    for trial in found.trials:
        assert f'id="{trial.case.name}"' in text
    assert text.count("data:image/svg+xml") == len(QUICK) - 1
    # A table comes before all pictures.
    assert text.index('class="summary"') < text.index("data:image")


def test_page_needs_nothing_else(page, browser):
    troubles = []
    context = browser.new_context(viewport={"width": 390, "height": 800})
    shown = context.new_page()
    shown.on("console", lambda message: troubles.append(message.text))
    shown.on(
        "request",
        lambda request: request.url.startswith(("data:", page.as_uri())) or troubles.append(request.url),
    )
    shown.goto(page.as_uri())
    broken = "[...document.images].filter(image => !image.naturalWidth).length"
    assert shown.evaluate(broken) == 0
    for width in (390, 1280):
        shown.set_viewport_size({"width": width, "height": 800})
        shown.evaluate("document.querySelectorAll('details').forEach(one => one.open = true)")
        assert shown.evaluate("document.documentElement.scrollWidth") == width
    context.close()
    assert troubles == []
    assert not re.search(r"""(?:src|href)=["']?(?:https?:)?//""", page.read_text(encoding="utf-8"))
