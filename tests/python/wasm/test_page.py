"""The drum of the site's first page, which runs in the page: in a browser, from disk, as people meet it."""

import json
import math

import pytest
from axe_playwright_python.sync_playwright import Axe

import live_drum
from drumrs.config.program import with_speed
from drumrs.simulation import Simulation


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "drum.html"
    path.write_text(live_drum.page(), encoding="utf-8")
    return path.as_uri()


class Page:
    """The page, once its drum turns."""

    def __init__(self, page):
        self.page = page
        self.wait("window.studio?.recording?.end > 0.3")

    def wait(self, condition):
        self.page.wait_for_function(condition)

    def read(self, expression):
        return self.page.evaluate(expression)

    def pause(self):
        """Let it stand, on a picture that is the last."""
        self.page.locator(".play").click()
        self.wait("!studio.playing")

    def slide(self, key, value):
        script = """(input, value) => {
          input.value = value;
          for (const name of ["input", "change"]) input.dispatchEvent(new Event(name));
        }"""
        self.page.locator(f"input[data-key='{key}']").evaluate(script, value)

    def places(self):
        return self.read("[...studio.recording.frames.at(-1).positions]")


@pytest.fixture
def drum(browser, address):
    """Open the page; at the end it may not have complained, nor asked anybody for anything."""
    context = browser.new_context(viewport={"width": 1000, "height": 900})
    page, troubles = context.new_page(), []
    page.on("console", lambda message: troubles.append(message.text))
    page.on("pageerror", lambda error: troubles.append(str(error)))
    page.on("request", lambda request: troubles.append(request.url) if request.url != address else None)
    page.goto(address)
    yield Page(page)
    context.close()
    assert [one for one in troubles if not one.startswith(("data:", "blob:"))] == []


def _run_to(config, time):
    simulation = Simulation(config)
    simulation.run(steps=round(time / simulation.time_step))
    assert simulation.time == time
    return simulation


def test_what_is_seen_is_the_run_of_the_case(drum):
    drum.pause()
    simulation = _run_to(live_drum.machine(3), drum.read("studio.recording.end"))
    assert drum.places() == pytest.approx(simulation.positions.ravel().tolist(), abs=1e-5)
    assert drum.read("studio.scene.drumAngle") == simulation.drum_angle
    assert drum.read("studio.part('title').textContent") == "100 bundles: the paper's drum, 3 baffles"


def test_another_speed_acts_at_once(drum):
    drum.slide("rotation.rpm", 80)
    drum.wait("Math.abs(studio.spin * 30 / Math.PI - 80) < 1e-9")
    assert drum.read("studio.recording.begin") == 0.0, "it did not start anew"
    drum.pause()
    end = drum.read("studio.recording.end")
    # When it began shows in the angle: after it, and half of the ramp of 0.1 s, the drum turned by 26 rpm more.
    further = drum.read("studio.scene.drumAngle") / math.tau - 54.0 / 60.0 * end
    begin = round(end - 0.05 - further / (26.0 / 60.0), 3)
    knots = with_speed([(0.0, 54.0)], 80.0, earliest=begin, ramp=0.1)
    config = live_drum.machine(3).replace({"rotation.program": knots})
    simulation = _run_to(config, end)
    assert drum.places() == pytest.approx(simulation.positions.ravel().tolist(), abs=1e-5)


def test_other_values_start_anew_and_impossible_ones_change_nothing(drum):
    drum.slide("contact.bundle.friction", 0.1)
    drum.wait("studio.part('said').textContent === 'Started anew with friction 0.1.'")
    drum.slide("load.count", 60)
    drum.wait("studio.recording.count === 60 && studio.recording.end > 0.1")
    drum.pause()
    changes = {"contact.bundle.friction": 0.1, "load.count": 60}
    simulation = _run_to(live_drum.machine(3).replace(changes), drum.read("studio.recording.end"))
    assert drum.places() == pytest.approx(simulation.positions.ravel().tolist(), abs=1e-5)
    drum.read("studio.live.ask({ do: 'set', key: 'load.count', value: 5000 })")
    drum.wait("/no more bundles of diameter/.test(studio.part('trouble').textContent)")
    assert drum.read("studio.recording.count") == 60


def test_other_machines_steps_and_a_reset(drum):
    drum.page.locator(".preset").select_option("6 baffles")
    drum.wait("studio.recording.baffles.length === 6 && studio.recording.end > 0.1")
    drum.pause()
    stands = drum.read("studio.recording.end")
    drum.page.locator(".one").click()
    drum.wait(f"studio.recording.end > {stands}")
    step = Simulation(live_drum.machine(6)).time_step
    assert drum.read("studio.recording.end") - stands == pytest.approx(step)
    drum.page.locator(".reset").click()
    drum.wait("studio.recording.end === 0")
    # A step stands still; a reset keeps the speed that was chosen.
    assert not drum.read("studio.playing")
    drum.slide("rotation.rpm", 30)
    drum.page.locator(".reset").click()
    drum.wait("studio.recording.end === 0 && Math.abs(studio.spin * 30 / Math.PI - 30) < 1e-9")
    for name in ("toml", "python", "trade", "forces"):
        assert not drum.page.locator(f".{name}").is_visible(), name
    assert "f" not in drum.read("[...studio.root.querySelectorAll('kbd')].map((key) => key.textContent)")
    drum.page.locator(".stage").press("f")
    assert not drum.read("studio.stage.forces")
    drum.page.locator(".occupied").check()
    drum.wait("studio.stage.occupied && /how often/.test(studio.part('layers').textContent)")


def test_nobody_who_looks_nothing_that_runs(drum):
    # Whoever asks for no pictures, as a hidden tab, does not keep a core busy.
    drum.read("Object.assign(studio, { receive: () => {} })")
    script = """async () => {
      await new Promise((done) => setTimeout(done, 2500));
      const before = studio.recording.end;
      const time = ({ detail }) => new Float64Array(detail, 0, 6)[1];
      const shown = new Promise((done) => studio.live.addEventListener("frame", (event) => done(time(event))));
      studio.live.ask({ do: "frame" });
      return (await shown) - before;
    }"""
    assert drum.read(f"({script})()") < 2.0


def test_less_motion_is_asked_for(browser, address):
    context = browser.new_context(reduced_motion="reduce")
    page = context.new_page()
    page.goto(address)
    page.wait_for_function("window.studio?.recording && !studio.playing")
    assert page.evaluate("studio.recording.end") < 0.2
    found = Axe().run(page).response["violations"]
    serious = [one["id"] for one in found if one["impact"] in {"serious", "critical"}]
    context.close()
    assert not serious


def test_the_page_has_the_sliders_that_it_can_set():
    for machine in live_drum.machines().values():
        keys = {one["key"] for one in machine["controls"]}
        assert keys == {"rotation.rpm", "load.count", "contact.bundle.friction"}
        # The core knows them by the same names and values.
        core = machine["config"]
        values = {one["key"]: one["value"] for one in machine["controls"]}
        assert core["load"]["count"] == values["load.count"]
        assert core["contact"]["bundle"]["friction"] == values["contact.bundle.friction"]
        json.dumps(machine, allow_nan=False)
