"""Layers of the player in a browser: forces at contacts, what discs recorded, occupancy."""

import base64
import io
import math
from dataclasses import replace

import numpy as np
import polars as pl
import pytest
from PIL import Image

import drumrs
from drumrs.frames import Frames
from drumrs.viewer import Player
from shown import scene


def test_forces_are_lines_at_contacts(show):
    # Two bundles overlap by 20 µm, and the third one the rim by 10.
    frames = replace(
        scene(),
        positions=np.broadcast_to(
            np.array([[0.0, 0.03], [0.0, -0.01998], [-0.16001, 0.0]]), (76, 3, 2)
        ).astype(np.float64),
        baffles=(),
    )
    config = drumrs.baseline(baffles=False).replace(
        {"contact.bundle.normal_stiffness": 1e6, "contact.drum.normal_stiffness": 1e6, "drum.diameter": 0.4}
    )
    shown = show(Player(frames, config=config).page(autoplay=False))
    between, at_rim, away = (0.0, 0.01), (-0.19, 0.0), (-0.13, 0.0)
    shown.part("marks").uncheck()
    plain = [shown.color(*place) for place in (between, at_rim, away)]
    shown.part("forces").check()
    ink = (27, 36, 48)
    assert shown.color(*between) == shown.color(*at_rim) == ink
    # Half the force, half the width: 0.55 of the greatest radius is the end of the scale.
    assert shown.color(-0.19, 0.004) == ink != shown.color(-0.19, 0.008)
    assert shown.color(0.009, 0.01) == ink != shown.color(0.013, 0.01)
    assert shown.color(*away) != ink
    words = "from 0.600\N{NO-BREAK SPACE}N/m, full width from 20.0\N{NO-BREAK SPACE}N/m."
    assert shown.part("layers").inner_text().endswith(words)
    shown.press("f")
    assert [shown.color(*place) for place in (between, at_rim, away)] == plain


def test_what_is_not_recorded_is_not_offered_and_says_what_it_takes(show):
    shown = show()
    assert shown.part("forces").is_disabled()
    option = shown.part("mode").locator("option[value=received]")
    assert option.is_disabled()
    assert option.get_attribute("title").endswith('add "discs" to run.record and run again')
    modes = []
    for _ in range(5):
        modes.append(shown.part("mode").input_value())
        shown.press("c")
    assert modes == ["speed", "height", "distance", "size", "speed"]


def test_colors_by_what_the_discs_recorded(show):
    received = {f"received_{kind}": [0.0, 1.0, 2.0] for kind in ("normal", "tangential", "rolling")}
    landings = {"drum_landings": [3, 1, 0], "load_landings": [1, 0, 0]}
    discs = pl.DataFrame({**received, **landings})
    shown = show(Player(scene(), discs=discs).page(autoplay=False))
    shown.part("marks").uncheck()
    first, last = (68, 1, 84), (253, 231, 37)
    shown.part("mode").select_option("received")
    assert [shown.color(0.0, -0.15), shown.color(0.1, 0.0)] == [first, last]
    assert shown.part("quantity").inner_text() == "Energy received in the run [J/m]"
    assert shown.part("highest").inner_text() == "6.00"
    shown.part("mode").select_option("landings")
    assert [shown.color(0.0, -0.15), shown.color(0.1, 0.0)] == [last, first]
    assert shown.part("highest").inner_text() == "4"


