"""`drumrs info`: what this copy of drumrs is."""

import sys
from importlib.metadata import version

import drumrs


def info() -> None:
    """Print what this copy of drumrs is: versions, build profile, CPU features."""
    for key, value in drumrs.info().items():
        shown = " ".join(map(str, value)) if isinstance(value, (list, tuple)) else value
        sys.stdout.write(f"{key}: {shown}\n")
    sys.stdout.write(f"python: {sys.version.split()[0]}\n")
    for library in ("numpy", "polars", "matplotlib", "pydantic"):
        sys.stdout.write(f"{library}: {version(library)}\n")
