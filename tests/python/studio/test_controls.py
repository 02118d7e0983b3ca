"""Every control of the page: sliders, machines, trades, rates, keys and touch."""

import pytest

from drumrs.studio.presets import preset, presets, trade_of
from drumrs.studio.trades import TRADES


def is_focused(studio, key) -> bool:
    return studio.page.evaluate("key => studio.root.activeElement?.dataset.key === key", key)


def test_every_slider_moves_by_keys_and_keeps_the_focus(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    for key in ("rotation.rpm", "load.fill", "contact.bundle.friction", "drum.baffles.height"):
        slider = studio.page.locator(f"input[data-key='{key}']")
        step = studio.page.evaluate(
            "key => studio.sliders.known.find(({ control }) => control.key === key).control.step", key
        )
        before = float(slider.input_value())
        start = studio.session.view.start
        slider.focus()
        studio.page.keyboard.press("ArrowRight")
        studio.page.keyboard.press("Shift+ArrowLeft")
        expected = round(before / step) * step - 9 * step
        if key != "rotation.rpm":
            studio.wait(f"studio.part('said').textContent.includes('{key} = {expected:.6g}')")
            assert studio.session.view.start == start + 2
        else:
            studio.wait(f"Math.abs(studio.spin * 30 / Math.PI - {expected}) < 1e-9")
            assert studio.session.view.start == start
        assert float(slider.input_value()) == pytest.approx(expected)
        assert is_focused(studio, key)
    case = studio.session.case()
    assert (case.load.fill, case.contact.bundle.friction) == pytest.approx((0.091, 0.41))


def test_every_machine_can_be_chosen_and_is_measured_as_its_trade_does(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    for name in presets():
        studio.part("preset").select_option(name)
        studio.wait(f"studio.recording.count === {preset(name).bundle_count} && studio.recording.end > 0")
        studio.wait(f"studio.part('trade').value === '{trade_of(name)}'")
        assert studio.part("trouble").is_hidden()
        assert studio.part("preset").input_value() == name
    assert {trade_of(name) for name in presets()} == set(TRADES)
    studio.part("preset").select_option("mine")
    studio.wait("studio.recording.count === 40")
    studio.part("trade").select_option("dryer")
    studio.part("tiles").locator("[data-name=openness]").wait_for()
    assert studio.session.view.trade == "dryer"


def test_time_passes_at_every_rate(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    for option in studio.part("rate").locator("option").all():
        value = option.get_attribute("value")
        studio.part("rate").select_option(value)
        studio.wait(f"studio.part('rate').value === '{value}'")
        rate = float(value or "inf")
        while studio.session.view.rate != rate:
            studio.session.wait(studio.session.view.number, 0.1)
        now = studio.time
        studio.wait(f"studio.recording.end > {now}")


def test_every_key_does_what_it_says(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.1")
    press = studio.page.keyboard.press
    press(" ")
    studio.wait("!studio.playing")
    press("ArrowUp")
    press("ArrowUp")
    press("ArrowDown")
    studio.wait("studio.speed === 55")
    modes = []
    for _ in range(4):
        modes.append(studio.part("mode").input_value())
        press("c")
    assert modes == ["speed", "height", "distance", "size"]
    press("m")
    assert studio.page.evaluate("studio.coloring.mark === studio.recording.frames.length - 1")
    for key, name in (("f", "forces"), ("o", "occupied")):
        for is_on in (True, False):
            press(key)
            assert studio.page.evaluate("name => studio.stage[name]", name) is is_on
            assert studio.part(name).is_checked() is is_on
    press("n")
    press("n")
    assert studio.page.evaluate("studio.stage.chosen") == [1]
    press("Escape")
    assert studio.page.evaluate("studio.stage.chosen") == []
    with studio.page.expect_download() as saved:
        press("s")
    assert saved.value.suggested_filename == "drum.png"
    press("r")
    studio.wait("studio.recording.end === 0")
    press("ArrowRight")
    studio.wait("studio.recording.end > 0")
    assert studio.session.view.playing is False


def test_keys_of_the_page_are_those_that_it_lists(show):
    studio = show()
    studio.part("keys").locator("summary").click()
    assert studio.part("keys").inner_text().endswith("Esc no bundle, s screenshot.")
    listed = studio.part("keys").locator("kbd").all_inner_texts()
    names = {"ArrowRight": "→", "ArrowUp": "↑", "ArrowDown": "↓", " ": "space", "Escape": "Esc"}
    known = studio.page.evaluate("Object.keys(studio.keys)")
    assert sorted(listed) == sorted(names.get(key, key) for key in known)


def test_a_page_that_lacks_a_part_has_no_key_for_it(show):
    studio = show()
    studio.page.evaluate("""() => {
      const live = Object.assign(new EventTarget(), { asked: [], ask: ({ do: what }) => live.asked.push(what), close: () => {} });
      const place = document.querySelector("main").appendChild(document.createElement("div"));
      window.other = new studio.constructor(place, live, ["forces", "toml"]);
    }""")
    listed = studio.page.evaluate("[...other.root.querySelectorAll('kbd')].map((key) => key.textContent)")
    assert "f" not in listed
    assert "o" in listed
    studio.page.evaluate("other.press(new KeyboardEvent('keydown', { key: 'f' }))")
    studio.page.evaluate("other.press(new KeyboardEvent('keydown', { key: 'r' }))")
    assert studio.page.evaluate("other.live.asked") == ["reset"]
    for name, is_seen in (("forces", False), ("toml", False), ("occupied", True), ("python", True)):
        script = "name => other.part(name).getClientRects().length > 0"
        assert studio.page.evaluate(script, name) is is_seen
    studio.page.evaluate("other.destroy()")


def test_a_finger_does_what_a_mouse_does(show):
    studio = show(has_touch=True, is_mobile=True)
    studio.page.set_viewport_size({"width": 390, "height": 800})
    studio.wait("studio.recording?.end > 0.1")
    studio.part("play").tap()
    studio.wait("!studio.playing")
    studio.wait(f"Math.abs(studio.recording.end - {studio.session.view.now.times[0]}) < 1e-9")
    box = studio.part("stage").bounding_box()
    x, y = studio.session.view.now.positions[0, 7]
    unit = box["width"] / (2.0 * 1.13 * 0.2375)
    studio.part("stage").tap(
        position={"x": box["width"] / 2.0 + unit * x, "y": box["height"] / 2.0 - unit * y}
    )
    assert studio.page.evaluate("studio.stage.chosen") == [7]
    slider = studio.page.locator("input[data-key='rotation.rpm']")
    where = slider.bounding_box()
    slider.tap(position={"x": 0.75 * where["width"], "y": where["height"] / 2.0})
    studio.wait("studio.speed > 80")
    assert studio.session.view.speed == pytest.approx(100.0, abs=10.0)
    # Whatever is to be hit is large enough for a finger, and nothing leaves the screen.
    script = "one => one.getBoundingClientRect().height"
    for control in studio.page.locator("button, select, input[type=range]").all():
        assert control.evaluate(script) >= 28
    assert studio.page.evaluate("document.documentElement.scrollWidth") == 390
