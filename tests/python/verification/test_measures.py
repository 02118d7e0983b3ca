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
    ("charge", "toe", "_HALF = 0.5", "_HALF = 1.5"),
    ("charge", "toe", "_upright(middle - behind)", "_upright(behind - middle)"),
    (
        "occupancy",
        "shape",
        "tree.query_ball_point(positions, selected.radii)",
        "tree.query_ball_point(positions, selected.radii / 2)",
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
    ("unbalance", "balance", "moment @ turn_back(angle)", "moment"),
    ("unbalance", "balance", "lengths / mass", "lengths"),
    ("unbalance-force", "balance", "0.5 * (angles[1:] + angles[:-1])", "angles[1:]"),
    ("unbalance-force", "balance", "np.sinc(swept / (2.0 * np.pi))", "1.0"),
    ("suspension", "balance", "self.damping * (angular_velocity", "0.5 * self.damping * (angular_velocity"),
    (
        "suspension",
        "balance",
        "np.hypot(self.stiffness, self.damping",
        "np.hypot(self.stiffness, 0.9 * self.damping",
    ),
    ("suspension", "balance", "self.stiffness - mass", "self.stiffness - self.tub_mass"),
    ("davis", "orbit", "0.5 * math.pi + 3.0 * release", "0.5 * math.pi + 2.0 * release"),
    ("davis", "orbit", "4.0 * sine**2 * froude", "4.0 * sine * froude"),
    ("davis", "orbit", "2.0 * froude * sine / math.pi", "2.0 * sine / math.pi"),
    ("davis", "orbit", "1.0 + 8.0 * sine**2", "1.0 + 4.0 * sine**2"),
    ("davis", "orbit", "- 3.0 * sine", "- sine"),
    ("flight", "airborne", "mean_with_error(flies @ weights", "mean_with_error(0.8 * flies @ weights"),
    ("flight", "airborne", "before[:, 1] - after[:, 1]", "before[:, 1]"),
    ("flight", "airborne", "(turns * seen.count)", "seen.count"),
    ("flight", "airborne", "- np.hypot(*places.T)", "- places[:, 0]"),
    ("flight", "airborne", "_HEAD, _TOE = 0.99, 0.05", "_HEAD, _TOE = 0.9, 0.05"),
    ("flight", "airborne", "- 0.5 * math.pi) %", "+ 0.5 * math.pi) %"),
    ("spectrum", "spectra", "per_decade * np.log10(marks)", "per_decade * np.log(marks)"),
    ("spectrum", "spectra", "power[::-1])[::-1]", "power)"),
    ("spectrum", "spectra", "np.cumsum(events[::-1])[::-1] / (", "np.cumsum(events) / ("),
    (
        "spectrum",
        "spectra",
        '("dissipated_tangential",),\n    "rolling"',
        '("dissipated_normal",),\n    "rolling"',
    ),
    ("spectrum", "spectra", "_ENDURES = 3.0", "_ENDURES = 6.0"),
    ("spectrum", "spectra", "np.minimum(own[there]", "np.maximum(own[there]"),
    ("spectrum", "collisions", "sums / (mass * interval)", "sums / interval"),
    ("spectrum", "collisions", "at_part == place", "at_part != place"),
    ("spectrum", "collisions", "0.5 * sums[-1]", "0.95 * sums[-1]"),
    ("wear", "walls", "/ turns if turns", "* turns if turns"),
    ("wear", "walls", "at_part == k", "at_part != k"),
    ("washing", "laundry", '(energies / table["mass"])', "energies"),
    ("wear", "walls", "np.sin(2.0 * gamma) - 3.0", "np.sin(2.0 * gamma) - 2.0"),
    ("wear", "walls", "np.cos(gamma) ** 2 / 3.0", "np.cos(gamma) / 3.0"),
    ("wear", "walls", "coefficient / turns", "coefficient * turns"),
    ("wear", "walls", "volume / length)", "volume)"),
    ("wear", "walls", "middles - smooth", "middles + smooth"),
    ("wear", "walls", "0.25 * padded[:-2]", "0.5 * padded[:-2]"),
    ("fields", "coarse_graining", "(1.0 - math.exp(-0.5 * CUT**2))", "1.0"),
    ("fields", "coarse_graining", "off = velocity - grid.at(mean, place)", "off = velocity"),
    ("fields", "coarse_graining", "0.5 * trace", "trace"),
    ("fields", "coarse_graining", "-place[:, 1], place[:, 0]", "-place[:, 1], 0.9 * place[:, 0]"),
    ("fields", "coarse_graining", "node + shift", "node - shift"),
    ("fields", "coarse_graining", "math.pi * frames.radii**2", "math.pi * frames.radii"),
    ("fields", "motion", "swept * len(swept)", "swept * len(apart)"),
    (
        "stress-of-a-stack",
        "cell_sums",
        "np.pad(table[name].to_numpy().reshape(count, count), margin)",
        "np.pad(table[name].to_numpy().reshape(count, count).T, margin)",
    ),
    ("stress-of-a-ring", "cell_sums", "- _product(center, center)", ""),
    ("stress-of-a-ring", "cell_sums", "np.swapaxes(gradient, -1, -2)", "gradient"),
    ("flowing-layer", "profile", "surface - offset / (self", "surface - rate / (self"),
    ("flowing-layer", "profile", "self.surface - self.foot", "self.surface + self.foot"),
    ("flowing-layer", "profile", "_HALF = 0.5", "_HALF = 0.1"),
    ("washing", "laundry", "4.0 * math.pi * outline.area", "math.pi * outline.area"),
    (
        "washing",
        "laundry",
        "np.arcsin(np.minimum(size / distance, 1.0))",
        "0.5 * np.arcsin(np.minimum(size / distance, 1.0))",
    ),
    ("washing", "laundry", "to_tangent, to_end", "to_end, to_tangent"),
    ("washing", "laundry", "np.maximum(left, reached)", "left"),
    ("washing", "laundry", "std(axis=1) / speeds.mean", "std(axis=1) * speeds.mean"),
    ("washing", "laundry", "~of_the_load", "of_the_load"),
    ("washing", "laundry", '"dissipated_tangential") if name', '"dissipated_normal") if name'),
    ("frequency-spectrum", "signals", "1.0 / rows.interval", "0.9 / rows.interval"),
    ("frequency-spectrum", "signals", 'detrend="constant"', "detrend=False"),
    ("frequency-spectrum", "signals", "np.mean(values**2)", "np.mean(values) ** 2"),
    ("wear-locked-disc", "walls", '"archard": "normal_force_slip"', '"archard": "normal_impulse"'),
    (
        "contact-sums",
        "spectra",
        '"dissipated_tangential": ("dissipated_sliding", "dissipated_tangential")',
        '"dissipated_tangential": ("dissipated_tangential",)',
    ),
    ("regimes", "regimes", "** 2 * surface.drum_radius / gravity", "* surface.drum_radius / gravity"),
    ("regimes", "regimes", "weights[throws[", "0.1 * weights[throws["),
    ("regimes", "regimes", "np.median(energy)", "energy.max()"),
    ("regimes", "motion", "turned - driven) <= _NEAR", "turned - driven) >= _NEAR"),
    ("regimes", "surface", "inner[0]) @ np.array([-chord", "inner[0]) @ np.array([chord"),
    ("regimes", "motion", "1.0 - found.value", "found.value"),
    ("regimes", "depth", "[top] ** 2)", "[~top] ** 2)"),
    ("zone-visits", "zones", "stays - residence / cycle * cycles", "stays"),
    ("zone-visits", "zones", "self.variance * self.cycle / time", "self.variance / time"),
    ("zone-visits", "zones", "np.diff(own)", "own[1:] - over[: len(own) - 1]"),
    ("recorded-visits", "zones", "2.0 * ratio * sums", "ratio * sums"),
    ("recorded-visits", "zones", 'sums["stay"] / count, sums', 'sums["stay"], sums'),
    ("davis-simulated", "orbit", "0.5 * math.pi + 3.0 * release", "0.5 * math.pi + 2.9 * release"),
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
