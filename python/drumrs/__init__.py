"""drumrs: loads tumbling in a rotating drum, simulated as discs with soft contacts.

>>> import drumrs
>>> config = drumrs.baseline(fill=0.25, baffles=True).replace({"contact.bundle.friction": 0.3})
>>> config.bundle_count
100

All values are in SI units and per meter of drum depth, but for rpm and degrees in configurations.
"""

import logging
from importlib import import_module
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
    from drumrs.decide.calibrate import calibrate
    from drumrs.decide.calibration import Calibration
    from drumrs.decide.compare import Comparison, compare
    from drumrs.decide.evaluate import evaluate
    from drumrs.decide.optimization import Optimization
    from drumrs.decide.optimize import optimize
    from drumrs.decide.screen import Screening, screen
    from drumrs.decide.targets import Target
    from drumrs.exports import export, movie
    from drumrs.glossary import quantities
    from drumrs.reports import report
    from drumrs.studio import widget
    from drumrs.verification import Verification, verify

__version__ = version("drumrs")

# What a library has to say is for those who listen.
logging.getLogger(__name__).addHandler(logging.NullHandler())

__all__ = [
    "Calibration",
    "Case",
    "CheckpointError",
    "Comparison",
    "Config",
    "ConfigError",
    "DrumrsError",
    "DrumrsWarning",
    "Frames",
    "Optimization",
    "Quantity",
    "Result",
    "Screening",
    "Simulation",
    "State",
    "Summary",
    "Sweep",
    "Target",
    "Task",
    "UnstableError",
    "Verification",
    "__version__",
    "baseline",
    "calibrate",
    "compare",
    "effective_jobs",
    "errors",
    "evaluate",
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
    "screen",
    "verify",
    "widget",
]


# What most scripts do without, and the module that has it.
_ON_DEMAND = {
    "Calibration": "decide.calibration",
    "Comparison": "decide.compare",
    "Optimization": "decide.optimization",
    "Screening": "decide.screen",
    "Target": "decide.targets",
    "Verification": "verification",
    "calibrate": "decide.calibrate",
    "compare": "decide.compare",
    "evaluate": "decide.evaluate",
    "export": "exports",
    "movie": "exports",
    "optimize": "decide.optimize",
    "quantities": "glossary",
    "report": "reports",
    "screen": "decide.screen",
    "verify": "verification",
    "widget": "studio",
}


def __getattr__(name: str) -> Any:
    """Load what is loaded on demand."""
    if name in _ON_DEMAND:
        # By the module's own name: packages have functions by the names of some modules.
        return getattr(import_module(f"drumrs.{_ON_DEMAND[name]}"), name)
    raise AttributeError(f"module 'drumrs' has no attribute {name!r}")
