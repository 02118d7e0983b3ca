"""Visits to a zone, of discs that come by the clock, and of discs that come by chance."""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import Frames, State, measures
from drumrs.measures.recorded import required
from drumrs.verification import made_up, scenes
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace

Array = NDArray[np.float64]

_RIGHT = [[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]]
_STAY, _AWAY, _DISCS, _LONG = 20, 60, 400, 4000
# Frames between two visits at least.
_LEAST = 3


@case(
    "zone-visits",
    source="renewal theory; direct count",
    formula="spread = √(Var(W − (w̄/c̄) C) c̄/t)/w̄: 0 by the clock, σ_C/c̄ √(c̄/t) for visits of one length",
    cost=1e5,
)
def zone_visits() -> Evidence:
    """Visits of one length, after equal times and after times that chance draws; their spread, counted disc by disc.

    By the clock: round-off. By chance: five standard errors of the mean cycle, and 5 % of its deviation; the spread
    over 400 discs is known to one in √800, three and a half of which are allowed for.
    """
    interval = made_up.INTERVAL
    clock = measures.zone_visits(_frames(np.full((50, 20), float(_AWAY))), (0.0, 1e9), _RIGHT)
    found = [
        Check("residence by the clock", "s", _STAY * interval, clock.residence, 1e-12),
        Check("cycle by the clock", "s", (_STAY + _AWAY) * interval, clock.cycle, 1e-12),
        Check("spread by the clock", "1", 0.0, clock.spread(10.0), 1e-9),
    ]
    draws = np.random.default_rng(9)
    gaps = np.floor(draws.exponential(_AWAY, (_DISCS, 3 * _LONG // _STAY)))
    frames = _frames(_LEAST + gaps)
    chance = measures.zone_visits(frames, (0.0, 1e9), _RIGHT)
    mean, deviation = _STAY + _LEAST + _AWAY - 0.5, float(_AWAY)
    error = 5.0 * deviation / math.sqrt(chance.count)
    time = _LONG * interval
    exact = deviation / mean * math.sqrt(mean / _LONG)
    # The first visits begin together; what is counted begins later.
    inside = frames.positions[_LONG // 4 :, :, 0] > 0.0
    spent = inside.sum(axis=0)
    counted = float(spent.std() / spent.mean()) * math.sqrt(len(inside) / _LONG)
    found += [
        Check("residence by chance", "s", _STAY * interval, chance.residence, 1e-12),
        Check("cycle by chance", "s", mean * interval, chance.cycle, error * interval),
        Check("spread by chance", "1", exact, chance.spread(time), 0.05 * exact),
        Check(
            "spread by chance, counted",
            "1",
            counted,
            chance.spread(time),
            3.5 / math.sqrt(2.0 * _DISCS) * exact,
        ),
    ]
    times = np.geomspace(1.0, 100.0, 20)
    curve = deviation / mean * np.sqrt(mean * interval / times)
    trace = Trace("", times, [chance.spread(one) for one in times], (times, curve))
    return Evidence(tuple(found), Panel("time [s]", "spread", (trace,), logarithmic=True))


@case(
    "recorded-visits",
    source="kinematics",
    formula="half a turn, a turn from visit to visit, no spread; never out of a zone that turns along",
    cost=2e5,
)
def recorded_visits() -> Evidence:
    """A disc held to the rim of a drum that turns fast, without gravity, and zones whose visits the run counts.

    Zones are looked at every 32 steps: one look for each end of a visit, and (2 looks)² for the variance.
    """
    fast, orbit, turns = 12.0, scenes.DRUM_RADIUS - scenes.RADIUS, 15
    reach = 2.0 * scenes.DRUM_RADIUS
    half = [[0.0, -reach], [reach, -reach], [reach, reach], [0.0, reach]]
    zones = [
        {"name": "standing", "corners": half},
        {"name": "turning", "corners": [[x - 0.5 * orbit, y] for x, y in half], "frame": "drum"},
    ]
    changes = {
        "rotation.rpm": fast * 60.0 / math.tau,
        "gravity": (0.0, 0.0),
        "run.zone": zones,
    }
    config = scenes.drum(changes).softer(100.0)
    period = math.tau / fast
    state = State([[orbit, 0.0]], [[0.0, fast * orbit]], angular_velocities=[fast])
    run = scenes.after(config, state, turns * period, samples=6)
    table, look = run.result().zone_visits, 32.0 * run.time_step
    found = measures.recorded_visits(table, "standing")
    turning = required(table, "zone_visits", "this").filter(zone="turning")
    span = run.time - run.config.run.averaging_window[0]
    checks = [
        Check("whole visits", "1", turns // 3 - 1, found.count, 1.0),
        Check("time of a visit", "s", 0.5 * period, found.residence, look),
        Check("time from visit to visit", "s", period, found.cycle, look),
        Check("variance", "s²", 0.0, found.variance, (2.0 * look) ** 2),
        Check("visits to the zone that turns", "1", 0.0, float(turning["entries"].sum()), 0.0),
        Check("time in it", "s", span, float(turning["time_inside"].sum()), 2.0 * look),
    ]
    rows = [check.expected for check in checks[1:3]]
    trace = Trace("", rows, [check.measured for check in checks[1:3]], (rows, rows))
    return Evidence(tuple(checks), Panel("expected [s]", "measured [s]", (trace,)))


def _frames(away: Array) -> Frames:
    """Return discs that are on the left for so many frames, then on the right for a visit, again and again."""
    begins = (np.cumsum(away + _STAY, axis=1) - _STAY).astype(int)
    length = min(int(begins[:, -1].min()), _LONG + _LONG // 4)
    x = np.full((length, len(away)), -0.5)
    for disc, row in enumerate(begins):
        for first in row[row < length]:
            x[first : first + _STAY, disc] = 0.5
    return made_up.frames(np.stack([x, np.zeros_like(x)], axis=-1), 0.01)


CASES = (zone_visits, recorded_visits)
