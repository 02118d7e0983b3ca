"""`drumrs info`: what this copy of drumrs is."""

import json as json_text
import sys
from importlib.metadata import version
from typing import Annotated

from cyclopts import Parameter

import drumrs


def info(*, json: Annotated[bool, Parameter(negative="")] = False) -> None:
    """Print what this copy of drumrs is: versions, build profile, CPU features.

    Parameters
    ----------
    json
        Print one JSON object.
    """
    told = {**drumrs.info(), "python": sys.version.split()[0]}
    told |= {library: version(library) for library in ("numpy", "polars", "matplotlib", "pydantic")}
    if json:
        sys.stdout.write(f"{json_text.dumps(told, indent=2)}\n")
        return
    for key, value in told.items():
        shown = " ".join(map(str, value)) if isinstance(value, (list, tuple)) else value
        sys.stdout.write(f"{key}: {shown}\n")
