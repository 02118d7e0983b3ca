"""From runs to decisions: what is asked of runs, and which runs answer it.

`targets` are quantities of runs and expressions of them, `readings` the single quantities, `units` their units;
`evaluate` asks configurations for them, through the store of a sweep.
"""

from drumrs.decide.evaluate import Evaluator, evaluate
from drumrs.decide.targets import Target

__all__ = ["Evaluator", "Target", "evaluate"]
