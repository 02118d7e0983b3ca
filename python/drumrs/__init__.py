"""drumrs: loads tumbling in a rotating drum, simulated as discs with soft contacts.

>>> import drumrs
>>> config = drumrs.baseline(fill=0.25, baffles=True).replace({"contact.bundle.friction": 0.3})
>>> config.bundle_count
100

All values are in SI units and per meter of drum depth, but for rpm and degrees in configurations.
"""

import logging
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from drumrs import cores, errors  # noqa: F401  importing cores chooses one, before any module asks for it
from drumrs.analysis import phases
from drumrs.config import Config, baseline
from drumrs.errors import CheckpointError, ConfigError, DrumrsError, DrumrsWarning, UnstableError
from drumrs.frames import Frames
from drumrs.jobs import effective_jobs
from drumrs.output import player, save
from drumrs.progress import Task
from drumrs.registry import Quantity, quantity
from drumrs.result import Result, Summary, load
from drumrs.runs import run
from drumrs.simulation import Simulation, info
from drumrs.state import State
from drumrs.sweep import Case, Sweep

if TYPE_CHECKING:
    from drumrs.decide import optimize
    from drumrs.exports import export, movie
    from drumrs.glossary import quantities
    from drumrs.reports import report
    from drumrs.verification import Verification, verify

__version__ = version("drumrs")

# What a library has to say is for those who listen.
logging.getLogger(__name__).addHandler(logging.NullHandler())

__all__ = [
    "Case",
    "CheckpointError",
    "Config",
    "ConfigError",
    "DrumrsError",
    "DrumrsWarning",
    "Frames",
    "Quantity",
    "Result",
    "Simulation",
    "State",
    "Summary",
    "Sweep",
    "Task",
    "UnstableError",
    "Verification",
    "__version__",
    "baseline",
    "effective_jobs",
    "errors",
    "export",
    "info",
    "load",
    "movie",
    "optimize",
    "phases",
    "player",
    "quantities",
    "quantity",
    "report",
    "run",
    "save",
    "verify",
]


def __getattr__(name: str) -> Any:
    """Load on demand what most scripts do without: decisions, the table of quantities, exports, reports, the verification."""
    if name == "optimize":
        from drumrs import decide

        return getattr(decide, name)
    if name in {"export", "movie"}:
        from drumrs import exports

        return getattr(exports, name)
    if name == "quantities":
        from drumrs import glossary

        return glossary.quantities
    if name == "report":
        from drumrs import reports

        return reports.report
    if name in {"Verification", "verify"}:
        from drumrs import verification

        return verification.verify if name == "verify" else verification.Verification
    raise AttributeError(f"module 'drumrs' has no attribute {name!r}")
