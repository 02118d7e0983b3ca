"""`drumrs config`: every key of a case, as a file to start from, with the laws of its species."""

import sys
import textwrap
from pathlib import Path

import drumrs
from drumrs.cli.options import layered
from drumrs.config import Config, laws

# Keys that do not count with a base law.
_OF_OTHER_BASES = {
    "linear": {"young_modulus", "poisson_ratio"},
    "hertz": {"normal_stiffness", "stiffness_ratio", "rolling_friction", "tangential_damping_ratio"},
}


def config(case: Path | None = None) -> None:
    """Print every key with its value, unit and meaning, as TOML: `drumrs config > case.toml`.

    Of a load of several species, how much there is of each and what acts between any two of them, and between each and
    the drum, stands at the end as a comment.

    Parameters
    ----------
    case
        TOML file with some keys; the baseline's values without it.
    """
    if case is None:
        sys.stdout.write(
            "# The baseline of drumrs, the paper's Table 1. Keep what differs, delete the rest.\n\n"
        )
        sys.stdout.write(drumrs.baseline().to_toml())
        return
    whole = layered(case, None, None)
    sys.stdout.write(whole.to_toml())
    if whole.load.species:
        lines = [*_species(whole), "", *_laws(whole)]
        sys.stdout.write(
            "\n" + textwrap.indent("\n".join(lines), "# ", lambda _: True).replace("# \n", "#\n") + "\n"
        )


def _species(config: Config) -> list[str]:
    """Say how much there is of each species."""
    found = config.derived.species
    rows = [
        (name, str(own.count), f"{own.mass:.4g}", f"{own.smallest:.4g}", f"{own.largest:.4g}")
        for name, own in found.items()
    ]
    return _table([("species", "bundles", "mass [kg/m]", "smallest [m]", "largest [m]"), *rows])


def _laws(config: Config) -> list[str]:
    """Say what acts, pair by pair, in all keys that count."""
    found = laws(config.load, config.contact)
    values = [law.table.model_dump(exclude=_OF_OTHER_BASES[config.contact.base]) for law in found]
    keys = [key for key in values[0] if any(own[key] is not None for own in values)]
    rows = [
        (" - ".join(law.between), *(_text(own[key]) for key in keys), law.key)
        for law, own in zip(found, values, strict=True)
    ]
    return _table([("between", *keys, "from"), *rows])


def _text(value: object) -> str:
    return "-" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def _table(rows: list[tuple[str, ...]]) -> list[str]:
    """Align texts in columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows
    ]
