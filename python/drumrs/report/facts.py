"""Facts about how the numbers came about: versions, machines, time, and how to cite."""

import platform
import sys
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

from drumrs.report.findings import Findings
from drumrs.report.table1 import power
from drumrs.simulation import info

# The citation, as in CITATION.cff.
SOFTWARE = "drumrs: discrete-element simulation of loads tumbling in a rotating drum"
AUTHORS = "The drumrs authors"
PAPER = "Dynamic Analysis of Fabric in a Rotating Horizontal Drum Using the Discrete Element Method"
PAPER_AUTHORS = "J. Park and C. R. Wassgren"

_LIBRARIES = ("numpy", "polars", "matplotlib", "pydantic", "jinja2")
_HOUR, _MINUTE = 3600.0, 60.0


def versions() -> dict[str, str]:
    """Return what computed this, by name."""
    about = info()
    own = {
        "drumrs": f"{about['version']} ({about['build_profile']} build, physics {about['physics_version']})",
        "built for": str(about["target"]),
        "Python": sys.version.split()[0],
    }
    return {**own, **{name: version(name) for name in _LIBRARIES}}


def machine() -> dict[str, str]:
    """Return what this machine is, by name."""
    about = info()
    features = about["cpu_features"]
    shown = " ".join(features) if isinstance(features, (list, tuple)) else str(features)
    return {
        "processor": _processor(),
        "cores": str(about["cpu_count"]),
        "instructions": shown,
        "system": f"{platform.system()} {platform.machine()}",
    }


def _processor() -> str:
    told = Path("/proc/cpuinfo")
    lines = told.read_text(encoding="utf-8").splitlines() if told.is_file() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or "not known"


def times(findings: Findings) -> dict[str, str]:
    """Return what was computed and how long it took, by name."""
    facts = findings.sweep.facts(findings.folder)
    steps = sum(case.cost for case in findings.sweep.cases if case.id in set(facts["case"]))
    spent = float(facts["wall_time"].sum())
    told = {
        "runs finished": f"{findings.table.height} of {len(findings.sweep)}",
        "particle-steps": power(steps),
        "computing time, all runs": duration(spent),
    }
    if spent > 0.0:
        told["speed of one run"] = f"{steps / spent / 1e6:.3g} million particle-steps per second"
    if findings.wall_time is not None:
        told["time of the last call"] = duration(findings.wall_time)
    machines = sorted({name for name in facts["machine"] if name})
    if len(machines) > 1:
        told["machines"] = ", ".join(machines)
    return {**told, "report written": now()}


def now() -> str:
    """Return date and time, in UTC."""
    return f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC"


def duration(seconds: float) -> str:
    """Write a time as people say it.

    Examples
    --------
    >>> duration(42.3), duration(125.0), duration(9000.0)
    ('42 s', '2 min 5 s', '2 h 30 min')
    """
    whole = round(seconds)
    if whole < _MINUTE:
        return f"{whole} s"
    if whole < _HOUR:
        return f"{whole // 60} min {whole % 60} s" if whole % 60 else f"{whole // 60} min"
    return f"{whole // 3600} h {whole % 3600 // 60} min"
