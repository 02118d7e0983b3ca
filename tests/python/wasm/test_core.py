"""The core in WebAssembly, run by node: the same bits as the core in Python."""

import hashlib
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import drumrs
import live_drum
from drumrs.simulation import Simulation

# Three quarters of a second: the load has fallen, and is carried up.
STEPS = 20_000
_LAWS = {
    f"contact.{side}.{key}": value
    for side in ("bundle", "drum")
    for key, value in (("rolling_friction", 0.05), ("tangential_damping_ratio", 0.1), ("adhesion", 2.0))
}
_HERTZ = {"contact.base": "hertz", "contact.bundle.young_modulus": 1e6, "contact.drum.young_modulus": 1e6}
CASES = {
    "bare": {},
    "three baffles": {"drum.baffles.count": 3},
    "every term of the law": _LAWS,
    "Hertz and Mindlin": {**_HERTZ, "run.time_step": "auto"},
    "a ramp": {"rotation.program": [[0.0, 54.0], [0.2, 54.0], [0.5, 80.0]]},
}


def _simulation(changes) -> Simulation:
    return Simulation(drumrs.baseline(fill=0.25).softer(100.0).replace(changes), seed=1)


def _digests(simulation) -> dict[str, str]:
    row = simulation.series.tail(1).to_numpy().ravel()
    arrays = {
        "positions": simulation.positions,
        "velocities": simulation.velocities,
        "angles": simulation.angles,
        "last_sample": row,
    }
    return {
        name: hashlib.sha256(np.ascontiguousarray(array, "<f8").tobytes()).hexdigest()
        for name, array in arrays.items()
    }


def run(cases, folder=live_drum.BUILT):
    """Run cases with node; what run.mjs tells of each."""
    script = Path(__file__).with_name("run.mjs")
    done = subprocess.run(
        [shutil.which("node"), script, folder],
        input=json.dumps(cases),
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_bits_are_those_of_the_native_core():
    natives, cases = [], []
    for changes in CASES.values():
        simulation = _simulation(changes)
        config = simulation.config.to_core_json()
        cases.append({"config": config, "seed": 1, "steps": STEPS, "then": None})
        simulation.run(steps=STEPS)
        natives.append(simulation)
    for name, native, told in zip(CASES, natives, run(cases), strict=True):
        assert told["columns"] == native.series.columns, name
        assert told["time"] == native.time, name
        digests = _digests(native)
        assert {key: told[key] for key in digests} == digests, name
    # All of them differ: the digests see what was run.
    assert len({_digests(native)["positions"] for native in natives}) == len(CASES)


def test_another_speed_under_way_has_the_same_bits():
    simulation = _simulation({})
    config = simulation.config.to_core_json()
    simulation.run(steps=500)
    simulation.set_speed(70.0)
    then = {"config": simulation.config.to_core_json(), "steps": STEPS}
    simulation.run(steps=STEPS)
    [told] = run([{"config": config, "seed": 1, "steps": 500, "then": then}])
    digests = _digests(simulation)
    assert {key: told[key] for key in digests} == digests


def test_what_is_refused_is_said_as_in_python():
    config = json.loads(_simulation({}).config.to_core_json())
    config["load"]["count"] = 1000
    case = {"config": json.dumps(config), "seed": 1, "steps": 1, "then": None}
    with pytest.raises(AssertionError, match=r"no more bundles of diameter 0\.02375 m fit into this drum"):
        run([case])
