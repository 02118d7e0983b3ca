"""From runs to decisions: what is asked of runs, and which runs answer it.

`targets` are quantities of runs and expressions of them, `readings` the single quantities, `measured` those that are
measured on frames and records, `units` their units;
`evaluate` asks configurations for them, through the store of a sweep. `compare` finds the best of a few machines, with
`selection`, which says where further seeds help. `scaling` tells what another size of the machine changes.
`screen` finds the keys that matter, with `sensitivity`.

`optimize` finds the best values of a few keys: `problem` is what is asked, `space` where the keys may vary, `search`
where to run next and when to stop, by what an `emulator` says of points that were not run and `gain` of what more of
them are worth; `optimization` is what comes out. `calibrate` finds the parameters that measured numbers leave:
`measurement` is what was measured, `posterior` the probability of parameters, `calibration` what comes out.
"""

from drumrs.decide.calibrate import calibrate
from drumrs.decide.calibration import Calibration
from drumrs.decide.compare import Comparison, Design, compare
from drumrs.decide.evaluate import Evaluator, evaluate
from drumrs.decide.measurement import Experiment
from drumrs.decide.optimization import Optimization
from drumrs.decide.optimize import optimize
from drumrs.decide.problem import Problem
from drumrs.decide.scaling import LAWS, Group, Law, SpeedRule, groups, speed_rules
from drumrs.decide.screen import Factor, Screening, ScreeningPlan, screen
from drumrs.decide.targets import Target

__all__ = [
    "LAWS",
    "Calibration",
    "Comparison",
    "Design",
    "Evaluator",
    "Experiment",
    "Factor",
    "Group",
    "Law",
    "Optimization",
    "Problem",
    "Screening",
    "ScreeningPlan",
    "SpeedRule",
    "Target",
    "calibrate",
    "compare",
    "evaluate",
    "groups",
    "optimize",
    "screen",
    "speed_rules",
]
