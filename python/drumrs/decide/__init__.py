"""From runs to decisions: what is asked of runs, and which runs answer it.

`targets` are quantities of runs and expressions of them, `readings` the single quantities, `units` their units;
`evaluate` asks configurations for them, through the store of a sweep. `compare` finds the best of a few machines, with
`selection`, which says where further seeds help. `scaling` tells what another size of the machine changes.
`screen` finds the keys that matter, with `sensitivity`.
"""

from drumrs.decide.compare import Comparison, Design, compare
from drumrs.decide.evaluate import Evaluator, evaluate
from drumrs.decide.scaling import LAWS, Group, Law, SpeedRule, groups, speed_rules
from drumrs.decide.screen import Factor, Screening, ScreeningPlan, screen
from drumrs.decide.targets import Target

__all__ = [
    "LAWS",
    "Comparison",
    "Design",
    "Evaluator",
    "Factor",
    "Group",
    "Law",
    "Screening",
    "ScreeningPlan",
    "SpeedRule",
    "Target",
    "compare",
    "evaluate",
    "groups",
    "screen",
    "speed_rules",
]
