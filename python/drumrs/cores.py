"""Which compiled core is used: wheels for x86-64 carry two, and the faster one runs where the CPU has what it needs.

`drumrs._core` runs on every CPU of its kind. `x86_64_v3` is built from the same source for the vector instructions of
x86-64-v3, which CPUs have had since 2013 and which make it faster by about a third. Their results are the same bits.
A build from source has one core, for the instructions that it was built for.

Importing this module makes the choice: before any other module of the package asks for the core.
"""

import os
import sys
from collections.abc import Iterable, Mapping
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

VARIABLE = "DRUMRS_CORE"
FAST = "x86-64-v3"
# What a CPU has beyond x86-64-v2, which those that have all of it have, too.
_NEEDED = frozenset({"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "lzcnt", "movbe"})
_NAME = "drumrs._core"


def choose(cores: list[str], features: Iterable[str], environment: Mapping[str, str]) -> str:
    """Return the name of the core to use.

    Parameters
    ----------
    cores
        Names of those there are; the first runs on every CPU.
    features
        Features of this CPU.
    environment
        Environment variables, of which ``DRUMRS_CORE`` names the core to use.

    Raises
    ------
    ImportError
        Where the core that is asked for is not there, or the CPU lacks what it needs.

    Examples
    --------
    >>> choose(["x86-64", "x86-64-v3"], ["avx"], {})
    'x86-64'
    >>> choose(["x86-64", "x86-64-v3"], ["avx"], {"DRUMRS_CORE": "x86-64-v3"})
    Traceback (most recent call last):
    ImportError: DRUMRS_CORE is 'x86-64-v3', but this CPU lacks avx2, bmi1, bmi2, f16c, fma, lzcnt, movbe; unset it
    """
    forced = environment.get(VARIABLE)
    lacking = sorted(_NEEDED.difference(features))
    if not forced:
        return FAST if FAST in cores and not lacking else cores[0]
    if forced not in cores:
        there = f"only the core {cores[0]}" if len(cores) == 1 else f"the cores {' and '.join(cores)}"
        raise ImportError(f"{VARIABLE} is {forced!r}, but this copy of drumrs has {there}; unset it")
    if forced == FAST != cores[0] and lacking:
        raise ImportError(f"{VARIABLE} is {forced!r}, but this CPU lacks {', '.join(lacking)}; unset it")
    return forced


def _load(path: Path) -> None:
    spec = spec_from_file_location(_NAME, path, loader=ExtensionFileLoader(_NAME, str(path)))
    if spec is None or spec.loader is None:
        raise ImportError(f"cannot load the compiled core {path}")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    sys.modules[_NAME] = module
    # `from drumrs import _core` looks here first.
    sys.modules["drumrs"].__dict__["_core"] = module


def _use_best() -> None:
    """Put the core that `choose` chooses in place of `drumrs._core`."""
    from drumrs import _core

    about = _core.info()
    paths = [Path(__file__).with_name(f"x86_64_v3{suffix}") for suffix in EXTENSION_SUFFIXES]
    fast = next((path for path in paths if path.exists()), None)
    chosen = choose([about["core"], *([FAST] if fast else [])], about["cpu_features"], os.environ)
    if fast and chosen != about["core"]:
        _load(fast)


_use_best()
