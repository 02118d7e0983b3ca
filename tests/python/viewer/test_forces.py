"""Forces at the contacts of frames: those that the core's springs have at the same moment."""

import base64
from dataclasses import replace

import numpy as np
import pytest

import drumrs
from drumrs.frames import Frames
from drumrs.viewer.forces import contact_forces
from drumrs.viewer.recording import pack

SPECIES = [
    {"name": "small", "share": 0.5, "diameter": 0.02, "contact": {"normal_stiffness": 2e5}},
    {"name": "large", "share": 0.5, "diameter": 0.03},
]


def frames_of(simulation: drumrs.Simulation) -> Frames:
    """Return a frame of a simulation as it is now, in double precision."""
    state, kept = simulation.state, simulation.frames
    return replace(
        kept.picked(slice(0, 1)),
        drum_angles=np.array([state.drum_angle]),
        positions=np.array([state.positions]),
    )


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"load.species": SPECIES, "load.share_by": "mass"},
        {"contact.base": "hertz", "contact.bundle.young_modulus": 2e6, "contact.drum.young_modulus": 2e6},
        {"drum.liner.rail.count": 8, "drum.liner.rail.height": 0.02, "drum.liner.rail.width": 0.03},
    ],
)
def test_contacts_and_their_elastic_energy_are_those_of_the_core(settings):
    config = drumrs.baseline(fill=0.4, baffles="drum.liner.rail.count" not in settings).softer(1000.0)
    config = config.replace({"run.duration": 0.5, **settings})
    simulation = drumrs.Simulation(config.replace({"run.sample_every": drumrs.Simulation(config).time_step}))
    simulation.run(duration=0.5)
    assert simulation.series["time"][-1] == simulation.time
    found, contacts = contact_forces(config, frames_of(simulation)), simulation.state.contacts
    pairs, walls = (
        [body for body, overlap in zip(bodies, contacts[kind]["overlap"], strict=True) if overlap > 0.0]
        for kind, bodies in (
            ("pairs", zip(contacts["pairs"]["particle"], contacts["pairs"]["other"], strict=True)),
            ("walls", contacts["walls"]["particle"]),
        )
    )
    assert sorted(map(sorted, found.discs.tolist())) == sorted(map(sorted, pairs))
    assert sorted(found.at_drum.tolist()) == sorted(walls)
    # A spring with F ∝ δⁿ holds F δ/(n + 1).
    positions, radii = simulation.positions, simulation.radii
    one, other = found.discs.T
    overlaps = radii[one] + radii[other] - np.hypot(*(positions[one] - positions[other]).T)
    order = np.argsort(contacts["walls"]["particle"], kind="stable")
    depths = contacts["walls"]["overlap"][order]
    drum_forces = found.drum_forces[np.argsort(found.at_drum, kind="stable")]
    energy = found.forces @ overlaps + drum_forces @ depths[depths > 0.0]
    power = 2.5 if config.contact.base == "hertz" else 2.0
    assert energy / power == pytest.approx(simulation.series["elastic_normal"][-1], rel=1e-6)


def test_a_touch_points_to_the_drum():
    config = drumrs.baseline(fill=0.4, baffles=True).softer(1000.0).replace({"run.duration": 0.3})
    frames = drumrs.run(config, progress=False).frames
    last = frames.picked(slice(len(frames) - 1, None))
    found = contact_forces(config, last)
    x, y = last.positions[0, found.at_drum].T
    at_rim = np.hypot(x, y) > 0.2375 - last.radii[found.at_drum]
    outwards = np.arctan2(y, x)[at_rim]
    apart = np.abs(np.angle(np.exp(1j * (found.directions[at_rim] - outwards))))
    assert np.median(apart) < 1e-6
    assert len(outwards) > 20


def test_a_page_holds_the_strongest_contacts(monkeypatch):
    config = drumrs.baseline(fill=0.4).softer(1000.0).replace({"run.duration": 0.3})
    frames = drumrs.run(config, progress=False).frames

    def counts() -> tuple[np.ndarray, float]:
        forces = pack(frames, None, "", None, config=config)["forces"]
        return np.frombuffer(base64.b64decode(forces["counts"]), "<u4"), forces["least"] / forces["scale"]

    whole, least = counts()
    assert least == pytest.approx(0.03)
    assert len(whole) == len(frames)
    monkeypatch.setattr("drumrs.viewer.recording.MOST_FORCES", 100)
    few, greater = counts()
    assert 95 <= few.sum() <= 105 < whole.sum()
    assert greater > least
