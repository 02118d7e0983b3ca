"""From runs to decisions: what is asked of runs, and which runs answer it.

`targets` are quantities of runs and expressions of them, `readings` the single quantities, `units` their units;
`evaluate` asks configurations for them, through the store of a sweep. `compare` finds the best of a few machines, with
`selection`, which says where further seeds help.
"""

from drumrs.decide.compare import Comparison, Design, compare
from drumrs.decide.evaluate import Evaluator, evaluate
from drumrs.decide.targets import Target

__all__ = ["Comparison", "Design", "Evaluator", "Target", "compare", "evaluate"]
