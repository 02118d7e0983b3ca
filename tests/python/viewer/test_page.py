"""The player as people meet it: in a browser, from a file, with mouse, keys and a phone's width."""

import base64
import io
import math
from dataclasses import replace

import numpy as np
import pytest

from drumrs.viewer import Player, module, script
from films import pictures_of
from shown import RADIUS, scene
from synthetic import series_of

LATER = 0.5  # seconds: long enough to see time pass, whatever else the machine does


def test_bundles_drum_and_baffle_are_where_they_should_be(show):
    shown = show()
    shown.part("marks").uncheck()
    inside = shown.color(0.05, 0.12)
    slow, fast = (68, 1, 84), (253, 231, 37)
    assert shown.color(0.0, -0.15) == shown.color(-0.15, 0.0) == slow
    assert shown.color(0.1, 0.0) == fast
    assert shown.color(0.1, 0.05) == inside
    baffle = shown.color(0.175, 0.0)
    assert baffle not in (inside, slow, fast)
    shown.press("End")
    # The drum and the third bundle have turned by 6 rad.
    x, y = math.cos(6.0), math.sin(6.0)
    assert shown.color(0.1 * x, 0.1 * y) == fast
    assert shown.color(0.175 * x, 0.175 * y) == baffle
    assert shown.color(0.175, 0.0) == inside


def test_it_plays_and_pauses(show):
    shown = show()
    assert shown.time == 0.0
    before = shown.pixels()
    shown.part("play").click()
    shown.wait(f"player.time > {LATER}")
    shown.part("play").click()
    assert shown.part("play").get_attribute("aria-label") == "Play"
    assert shown.part("stage").get_attribute("aria-label") == "3 bundles in the drum: Three bundles"
    paused = shown.time
    shown.page.wait_for_timeout(100)
    assert shown.time == paused > LATER
    assert shown.pixels() != before
    assert shown.part("time").inner_text() == f"{paused:.2f} s"


def test_what_is_shown_is_recorded_as_a_film(show, tmp_path):
    shown = show()
    button = shown.part("film")
    button.click()
    assert (button.inner_text(), button.get_attribute("aria-pressed")) == ("Stop recording", "true")
    shown.wait(f"player.time > {LATER}")
    with shown.page.expect_download() as saved:
        button.click()
    assert (button.inner_text(), button.get_attribute("aria-pressed")) == ("Record", "false")
    path = tmp_path / saved.value.suggested_filename
    saved.value.save_as(path)
    assert path.stem == "drum"
    first, last = pictures_of(path)[[0, -1]].astype(int)
    assert np.abs(first - last).max() > 100
    assert last[2, 2].min() > 240


def test_time_passes_as_fast_as_chosen(show):
    shown = show()
    # A clock of the test's own: on a busy machine frames come late, and the player rather falls behind than jumps.
    clock = shown.page.clock
    clock.install(time=0)
    clock.pause_at(1000)
    start = """rate => {
      const { player } = document.querySelector("drumrs-player");
      player.rate = rate;
      player.seek(0);
      player.play();
    }"""
    for rate in (0.1, 1, 4):
        shown.page.evaluate(start, rate)
        clock.run_for(32)
        first = shown.page.evaluate('document.querySelector("drumrs-player").player.time')
        clock.run_for(160)
        last = shown.page.evaluate('document.querySelector("drumrs-player").player.time')
        assert (last - first) / 0.160 == pytest.approx(rate, rel=0.02)


def test_it_starts_where_told(show):
    shown = show(f"<!doctype html>{Player(scene()).element(start=1.01)}{script()}")
    assert shown.time == pytest.approx(1.0)
    assert shown.part("time").inner_text() == "1.00 s"


def test_it_stops_at_the_end_and_starts_anew(show):
    shown = show()
    shown.press("End")
    assert shown.time == 3.0
    shown.part("play").click()
    shown.wait("player.time > 0.1 && player.time < 2.5")
    shown.page.evaluate("document.querySelector('drumrs-player').player.seek(2.95)")
    shown.wait("player.time === 3 && !player.playing")


