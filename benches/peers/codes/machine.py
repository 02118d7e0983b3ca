"""What a measurement ran on: CPU, versions; and a core, with nobody else on it where that is allowed."""

import os
import platform
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import drumrs


def pin(core: int | None, priority: int | None) -> None:
    """Keep this process and those it starts on one core, and ahead of all others with a real-time priority.

    Says so where the system halts such work for a part of every second, as Linux does by default: short timings that
    it falls into come out a tenth or more too long.

    Raises
    ------
    OSError
        Where the system does not allow it.
    """
    if core is not None:
        os.sched_setaffinity(0, {core})
    if priority is not None:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
        share = Path("/proc/sys/kernel/sched_rt_runtime_us")
        if share.exists() and share.read_text(encoding="ascii").strip() != "-1":
            sys.stderr.write(
                "the kernel halts work of this priority for a part of every second, which falls into some timings; "
                "`sysctl kernel.sched_rt_runtime_us=-1` lets it run\n"
            )
    os.environ["OMP_NUM_THREADS"] = "1"


def cpu() -> str:
    """Return the name of the CPU and the number of its cores here."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        text = ""
    found = re.search(r"^model name\s*:\s*(.+)$", text, re.MULTILINE)
    name = found[1] if found else platform.processor() or platform.machine()
    return f"{name}, {os.cpu_count()} cores"


def versions() -> dict[str, str]:
    """Return the version of each code that is here."""
    found = {"drumrs": drumrs.__version__}
    asked = {"LAMMPS": ["lmp", "-h"], "LIGGGHTS": ["liggghts", "-h"], "Yade": ["yade", "--version"]}
    patterns = {
        "LAMMPS": r"Simulator - ([^\n]+)",
        "LIGGGHTS": r"Version LIGGGHTS-PUBLIC ([0-9.]+)",
        "Yade": r"Yade version: (\S+)|^(\d\S+)",
    }
    for name, words in asked.items():
        printed = _printed(words)
        match = re.search(patterns[name], printed, re.MULTILINE)
        if match is not None:
            found[name] = next(filter(None, match.groups()))
    return found


def _printed(words: list[str]) -> str:
    # LIGGGHTS leaves a log where it is started.
    with tempfile.TemporaryDirectory() as folder:
        try:
            done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
        except (OSError, subprocess.TimeoutExpired):
            return ""
    return done.stdout + done.stderr
