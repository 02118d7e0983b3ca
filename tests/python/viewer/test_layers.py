"""Layers of the player in a browser: forces at contacts, what discs recorded, occupancy."""

import math
from dataclasses import replace

import numpy as np
import polars as pl
import pytest

import drumrs
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