def test_scrubbing_shows_the_frame(show):
    shown = show()
    shown.part("scrub").fill("25")
    assert shown.time == pytest.approx(1.0)
    assert shown.part("time").inner_text() == "1.00 s"
    assert shown.part("scrub").get_attribute("aria-valuetext") == "1.00 of 3.00 seconds, frame 26 of 76"
    assert shown.part("turning").inner_text() == "19.1 rpm, 0.32 turns"


def test_stepping_lands_on_frames(show):
    shown = show()
    shown.part("forward").click()
    assert shown.time == pytest.approx(0.04)
    shown.page.evaluate("document.querySelector('drumrs-player').player.seek(0.05)")
    shown.part("back").click()
    assert shown.time == pytest.approx(0.04)
    shown.part("back").click()
    shown.part("back").click()
    assert shown.time == 0.0


def test_keys_do_what_they_say(show):
    shown = show()
    shown.press("ArrowRight", "Shift+ArrowRight", "ArrowLeft")
    assert shown.time == pytest.approx(0.4)
    shown.press("Home")
    assert shown.time == 0.0
    shown.press("+", "+")
    assert shown.part("rate").input_value() == "4"
    shown.press("-", "-", "-", "-", "-", "-", "-")
    assert shown.part("rate").input_value() == "0.1"
    shown.press(" ")
    shown.wait("player.playing")
    shown.press(" ")
    shown.wait("!player.playing")


def test_space_on_a_button_presses_the_button_only(show):
    shown = show()
    shown.part("forward").focus()
    shown.press(" ")
    assert shown.time == pytest.approx(0.04)
    assert not shown.page.evaluate("document.querySelector('drumrs-player').player.playing")
    shown.part("play").focus()
    shown.press(" ")
    shown.wait("player.playing")


def test_species_have_colors_and_names_where_there_are_some(show):
    frames = replace(scene(), species=("steel-ball", "ore", "steel-ball"))
    shown = show(Player(frames).page(autoplay=False))
    shown.part("marks").uncheck()
    shown.part("mode").select_option("species")
    ore, steel = (68, 1, 84), (253, 231, 37)
    places = ((0.0, -0.15), (-0.15, 0.0), (0.1, 0.0))
    assert [shown.color(*place) for place in places] == [steel, ore, steel]
    assert [shown.part(end).inner_text() for end in ("lowest", "highest")] == ["ore", "steel-ball"]
    assert "Species" in shown.part("quantity").inner_text()
    shown.press("n")
    assert shown.part("bundle").inner_text().startswith("Bundle 0, steel-ball: ")


def test_colors_say_what_is_chosen(show):
    shown = show()
    shown.part("marks").uncheck()
    seen = {}
    for mode in ("speed", "height", "distance", "size"):
        assert shown.part("mode").input_value() == mode
        places = ((0.0, -0.15), (-0.15, 0.0), (0.1, 0.0))
        seen[mode] = [shown.color(*place) for place in places]
        shown.press("c")
    first, last = (68, 1, 84), (253, 231, 37)
    assert seen["speed"] == [first, first, last]
    assert seen["height"][0] == first
    assert seen["height"][1] == seen["height"][2] == last
    assert seen["distance"] == [last, last, first]
    assert seen["size"][0] == first
    assert seen["size"][2] == last
    assert shown.part("quantity").inner_text() == "Speed [m/s]"


def test_a_mark_keeps_colors_while_bundles_move(show):
    shown = show()
    shown.part("marks").uncheck()
    shown.part("scrub").fill("39")
    shown.part("mark").click()
    assert (
        shown.part("quantity").inner_text()
        == "Height at marked time, t\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}1.56\N{NO-BREAK SPACE}s [mm]"
    )
    shown.press("End")
    # Above both others when it was marked, wherever it is now.
    assert shown.color(0.1 * math.cos(6.0), 0.1 * math.sin(6.0)) == (253, 231, 37)


