"""Compare the bits of short runs with those on record, which are the same on every system and with every core.

    python packaging/bits.py           # fails where a digest differs
    python packaging/bits.py --write   # records those of this copy, where a change was meant

The runs reach every law and every kind of outline that the core has. A digest is that of the series, in which every
force and every motion has its share, and of the contacts where they are recorded.
"""

import argparse
import hashlib
import json
from pathlib import Path
from typing import Any

import polars as pl

import drumrs

RECORD = Path(__file__).parents[1] / "tests" / "data" / "bits.json"

_SHELL = [[0.0, 0.24], [-0.22, 0.1], [-0.2, -0.15], [0.0, -0.24], [0.2, -0.15], [0.22, 0.1]]
_ALL_LAWS = {
    f"contact.{side}.{key}": value
    for side in ("bundle", "drum")
    for key, value in (("rolling_friction", 0.05), ("tangential_damping_ratio", 0.1), ("adhesion", 2.0))
}
_HERTZ = {"contact.base": "hertz", "contact.bundle.young_modulus": 1e7, "contact.drum.young_modulus": 1e7}
_SPECIES = [
    {"name": "small", "diameter": 0.015, "share": 0.3},
    {"name": "large", "diameter": 0.03, "share": 0.7},
]
CASES: dict[str, dict[str, Any]] = {
    "Table 1": {"load.fill": 0.5},
    "baffles": {"load.fill": 0.4, "drum.baffles.count": 3},
    "every term of the law": _ALL_LAWS,
    "Hertz and Mindlin": {**_HERTZ, "run.time_step": "auto"},
    "two sizes": {
        "load.species": _SPECIES,
        "load.share_by": "mass",
        "load.fill": 0.4,
        "run.time_step": "auto",
    },
    "a shell, to and fro": {
        "drum.rim": False,
        "drum.liner.outlines": [{"name": "shell", "points": _SHELL}],
        "rotation.program": [[0.0, 0.0], [0.2, 50.0], [0.4, -50.0]],
    },
    "everything recorded": {
        "run.record": ["gross_work", "contacts", "wall_profile", "ledger_split", "discs"]
    },
}


def digests() -> dict[str, str]:
    """Run the cases, and return the digest of each."""
    return {name: _digest(drumrs.baseline(0.25).replace(changes)) for name, changes in CASES.items()}


def _digest(config: drumrs.Config) -> str:
    result = drumrs.run(config.replace({"run.duration": 0.5, "run.window": [0.25, 0.5]}), progress=False)
    digest = hashlib.sha256()
    for table in (result.series, result.contacts):
        if table is not None:
            digest.update(table.select(pl.col(pl.Float64)).fill_null(0.0).to_numpy().astype("<f8").tobytes())
    return digest.hexdigest()


def main() -> None:
    """Compare, or write.

    Raises
    ------
    SystemExit
        Where digests differ; each is named.
    """
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="record the digests of this copy")
    found = digests()
    if parser.parse_args().write:
        RECORD.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        return
    expected = json.loads(RECORD.read_text(encoding="utf-8"))
    differ = [name for name in CASES if found[name] != expected.get(name)]
    print(
        f"core {drumrs.info()['core']}: {len(CASES) - len(differ)} of {len(CASES)} runs have the bits on record"
    )
    if differ:
        raise SystemExit("Other bits: " + ", ".join(differ))


if __name__ == "__main__":
    main()
