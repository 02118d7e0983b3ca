"""The studio as people meet it: in a browser, from its start to the case that leaves it."""

import io
import re

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from PIL import Image

import drumrs
from films import pictures_of


def test_it_runs_the_moment_it_opens(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    before = studio.pixels()
    studio.wait("studio.recording.end > 1")
    assert studio.pixels() != before
    assert studio.part("title").inner_text() == "40 bundles (10 % fill), 3 baffles, 54 rpm, seed 1"
    assert studio.part("preset").locator("option:checked").inner_text() == "mine"
    studio.part("tile").first.wait_for()
    assert "±" in studio.part("tiles").inner_text()
    assert studio.page.locator(".panel canvas").count() == 2
    assert re.search(r" simulated seconds in a second, \d+ pictures?\.$", studio.part("pace").inner_text())
    studio.page.evaluate(
        "Object.assign(studio.pictures, { rate: 1, count: 0, since: performance.now() + 1e6 })"
    )
    studio.wait("studio.part('pace').textContent.endsWith(', 1 picture.')")
    # What is on the page is where it was in the simulation.
    studio.part("play").click()
    studio.wait("!studio.playing")
    simulation = studio.session._simulation
    studio.wait(f"Math.abs(studio.recording.end - {simulation.time}) < 1e-9")
    studio.wait("studio.curves.axes.window?.[1] > studio.recording.end - 1e-9")
    # A heading follows its panel, whose means become longer.
    studio.page.evaluate("studio.curves.axes.panels[0].title = 'Power, means over 77 s'")
    studio.page.evaluate("studio.curves.panels[0].draw(studio.curves.axes.end)")
    heading = studio.page.locator(".panel .heading").first
    assert heading.inner_text() == "Power, means over 77 s [W/m]"
    places = studio.page.evaluate("[...studio.recording.frames.at(-1).positions]")
    assert places == pytest.approx(simulation.positions.ravel().tolist(), abs=1e-5)


def test_time_stands_goes_by_steps_and_begins_anew(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    studio.part("play").click()
    studio.wait("!studio.playing")
    assert studio.part("play").get_attribute("aria-label") == "Play"
    studio.wait(f"Math.abs(studio.recording.end - {studio.session._simulation.time}) < 1e-9")
    stands = studio.time
    studio.part("one").click()
    studio.wait(f"studio.recording.end > {stands}")
    assert studio.time - stands == pytest.approx(studio.session._simulation.time_step)
    studio.page.keyboard.press("ArrowRight")
    studio.wait(f"studio.recording.end > {stands} + 1.5 * {studio.session._simulation.time_step}")
    studio.page.keyboard.press("r")
    studio.wait("studio.recording.end === 0")
    studio.wait("studio.part('said').textContent === 'Started anew from seed 1.'")
    studio.part("rate").select_option("0.1")
    studio.part("stage").press(" ")
    studio.wait("studio.playing && studio.recording.end > 0")
    assert studio.session.view.rate == 0.1


def test_a_speed_acts_at_once_and_is_in_the_case(show):
    studio = show(permissions=["clipboard-read", "clipboard-write"])
    studio.wait("studio.recording?.end > 0.1")
    studio.slide("rotation.rpm", 70)
    studio.wait("Math.abs(studio.spin * 30 / Math.PI - 70) < 1e-9")
    assert studio.page.evaluate("studio.recording.begin") == 0.0, "it did not start anew"
    studio.wait("studio.part('title').textContent.includes('70 rpm')")
    studio.part("play").click()
    studio.wait("!studio.playing")
    for name in ("toml", "python"):
        studio.part(name).click()
        studio.page.wait_for_function(
            "name => studio.part('said').textContent.includes(name)",
            arg="case.toml" if name == "toml" else "script",
        )
    script = studio.page.evaluate("navigator.clipboard.readText()")
    assert script == studio.part("case").input_value()
    names: dict = {}
    exec(script.replace("result = drumrs.run(config)", ""), names)
    assert names["config"] == studio.session.case()
    assert names["config"].rotation.program[-1][1] == 70.0


def test_other_sliders_start_anew_and_what_is_refused_is_said(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    studio.slide("load.fill", 0.2)
    studio.wait("studio.recording.count === 80")
    studio.wait("studio.part('said').textContent === 'Started anew from seed 1, with load.fill = 0.2.'")
    studio.slide("drum.baffles.height", 0.06)
    studio.wait("studio.part('said').textContent.includes('drum.baffles.height')")
    studio.page.evaluate("studio.live.ask({ do: 'set', key: 'load.fill', value: 5 })")
    studio.part("trouble").wait_for()
    assert "load.fill" in studio.part("trouble").inner_text()
    case = studio.session.case()
    assert (case.load.fill, case.drum.baffles.height) == (0.2, 0.06)
    studio.part("preset").select_option("coater")
    studio.wait("studio.recording.count === 500")
    assert studio.page.locator("input[data-key='drum.liner.rail.height']").count() == 1


def test_what_is_beside_the_drum_keeps_its_place(show):
    studio = show()
    studio.wait("studio.part('tiles').querySelector('[data-name=falls_per_turn]')")
    names = "[...studio.part('tiles').children].map((tile) => tile.dataset.name)"
    before = studio.page.evaluate(names)
    assert before[:3] == ["drum_power", "drum_specific_power", "energy_residual"]
    height = "studio.part('player').offsetHeight"
    high = studio.page.evaluate(height)
    # Until there are means of the time since the change, dashes stand for them.
    studio.part("rate").select_option("0.01")
    for key, value in (("rotation.rpm", 70), ("load.fill", 0.2)):
        studio.slide(key, value)
        studio.wait(
            "studio.part('tiles').querySelector('[data-name=falls_per_turn] span').textContent === '–'"
        )
        assert studio.page.evaluate(names) == before
        assert studio.page.locator(".panel canvas").count() == 2
        # Lines of texts may come and go; tiles and curves are higher.
        assert abs(studio.page.evaluate(height) - high) < 50
    studio.part("rate").select_option("")
    studio.wait("studio.part('tiles').querySelector('[data-name=falls_per_turn] span').textContent !== '–'")
    assert studio.page.evaluate(names) == before


def test_a_line_that_comes_to_a_panel_has_its_reading(show):
    studio = show()
    studio.part("panels").locator("canvas").first.wait_for()
    studio.part("play").click()
    studio.wait("!studio.playing")
    # At once, as measures of the last moments may still come.
    label, readings = studio.page.evaluate("""() => {
      const { curves } = studio;
      const [panel, other] = curves.axes.panels;
      const more = { ...panel.lines[0], name: "another" };
      curves.take([{ ...panel, lines: [...panel.lines, more] }, other], curves.axes.window);
      curves.draw();
      const first = studio.part("panels").querySelector(".panel");
      return [first.querySelector("canvas").getAttribute("aria-label"), first.querySelector(".readings").innerText];
    }""")
    assert "another" in label
    assert "another" in readings
    assert studio.page.locator(".panel").count() == 2


def test_a_picture_is_saved(show, tmp_path):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    studio.part("mark").click()
    assert studio.part("mode").input_value() == "height"
    with studio.page.expect_download() as saved:
        studio.part("picture").click()
    path = tmp_path / saved.value.suggested_filename
    saved.value.save_as(path)
    with Image.open(path) as picture:
        assert picture.size[0] == picture.size[1] > 300
        assert len(picture.getcolors(10**6)) > 20


def test_what_is_seen_is_recorded_as_a_film(show, tmp_path):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    button = studio.part("film")
    button.click()
    assert (button.inner_text(), button.get_attribute("aria-pressed")) == ("Stop recording", "true")
    began = studio.time
    studio.wait(f"studio.recording.end > {began} + 0.5")
    with studio.page.expect_download() as saved:
        button.click()
    assert (button.inner_text(), button.get_attribute("aria-pressed")) == ("Record", "false")
    path = tmp_path / saved.value.suggested_filename
    saved.value.save_as(path)
    first, last = pictures_of(path)[[0, -1]].astype(int)
    assert first.shape[0] == first.shape[1] > 500
    # The load has moved meanwhile, on the page's own color.
    assert (np.abs(first - last).max(axis=2) > 100).sum() > 500
    assert last[2, 2].min() > 240


def test_a_phone_in_the_dark_and_less_motion(show):
    studio = show(color_scheme="dark", reduced_motion="reduce")
    studio.page.set_viewport_size({"width": 390, "height": 800})
    studio.wait("studio.recording && studio.playing === false")
    assert studio.page.evaluate("document.documentElement.scrollWidth") == 390
    shot = Image.open(io.BytesIO(studio.part("player").screenshot()))
    assert max(shot.convert("RGB").getpixel((20, 20))) < 60
    studio.part("play").click()
    studio.wait("studio.playing")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_is_for_all_readers(show, scheme):
    studio = show(color_scheme=scheme)
    studio.part("tile").first.wait_for()
    found = Axe().run(studio.page).response["violations"]
    assert [(one["id"], one["impact"]) for one in found] == []


def test_a_server_that_is_gone_is_said(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    studio.server.stop()
    studio.part("trouble").wait_for()
    assert "does not answer" in studio.part("trouble").inner_text()
    # That the browser could not connect is a message of its own.
    studio.page.close()
    studio.troubles[:] = [one for one in studio.troubles if "ERR_CONNECTION_REFUSED" not in one]


def test_a_line_that_is_lost_comes_back(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    studio.page.evaluate("studio.live.socket.close()")
    studio.wait("studio.live.socket.readyState === WebSocket.OPEN")
    now = studio.time
    studio.wait(f"studio.recording.end > {now}")
    assert studio.part("trouble").is_hidden()
    assert studio.session.case().replace({"run.duration": 30.0}) == (
        drumrs.baseline(fill=0.1, baffles=True).softer(100.0)
    )