def test_spin_marks_and_the_drum_s_frame(show):
    shown = show()
    shown.press("ArrowRight")
    marked = shown.pixels()
    shown.part("marks").uncheck()
    assert shown.pixels() != marked
    shown.press("End")
    baffle = shown.color(0.175 * math.cos(6.0), 0.175 * math.sin(6.0))
    shown.part("corotating").check()
    assert shown.color(0.175, 0.0) == baffle


def test_a_chosen_bundle_is_followed(show):
    shown = show()
    size = shown.part("stage").bounding_box()
    middle, unit = size["width"] / 2, size["width"] / 2 / (1.13 * RADIUS)
    shown.part("stage").click(position={"x": middle, "y": middle + 0.15 * unit})
    assert shown.part("bundle").inner_text().startswith("Bundle 0:")
    shown.part("stage").click(position={"x": middle + 0.1 * unit, "y": middle})
    assert shown.part("bundle").inner_text() == "Bundle 2: 0.200 m/s, 100 mm from the axis"
    shown.press("Escape", "n")
    assert shown.part("bundle").inner_text() == "Bundle 0: 0.00 m/s, 150 mm from the axis"
    shown.press("Escape")
    assert shown.part("bundle").inner_text() == "Click a bundle to follow its path; more of them with shift."


def test_several_bundles_are_followed_as_long_as_chosen(show):
    shown = show()
    shown.press("End", "n", "Shift+N", "Shift+N")
    assert shown.page.evaluate("document.querySelector('drumrs-player').player.stage.chosen") == [0, 1, 2]
    # The third has been a second and a half ago, at 3 rad, where the path of a second does not reach.
    place = 0.1 * math.cos(3.0), 0.1 * math.sin(3.0)
    bare = shown.color(*place)
    shown.part("path").select_option("3")
    assert shown.color(*place) != bare
    shown.press("n")
    assert shown.color(*place) == bare


def test_the_plot_follows_and_can_be_clicked(show):
    shown = show(Player(scene(), series_of(7.0)).page(autoplay=False))
    readings = shown.part("reading").all_inner_texts()
    assert readings[:3] == ["drum 7.00", "dissipated normal 4.20", "dissipated sliding 2.80"]
    plot = shown.page.locator("drumrs-player .panel canvas").first
    before = plot.evaluate("canvas => canvas.toDataURL()")
    box = plot.bounding_box()
    plot.click(position={"x": 52 + (box["width"] - 62) / 2, "y": 40})
    assert shown.time == pytest.approx(1.5, abs=0.02)
    assert plot.evaluate("canvas => canvas.toDataURL()") != before


def test_it_plays_by_itself_unless_less_motion_is_wanted(show):
    page = Player(scene()).page(autoplay=True)
    show(page).wait("player.playing && player.time > 0.1")
    calm = show(page, reduced_motion="reduce")
    calm.page.wait_for_timeout(200)
    assert calm.time == 0.0


def test_dark_and_light_differ_and_switch_at_once(show):
    shown = show(Player(scene(), series_of(7.0)).page(autoplay=False), color_scheme="light")
    curves = shown.page.locator("drumrs-player .panel canvas").first
    drawn = curves.evaluate("canvas => canvas.toDataURL()")
    light = shown.color(0.05, 0.12)
    shown.page.emulate_media(color_scheme="dark")
    shown.page.wait_for_timeout(50)
    dark = shown.color(0.05, 0.12)
    assert min(light) > 200
    assert max(dark) < 60
    # Colors of the curves differ little, but every one is drawn anew.
    assert _colors(curves.evaluate("canvas => canvas.toDataURL()")).isdisjoint(_colors(drawn))


@pytest.mark.parametrize("with_series", [True, False])
def test_it_fits_a_phone(show, with_series):
    series = series_of(7.0) if with_series else None
    title = "A title that is too long for one line on a phone, and goes on for some more words"
    shown = show(Player(scene(), series, title=title).page(), device_scale_factor=3)
    shown.page.set_viewport_size({"width": 360, "height": 640})
    assert shown.page.evaluate("document.documentElement.scrollWidth") == 360
    assert shown.part("play").bounding_box()["height"] >= 40
    stage = shown.part("stage")
    # Sharp: a dot of the canvas for every dot of the screen.
    wide = stage.bounding_box()["width"]
    shown.page.wait_for_function(
        f"document.querySelector('drumrs-player').player.stage.canvas.width >= {3 * wide - 2}"
    )