def test_occupancy_is_where_bundles_are_how_often(show):
    shown = show()
    shown.press("o")
    assert shown.part("occupied").is_checked()
    never = shown.color(0.0, 0.0)
    seldom = shown.color(-0.1, 0.0)
    assert never == (243, 245, 247)
    assert seldom != never
    words = "Blue: how often bundles cover a place, from never to always, in 0.00 to 3.00\N{NO-BREAK SPACE}s."
    assert shown.part("layers").inner_text() == words
    script = """() => {
      const { map } = document.querySelector("drumrs-player").player.stage.occupancy;
      const cell = (place) => Math.floor((place / 0.2 + 1) * map.size / 2);
      const at = (x, y) => map.share(cell(y) * map.size + cell(x));
      return [at(0.0, -0.15), at(0.1, 0.0), at(0.0, 0.1), at(0.0, 0.0)];
    }"""
    # A disc of radius 0.04 that goes round at 0.1 covers a place while it is within 4 asin(0.2) of a turn.
    passing = [
        np.mean(np.abs(np.angle(np.exp(1j * (2.0 * scene().times - at)))) < 2.0 * math.asin(0.2))
        for at in (0.0, math.pi / 2.0)
    ]
    assert shown.page.evaluate(script) == pytest.approx([1.0, *passing, 0.0], abs=0.03)
    # Seen from the drum the third bundle rests.
    shown.part("corotating").check()
    assert shown.page.evaluate(script)[1] == pytest.approx(1.0)
    assert "of the turning drum" in shown.part("layers").inner_text()


def crowd(count: int) -> Frames:
    """Return so many discs in rows and columns, two radii apart from one another, in a drum of 0.4 m."""
    side = round(math.sqrt(count))
    places = np.linspace(-0.13, 0.13, side)
    positions = np.stack(np.meshgrid(places, places), axis=-1).reshape(1, -1, 2)
    shape = (1, count)
    return replace(
        scene().picked(slice(0, 1)),
        positions=positions.astype(np.float32),
        angles=np.zeros(shape, np.float32),
        velocities=np.zeros((*shape, 2), np.float32),
        contacts=np.zeros(shape, np.uint16),
        radii=np.full(count, 0.25 * (places[1] - places[0])),
        baffles=(),
    )


# The fewer dots a disc has, the more do two ways to smooth its edge differ.
@pytest.mark.parametrize(("dots", "shades"), [(1.0, 12.0), (2.0, 4.0)])
def test_many_discs_are_painted_as_few_are_drawn(show, dots, shades):
    shown = show(Player(crowd(33 * 33)).page(autoplay=False), device_scale_factor=dots)
    shown.part("marks").uncheck()

    def picture(paint: str = "stage.paintBundles") -> np.ndarray:
        """Return the picture as it is with another way to paint many discs."""
        player = "document.querySelector('drumrs-player').player"
        shown.page.evaluate(
            f"() => {{ const {{ stage }} = {player}; stage.paintBundles = {paint}; {player}.draw(); }}"
        )
        png = base64.b64decode(shown.pixels().partition(",")[2])
        return np.asarray(Image.open(io.BytesIO(png))).astype(int)

    painted, traced, none = (
        picture(),
        picture("stage.traceBundles"),
        picture("() => {}"),
    )
    covered = (traced != none).any(axis=2)
    assert covered.mean() > 0.05
    assert not (painted == traced).all(), "both were drawn in one way"
    # The same colors on the whole, and in the same places.
    assert painted[covered].mean(axis=0) == pytest.approx(traced[covered].mean(axis=0), abs=shades)
    assert np.median(np.abs(painted - traced)[covered]) < 2.0 * shades
    # They lie alike on all sides of the middle.
    changed = np.abs(painted - none).sum(axis=2)
    for along in (0, 1):
        middle = (changed.sum(axis=1 - along) @ np.arange(changed.shape[along])) / changed.sum()
        assert middle == pytest.approx((changed.shape[along] - 1) / 2.0, abs=0.02)


def test_many_discs_that_turn_with_the_drum_are_where_they_are(show):
    frames = replace(crowd(33 * 33), drum_angles=np.array([math.pi / 6.0]))
    shown = show(Player(frames).page(autoplay=False))
    shown.part("marks").uncheck()
    shown.part("corotating").check()
    spacing = 0.26 / 32.0
    inside = (243, 245, 247)
    for x, y in ((0.0, 0.0), (10 * spacing, 4 * spacing), (-13 * spacing, 9 * spacing)):
        # Turned back by the drum's angle.
        turned = complex(x, y) * np.exp(-1j * math.pi / 6.0)
        assert shown.color(turned.real, turned.imag) == (68, 1, 84)
        between = complex(x + 0.5 * spacing, y + 0.5 * spacing) * np.exp(-1j * math.pi / 6.0)
        assert shown.color(between.real, between.imag) == inside
