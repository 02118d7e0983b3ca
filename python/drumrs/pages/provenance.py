"""How numbers came about: versions, machine, time."""

import platform
import sys
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

from drumrs.simulation import info

_LIBRARIES = ("numpy", "polars", "matplotlib", "pydantic", "jinja2")


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


def now() -> str:
    """Return date and time, in UTC."""
    return f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC"
