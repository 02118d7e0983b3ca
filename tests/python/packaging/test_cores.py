"""The choice between the compiled cores of a wheel; `make wheel` tries both of them."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import drumrs
from drumrs import cores

BOTH = ["x86-64", "x86-64-v3"]
ALL = ["avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "lzcnt", "movbe", "sse4.2"]


def test_the_fast_core_runs_where_the_cpu_has_everything_it_needs():
    assert cores.choose(BOTH, ALL, {}) == "x86-64-v3"
    for feature in set(ALL) - {"sse4.2"}:
        assert cores.choose(BOTH, set(ALL) - {feature}, {}) == "x86-64"
    assert cores.choose(["x86-64"], ALL, {}) == "x86-64"
    assert cores.choose(["aarch64"], [], {}) == "aarch64"


def test_a_core_can_be_asked_for():
    assert cores.choose(BOTH, ALL, {"DRUMRS_CORE": "x86-64"}) == "x86-64"
    assert cores.choose(BOTH, ALL, {"DRUMRS_CORE": ""}) == "x86-64-v3"
    with pytest.raises(
        ImportError, match=r"^DRUMRS_CORE is 'v3', .* has the cores x86-64 and x86-64-v3; unset it$"
    ):
        cores.choose(BOTH, ALL, {"DRUMRS_CORE": "v3"})
    with pytest.raises(ImportError, match="but this CPU lacks fma; unset it"):
        cores.choose(BOTH, set(ALL) - {"fma"}, {"DRUMRS_CORE": "x86-64-v3"})
    # A build from source is for one CPU, whatever it lacks.
    assert cores.choose(["x86-64-v3"], [], {"DRUMRS_CORE": "x86-64-v3"}) == "x86-64-v3"


def test_a_second_core_beside_the_package_takes_the_place_of_the_first(tmp_path):
    # A copy of this core, loaded under the other's name.
    package = Path(drumrs.__file__).parent
    [core] = package.glob("_core.*so") or package.glob("_core*.pyd")
    target = tmp_path / core.name.replace("_core", "x86_64_v3")
    target.write_bytes(core.read_bytes())
    code = (
        "import json, sys; from pathlib import Path; import drumrs; from drumrs import cores; "
        f"cores._load(Path({str(target)!r})); from drumrs import _core; "
        "print(json.dumps([_core.__file__, sys.modules['drumrs._core'] is _core, _core.info()['core']]))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(ran.stdout) == [str(target), True, drumrs.info()["core"]]
