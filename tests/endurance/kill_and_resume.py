"""Fifty kills at random moments, of a sweep and of a run with checkpoints: each continued to byte-identical results.

python tests/endurance/kill_and_resume.py [KILLS]    # minutes
"""

import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SWEEP = """
seeds = 3
[base]
run.duration = 0.3
run.sample_every = 0.002
run.frame_every = 0.1
[axes]
load.fill = [0.05, 0.1]
drum.baffles.count = [0, 3]
"""
RUN = ["--set", "run.duration=3.0", "--set", "load.fill=0.1", "--set", "run.checkpoint_every=0.05"]
RUN += ["--set", "run.frame_every=0.001"]
# What differs from run to run, and what is drawn from it.
TIMED = ("facts.json", "summary.json", "checkpoint.bin")


def drumrs(*words: object) -> "subprocess.Popen[bytes]":
    """Start the command line."""
    command = [sys.executable, "-m", "drumrs", *map(str, words)]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def finish(*words: object) -> None:
    """Run the command line to its end."""
    if (status := drumrs(*words).wait()) != 0:
        sys.exit(f"{words} ended with {status}")


def contents(folder: Path) -> dict[str, bytes]:
    """Return every file that does not tell how long something took; those that a kill left behind included."""
    return {
        path.name: path.read_bytes()
        for path in folder.iterdir()
        if not path.name.endswith(TIMED) and not path.name.endswith(".tmp")
    }


def compare(whole: Path, killed: Path, kind: str) -> None:
    """End with what differs."""
    one, other = contents(whole), contents(killed)
    if one != other:
        sys.exit(f"{kind}: {sorted(name for name in one | other if one.get(name) != other.get(name))} differ")


def kill_at_random(longest: float, *words: object) -> bool:
    """Kill the command after some time; tell whether it was still under way."""
    child = drumrs(*words)
    time.sleep(random.uniform(0.0, longest))
    child.kill()
    return child.wait() != 0


def main(kills: int) -> None:
    """Kill and go on, until there have been so many kills of each kind."""
    root = Path(tempfile.mkdtemp())
    path = root / "sweep.toml"
    path.write_text(SWEEP, encoding="utf-8")
    began = time.perf_counter()
    finish("sweep", path, "--out", root / "whole")
    sweep_took = time.perf_counter() - began
    began = time.perf_counter()
    finish("run", *RUN, "--out", root / "run")
    run_took = time.perf_counter() - began
    longest = {"sweep": sweep_took, "run": run_took}
    done = {"sweep": 0, "run": 0}

    def kill(kind: str, *words: object) -> bool:
        """Kill the command; where it was over before, for the machine has become faster, kill earlier from now on."""
        killed = kill_at_random(longest[kind], *words)
        done[kind] += killed
        longest[kind] *= 1.0 if killed else 0.8
        return killed

    while min(done.values()) < kills:
        # A sweep is killed up to five times before it is left to its end, a run as well.
        for _ in range(5):
            if not kill("sweep", "sweep", path, "--out", root / "killed"):
                break
        finish("sweep", path, "--out", root / "killed")
        compare(root / "whole", root / "killed", "sweep")
        again: tuple[object, ...] = (*RUN, "--out", root / "killed-run")
        for _ in range(5):
            killed = kill("run", "run", *again)
            if (root / "killed-run" / "checkpoint.bin").exists():
                again = ("--resume", root / "killed-run")
            if not killed:
                break
        finish("run", *again)
        compare(root / "run", root / "killed-run", "run")
        shutil.rmtree(root / "killed")
        shutil.rmtree(root / "killed-run")
        sys.stdout.write(f"{done['sweep']} kills of a sweep, {done['run']} of a run: the same bytes\n")
        sys.stdout.flush()
    shutil.rmtree(root)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 50)
