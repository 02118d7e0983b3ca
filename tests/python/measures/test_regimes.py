"""The regime: limits that are set decide, and a drum at rest has none."""

import numpy as np
import pytest

from drumrs import measures
from drumrs.errors import ConfigError
from drumrs.verification import made_up

WINDOW = (0.0, 1.0)
BED = made_up.lattice(0.06)


def riding(turned: float):
    angles = np.linspace(0.0, turned, 17)
    load = BED[BED[:, 1] < -0.4]
    places = [load @ made_up.turned(angle) for angle in angles]
    contacts = np.full((17, len(load)), 2, dtype=np.uint16)
    return made_up.frames(places, 0.06, drum_angles=angles, contacts=contacts)


def test_limits_decide():
    found = measures.regime(riding(2.0 * np.pi), WINDOW)
    assert (found.name, found.carried_round) == ("centrifuging", pytest.approx(1.0))
    limits = measures.RegimeLimits(centrifuging=1.5, partly_centrifuging=1.2, cascading=10.0)
    assert measures.regime(riding(2.0 * np.pi), WINDOW, limits).name == "rolling"


def test_clockwise_is_the_same_regime():
    one, other = (measures.regime(riding(turned), WINDOW) for turned in (6.0, -6.0))
    assert one.name == other.name
    assert one.wall_slip == pytest.approx(other.wall_slip, abs=1e-9)


def test_slip_of_a_drum_that_turns_to_and_fro_and_rests():
    angles = np.concatenate([np.linspace(0.0, 1.0, 9), np.full(4, 1.0), np.linspace(1.0, 0.0, 9)])
    load = BED[BED[:, 1] < -0.4]
    for follows, slip in ((1.0, 0.0), (0.25, 0.75)):
        places = [load @ made_up.turned(follows * angle) for angle in angles]
        frames = made_up.frames(places, 0.06, drum_angles=angles)
        assert measures.wall_slip(frames, (0.0, 100.0)).value == pytest.approx(slip, abs=1e-9)


def test_a_drum_at_rest_has_no_regime():
    with pytest.raises(ConfigError, match="one in which the drum turns"):
        measures.regime(riding(0.0), WINDOW)
