"""Take the core out of a wheel that was built for x86-64-v3 and put it beside the package, for the next wheel.

    python packaging/add_core.py WHEEL

A wheel for x86-64 has two cores, python/drumrs/cores.py chooses. `make wheel` and the release build them the same way:
a wheel for x86-64-v3, this script, then the wheel for x86-64, which takes along what this script left.
"""

import sys
import zipfile
from pathlib import Path

PACKAGE = Path(__file__).parents[1] / "python" / "drumrs"


def main(wheel: Path) -> None:
    """Write the core of a wheel into the package as x86_64_v3.

    Raises
    ------
    SystemExit
        Where the wheel has no core, or more than one.
    """
    with zipfile.ZipFile(wheel) as archive:
        cores = [
            name
            for name in archive.namelist()
            if name.startswith("drumrs/_core.") and not name.endswith(".pyi")
        ]
        if len(cores) != 1:
            raise SystemExit(f"{wheel}: expected one core drumrs/_core.*, found {cores or 'none'}")
        suffix = cores[0].removeprefix("drumrs/_core")
        path = PACKAGE / f"x86_64_v3{suffix}"
        path.write_bytes(archive.read(cores[0]))
    print(f"wrote {path}, {path.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    [found] = [Path(argument) for argument in sys.argv[1:]] or [None]
    if found is None:
        raise SystemExit(__doc__)
    main(found)