def test_players_on_one_page_do_not_know_of_each_other(show):
    players = [Player(scene(), title=title).element() for title in ("one", "two")]
    # The shared part may come before or after, and even twice.
    shown = show(f"<!doctype html><meta charset=utf-8>{script()}{''.join(players)}{script()}")
    assert [shown.part("title", player).inner_text() for player in (0, 1)] == ["one", "two"]
    shown.press("ArrowRight")  # for neither, since nobody says for which
    shown.part("forward", 1).click()
    times = "[...document.querySelectorAll('drumrs-player')].map(element => element.player.time)"
    assert shown.page.evaluate(times) == pytest.approx([0.0, 0.04])
    shown.part("scrub", 0).focus()
    shown.press("End")
    assert shown.page.evaluate(times) == pytest.approx([3.0, 0.04])
    ours = "['Recording', 'Stage', 'Plot', 'VIRIDIS', 'Player', 'KEYS'].filter(name => name in window)"
    assert shown.page.evaluate(ours) == []


def test_a_large_load_has_colors(show):
    shown = show(f"""<!doctype html><script type="module">{module("color.js", "recording.js")}
      const radii = new Float32Array(300000).fill(0.01);
      radii[7] = 0.02;
      const frame = {{ time: 0, drumAngle: 0, positions: new Float32Array(600000), angles: radii, speeds: radii }};
      const recording = new Recording({{ radii, drumRadius: 1, reach: 1, frames: [frame] }});
      const coloring = new Coloring(recording);
      coloring.name = "size";
      window.range = coloring.range(recording.scene(0));
      window.greatest = recording.greatestRadius;
    </script>""")
    assert shown.page.evaluate("[...range, greatest]") == pytest.approx([0.02, 0.04, 0.02])


def test_a_notebook_frame_plays(show):
    shown = show(f"<!doctype html>{Player(scene())._repr_html_()}")
    inside = shown.page.frame_locator("iframe").locator("drumrs-player")
    inside.locator(".forward").click()
    assert inside.locator(".time").inner_text() == "0.04 s"


def test_colors_are_those_of_viridis(show):
    import matplotlib as mpl

    shown = show()
    # The color bar is the whole scale, left to right.
    picture = shown.part("bar").screenshot()
    row = _middle_row(picture)[4:-4]
    places = (np.arange(len(row)) + 4.5) / (len(row) + 8)
    expected = 255 * mpl.colormaps["viridis"](places)[:, :3]
    assert np.abs(row - expected).max() < 12


def _colors(picture: str) -> set[tuple[int, ...]]:
    """Return the colors that fill most of a canvas, those of edges left out."""
    from PIL import Image

    image = Image.open(io.BytesIO(base64.b64decode(picture.partition(",")[2])))
    return {color for count, color in image.getcolors(100_000) if count > 200 and color[3] == 255}


def _middle_row(png: bytes) -> np.ndarray:
    """Return the colors of the middle row of a PNG picture."""
    from matplotlib import image

    pixels = image.imread(io.BytesIO(png))
    return 255 * pixels[len(pixels) // 2, :, :3]


@pytest.mark.parametrize(("power", "expected"), [(7.0, "4"), (1.5e6, "1·10⁶")])
def test_values_beside_an_axis_find_room(show, power, expected):
    page = Player(scene(), series_of(power)).page(autoplay=False)
    spy = """<head><script>
      window.widths = {};
      const fill = CanvasRenderingContext2D.prototype.fillText;
      CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
        if (this.textAlign === "right") window.widths[text] = this.measureText(text).width;
        fill.call(this, text, ...place);
      };
    </script>"""
    widths = show(page.replace("<head>", spy, 1)).page.evaluate("window.widths")
    assert expected in widths
    assert max(width for text, width in widths.items() if text != "averages") < 46.0
