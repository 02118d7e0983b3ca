"""Cases of measures on made-up loads fail where a formula is wrong: one is changed in the source, and seen to."""

import inspect
import sys
from types import ModuleType

import pytest

from drumrs import measures  # noqa: F401 - loads its modules
from drumrs.verification import catalog

# Case, module of drumrs.measures, what stands there, what is wrong.
WRONG = [
    ("charge", "surface", "self.tilt + math.atan(", "self.tilt - 0.1 + math.atan("),
    ("charge", "surface", "- self.bundle_radius\n", "+ self.bundle_radius\n"),
    ("charge", "shape", "centers[:, 0] / drum_radius", "-centers[:, 0] / drum_radius"),
    ("charge", "shape", "math.atan2(x, -y)", "math.atan2(x, y)"),
    ("charge", "toe", "_HALF = 0.5", "_HALF = 0.0"),
    (
        "occupancy",
        "shape",
        "tree.query_ball_point(positions, seen.radii)",
        "tree.query_ball_point(positions, seen.radii / 2)",
    ),
    (
        "mixing-null",
        "cells",
        "float(cells.max()) / (len(cells) - 1.0)",
        "float(cells.max()) / len(cells) * 1.1",
    ),
    ("mixing-known", "cells", "weights * colored) / all_of_it", "colored) / np.bincount(cells)"),
    ("mixing-known", "cells", "entr(shares) + entr(1.0 - shares)", "shares * (1.0 - shares)"),
    ("mixing-null", "segregation", "(count - 1.0)", "(count - 30.0)"),
    ("mixing-null", "segregation", "(inside - share)", "(inside - share**2)"),
    ("mixing-known", "cells", "(pure - null)", "pure"),
    ("mixing-known", "cells", "/ colored.mean()", ""),
    ("mixing-known", "segregation", "places - places.min(axis=0)", "places"),
    ("mixing-known", "segregation", "compute_uv=False)[0]", "compute_uv=False)[0] ** 2"),
    ("mixing-known", "segregation", "/ points.std(axis=0)", ""),
    ("mixing-known", "segregation", "means[0] / means[1]", "means[1] / means[0]"),
    ("mixing-known", "rate", "- self.delay, 0.0)", "+ self.delay, 0.0)"),
]


@pytest.mark.parametrize(("name", "module", "right", "wrong"), WRONG)
def test_a_wrong_formula_fails_its_case(monkeypatch, name, module, right, wrong):
    [case] = catalog.chosen([name])
    change(monkeypatch, sys.modules[f"drumrs.measures.{module}"], right, wrong)
    trial = case.run()
    assert trial.error is None
    assert not trial.passed, trial.evidence.worst


def change(monkeypatch, module: ModuleType, right: str, wrong: str) -> None:
    """Put what a changed source defines in the place of what the module defines, wherever that is imported."""
    source = inspect.getsource(module)
    assert source.count(right) == 1, right
    changed = ModuleType(module.__name__)
    monkeypatch.setitem(sys.modules, module.__name__, changed)  # dataclasses look there
    exec(compile(source.replace(right, wrong), str(module.__file__), "exec"), changed.__dict__)
    monkeypatch.setitem(sys.modules, module.__name__, module)
    for name, now in vars(module).items():
        if getattr(now, "__module__", None) == module.__name__ and name in vars(changed):
            for other in [one for key, one in sys.modules.items() if key.startswith("drumrs.measures")]:
                for alias, value in list(vars(other).items()):
                    if value is now:
                        monkeypatch.setattr(other, alias, vars(changed)[name])
