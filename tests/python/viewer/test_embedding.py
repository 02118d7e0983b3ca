"""Players in pages of others, fed while they are shown."""

import json

import pytest

from drumrs.viewer import module
from drumrs.viewer.recording import pack
from shown import Shown, scene
from synthetic import series_of

# A page as others write it: two players of one recording in elements of its own, from the module's text.
EMBEDDED = """<!doctype html><meta charset=utf-8><div></div><div></div>
<script type="application/json">{data}</script>
<script type="text/plain">{module}</script>
<script type="module">
const text = document.querySelector("script[type='text/plain']").textContent;
const {{ Player, unpack }} = await import(URL.createObjectURL(new Blob([text], {{ type: "text/javascript" }})));
const recording = unpack(JSON.parse(document.querySelector("script").textContent));
const show = (element) => new Player(element, recording, {{ start: 1 }});
const [one, two] = [...document.querySelectorAll("div")].map(show);
const told = [];
for (const name of ["time", "select", "play", "pause"]) one.addEventListener(name, () => told.push(name));
Object.assign(window, {{ recording, one, two, told }});
</script>"""


@pytest.fixture
def embedded(show) -> Shown:
    data = json.dumps(pack(scene(), series_of(7.0), "", None))
    shown = show(EMBEDDED.format(data=data, module=module("player.js", "recording.js")))
    shown.page.wait_for_function("'told' in window")
    return shown


def test_players_in_elements_of_any_page(embedded):
    ask = embedded.page.evaluate
    elements = embedded.page.locator("div:not(div div)")
    assert ask("[one.time, two.time]") == [1.0, 1.0]
    elements.nth(0).locator(".forward").click()
    elements.nth(0).locator(".stage").press("n")
    assert ask("[one.time, two.time]") == pytest.approx([1.04, 1.0])
    assert ask("[one.selected, two.selected]") == [0, None]
    ask("one.play(); one.pause()")  # in one go, so that no frame is drawn between them
    assert ask("told") == ["time", "select", "play", "pause"]
    # Both draw the same at one time, each on canvases of its own.
    ask("one.select(null); two.seek(one.time)")
    pictures = [elements.nth(k).locator(".stage").evaluate("canvas => canvas.toDataURL()") for k in (0, 1)]
    assert pictures[0] == pictures[1]


def test_a_player_that_is_destroyed_leaves_nothing(embedded):
    ask = embedded.page.evaluate
    elements = embedded.page.locator("div:not(div div)")
    ask("one.play(); one.destroy()")
    assert ask("told") == ["play", "pause"]
    assert elements.nth(0).inner_html() == ""
    # It hears neither of the recording nor of the scheme of colors, while the other one does.
    ask("one.draw = () => { throw new Error('drawn after its end'); }; recording.extend({})")
    embedded.page.emulate_media(color_scheme="dark")
    embedded.page.wait_for_timeout(50)
    elements.nth(1).locator(".forward").click()
    assert ask("two.time") == pytest.approx(1.04)


def test_a_recording_grows_while_it_is_shown(embedded):
    ask = embedded.page.evaluate
    ask("""() => {
      two.seek(recording.end);
      const last = recording.frames.at(-1);
      recording.extend({
        frames: [0.5, 1].map((later) => ({ ...last, time: last.time + later, drumAngle: last.drumAngle + 2 * later })),
        panels: [{ title: "Power", lines: recording.panels[0].lines }],
        speedScale: 0.5,
      });
    }""")
    # Who was at the end stays there; who was elsewhere, too.
    assert ask("[one.time, two.time]") == [1.0, 4.0]
    second = embedded.page.locator("div:not(div div)").nth(1)
    assert second.locator(".scrub").get_attribute("aria-valuetext") == "4.00 of 4.00 seconds, frame 78 of 78"
    assert second.locator(".turning").inner_text() == "19.1 rpm, 1.27 turns"
    assert second.locator(".highest").inner_text() == "≥ 0.500"
    second.locator(".stage").press("Home")
    second.locator(".stage").press("End")
    assert ask("two.time") == 4.0
