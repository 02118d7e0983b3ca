"""Build the wheel for this machine, check it as a package index would, and try it where there is no Rust.

    python packaging/wheel.py [--out dist]

For x86-64 the wheel has two cores: each is built with target flags of its own, which replace those of
.cargo/config.toml, so that the wheel runs on every CPU though a checkout builds for AVX2.
"""

import argparse
import os
import platform
import shutil
import subprocess
import sys
import time
import venv
import zipfile
from pathlib import Path

from add_core import PACKAGE
from add_core import main as add_core

ROOT = Path(__file__).parents[1]
WORK = ROOT / "target" / "wheel"
TOOLS = ["maturin[zig]>=1.13,<2", "twine", "check-wheel-contents", "abi3audit", "auditwheel"]
IS_LINUX = sys.platform == "linux"
HAS_TWO_CORES = platform.machine().lower() in {"x86_64", "amd64"}
MOST_BYTES = 2_450_000  # of a core
MOST_SECONDS = 30.0  # from the wheel to the first picture


def main() -> None:
    """Build, check, try; the first failure ends it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder of the wheel")
    out = parser.parse_args().out.resolve()
    tools = environment(WORK / "tools")
    run(tools / "pip", "install", "--quiet", *TOOLS)
    try:
        if HAS_TWO_CORES:
            add_core(build(tools, "x86-64-v3", WORK / "x86-64-v3"))
        wheel = build(tools, "x86-64" if HAS_TWO_CORES else "", out)
    finally:
        # In a checkout it would be taken for the core that `make develop` builds, and grow old.
        for path in PACKAGE.glob("x86_64_v3.*"):
            path.unlink()
    check(tools, wheel)
    try_out(wheel)
    print(f"wrote {wheel}, {wheel.stat().st_size / 1e6:.1f} MB")


def build(tools: Path, cpu: str, folder: Path) -> Path:
    """Build a wheel for a kind of CPU into a folder, and return its path."""
    shutil.rmtree(folder, ignore_errors=True)
    # What a step calls is inlined in any case; inlining less of the rest makes a core 6 % smaller.
    rust = "-C llvm-args=--inline-threshold=50" + (f" -C target-cpu={cpu}" if cpu else "")
    flags = {"RUSTFLAGS": rust}
    # Each kind of CPU has a folder of its own, so that neither builds what the other has.
    target = {"CARGO_TARGET_DIR": str(WORK / f"target-{cpu or 'any'}")}
    portable = ["--zig", "--compatibility", "manylinux2014"] if IS_LINUX else []
    # zig is found through the environment's own python.
    path = {"PATH": f"{tools}{os.pathsep}{os.environ['PATH']}"}
    command = [
        tools / "maturin",
        "build",
        "--profile",
        "wheel",
        "--locked",
        "--strip",
        "--out",
        folder,
        *portable,
    ]
    run(*command, **flags, **target, **path)
    [wheel] = folder.glob("*.whl")
    return wheel


def check(tools: Path, wheel: Path) -> None:
    """Check the wheel's metadata, contents, symbols and sizes."""
    run(tools / "twine", "check", "--strict", wheel)
    run(tools / "check-wheel-contents", wheel)
    run(tools / "abi3audit", "--strict", "--report", wheel)
    if IS_LINUX:
        run(tools / "auditwheel", "show", wheel)
    with zipfile.ZipFile(wheel) as archive:
        sizes = {
            one.filename: one.file_size
            for one in archive.infolist()
            if one.filename.endswith((".so", ".pyd"))
        }
    print(*(f"{name}: {size / 1e6:.2f} MB" for name, size in sizes.items()), sep="\n")
    if len(sizes) != 1 + HAS_TWO_CORES or max(sizes.values()) > MOST_BYTES:
        raise SystemExit(
            f"expected {1 + HAS_TWO_CORES} cores of at most {MOST_BYTES / 1e6:g} MB, found {sizes}"
        )


def try_out(wheel: Path) -> None:
    """Install the wheel where there is no Rust, run a case with each core, and compare what they leave."""
    folder = WORK / "try"
    shutil.rmtree(folder, ignore_errors=True)
    bare = environment(folder / "venv")
    began = time.perf_counter()
    run(bare / "pip", "install", "--quiet", wheel)
    installed = time.perf_counter()
    # Nothing but the environment and the system's own tools.
    path = {"PATH": os.pathsep.join([str(bare), "/usr/bin", "/bin"])} if IS_LINUX else {}
    run(bare / "drumrs", "info", **path)
    run(bare / "drumrs", "init", "first", "--template", "washer", cwd=folder, **path)
    run(bare / "drumrs", "run", "case.toml", "--softer", "100", "--out", "out", cwd=folder / "first", **path)
    taken = time.perf_counter() - installed
    pictures = sorted((folder / "first" / "out").glob("*.png"))
    print(f"installed in {installed - began:.1f} s, first picture after {taken:.1f} s: {pictures[0]}")
    if taken > MOST_SECONDS:
        raise SystemExit(f"the first picture took {taken:.1f} s, more than {MOST_SECONDS:g} s")
    if HAS_TWO_CORES:
        left = [checkpoint(bare, core, folder) for core in ("x86-64", "x86-64-v3")]
        if left[0] != left[1]:
            raise SystemExit("the two cores leave different checkpoints")
        print(f"both cores leave the same {len(left[0])} bytes")


def checkpoint(bare: Path, core: str, folder: Path) -> bytes:
    """Run a case with a core, and return its checkpoint."""
    path = folder / f"{core}.checkpoint"
    code = (
        f"import drumrs; assert drumrs.info()['core'] == {core!r}; "
        "simulation = drumrs.Simulation(drumrs.baseline(0.5, baffles=True)); "
        f"simulation.run(0.5); simulation.save({str(path)!r})"
    )
    run(bare / "python", "-c", code, DRUMRS_CORE=core)
    return path.read_bytes()


def environment(folder: Path) -> Path:
    """Make a virtual environment where there is none, and return the folder of its programs."""
    if not folder.exists():
        venv.create(folder, with_pip=True)
    return folder / ("Scripts" if sys.platform == "win32" else "bin")


def run(*command: object, cwd: Path = ROOT, **variables: str) -> None:
    """Run a program with some environment variables; a failure ends this one."""
    print("+", *command, flush=True)
    done = subprocess.run(
        [str(part) for part in command], cwd=cwd, env={**os.environ, **variables}, check=False
    )
    if done.returncode:
        raise SystemExit(f"{command[0]} failed with exit status {done.returncode}")


if __name__ == "__main__":
    main()
