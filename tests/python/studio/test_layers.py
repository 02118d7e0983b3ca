"""Layers of the studio: forces at contacts and occupancy, as they are and as they are drawn."""

import math
import struct

import numpy as np
import pytest

import drumrs
from drumrs.studio import Session
from drumrs.viewer.forces import contact_forces


def unpacked(forces: bytes) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    """Return end of the scale, two numbers and forces of a small load's contacts."""
    end, least = struct.unpack_from("<2d", forces)
    one, other = np.frombuffer(forces, "<u2", offset=16, count=2 * ((len(forces) - 16) // 5)).reshape(2, -1)
    found = np.frombuffer(forces, "<u1", offset=16 + 4 * len(one)) / 255.0 * end
    assert 0.0 < least < end
    return end, one, other, found


def test_a_bundle_that_rolls_to_and_fro_is_borne_as_a_pendulum_is():
    config = drumrs.baseline(baffles=False).softer(1000.0).replace({"load.count": 1, "rotation.rpm": 0.0})
    with Session(config, playing=False) as session:
        session.advance(round(4.0 / config.derived.time_step))
        _, one, other, force = unpacked(session.view.forces)
        now, mass = session.view.now, session._simulation.masses[0]
    (x, y), speed = now.positions[0, 0], now.speeds[0, 0]
    # The drum holds up the weight's part along the radius, and keeps the bundle on its circle.
    expected = mass * (9.81 * -y / math.hypot(x, y) + speed**2 / math.hypot(x, y))
    assert force == pytest.approx([expected], rel=0.02)
    # The second number is a direction behind the number of bundles, in 256ths of a turn.
    assert one.tolist() == [0]
    assert other - 1 == pytest.approx(math.atan2(y, x) / math.tau % 1.0 * 256.0, abs=0.5)


def test_forces_are_those_of_the_frame_that_is_shown():
    config = drumrs.baseline(fill=0.3, baffles=True).softer(100.0)
    with Session(config, playing=False) as session:
        session.advance(20_000)
        view = session.view
        end, one, other, force = unpacked(view.forces)
        found = contact_forces(config, view.now)
    known = dict(zip(map(tuple, found.discs), found.forces, strict=True))
    within = other < view.now.count
    told = dict(zip(zip(one[within], other[within], strict=True), force[within], strict=True))
    assert len(told) > 20
    for pair, value in told.items():
        assert value == pytest.approx(min(known[pair], end), abs=end / 255.0)
    missed = [value for pair, value in known.items() if pair not in told]
    assert max(missed, default=0.0) <= 0.04 * end
    assert (~within).sum() == (found.drum_forces > 0.03 * end).sum()


def test_forces_come_and_go_with_their_box(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.3")
    studio.part("play").click()
    studio.wait("!studio.playing")
    # With the measures of this moment comes the last picture.
    studio.wait("studio.curves.axes.window?.[1] > studio.recording.end - 1e-9")
    plain = studio.pixels()
    # It stands still, and yet forces come with the picture that stands.
    studio.part("forces").check()
    studio.wait("studio.recording.frames.at(-1).forces")
    studio.wait("studio.part('layers').textContent.includes('full width from')")
    drawn = studio.pixels()
    assert drawn != plain
    found = contact_forces(studio.session.case(), studio.session.view.now)
    forces = studio.page.evaluate(
        "(({ one, other, shares }) => [[...one], [...other], [...shares]])(studio.recording.frames.at(-1).forces)"
    )
    scale = studio.page.evaluate("studio.recording.forceScale.end")
    pairs = dict(zip(map(tuple, found.discs.tolist()), found.forces, strict=True))
    count = studio.session.view.now.count
    for one, other, share in zip(*forces, strict=True):
        if other < count:
            assert share == pytest.approx(min(pairs[one, other] / scale, 1.0), abs=0.01)
    # Of a line that is lost they come again.
    studio.page.evaluate("studio.recording.frames.forEach((frame) => delete frame.forces)")
    studio.page.evaluate("studio.live.socket.close()")
    studio.wait("studio.live.socket.readyState === WebSocket.OPEN && studio.recording.frames.at(-1).forces")
    studio.part("forces").uncheck()
    studio.part("play").click()
    studio.wait("studio.playing && !studio.recording.frames.at(-1).forces")
    assert studio.part("layers").inner_text() == ""


AREA = """() => {
  const { map } = studio.stage.occupancy;
  const side = 2 * studio.recording.reach / map.size;
  let covered = 0;
  for (let k = 0; k < map.size ** 2; k++) covered += map.share(k) * side * side;
  return [covered, map.from, map.to];
}"""


def test_occupancy_builds_up_since_the_last_change(show):
    studio = show()
    studio.wait("studio.recording?.end > 0.5")
    studio.part("occupied").check()
    studio.wait("studio.stage.map.to > 1")
    area, begin, _ = studio.page.evaluate(AREA)
    # Wherever the bundles have been, they covered their own area all the time.
    radii = studio.session.view.now.radii
    assert area == pytest.approx(math.pi * (radii**2).sum(), rel=0.02)
    # Pictures from before the box was checked count.
    assert begin == studio.page.evaluate("studio.recording.frames[2].time")
    words = studio.part("layers").inner_text()
    assert words.startswith("Blue: how often bundles cover a place, from never to always, in ")
    now = studio.time
    studio.slide("rotation.rpm", 70)
    studio.wait("studio.speed === 70")
    studio.wait("studio.stage.map.to > studio.stage.map.from")
    assert studio.page.evaluate(AREA)[1] >= now
    # Another drum has another map.
    studio.slide("load.fill", 0.2)
    studio.wait("studio.recording.count === 80 && studio.stage.map.to > 0.3")
    assert studio.page.evaluate(AREA)[0] == pytest.approx(2.0 * area, rel=0.02)


def test_a_load_that_rests_is_there_all_the_time(show):
    studio = show(reduced_motion="reduce")
    studio.wait("studio.recording && studio.playing === false")
    studio.wait(f"Math.abs(studio.recording.end - {studio.session.view.now.times[0]}) < 1e-9")
    studio.part("occupied").check()
    studio.page.evaluate("studio.since = studio.recording.end")
    studio.page.evaluate("studio.cover()")
    script = """places => {
      const { map } = studio.stage.occupancy;
      const cell = (place) => Math.floor((place / studio.recording.reach + 1) * map.size / 2);
      return places.map(([x, y]) => map.share(cell(y) * map.size + cell(x)));
    }"""
    places = studio.session.view.now.positions[0].tolist()
    assert studio.page.evaluate(script, places) == pytest.approx([1.0] * 40)
    assert studio.page.evaluate(script, [[0.0, 0.2374]]) == [0.0]
