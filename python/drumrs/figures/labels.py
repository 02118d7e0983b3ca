"""Labels of axes and titles of plots, each in one place; names and units of quantities are those of the registry."""

from drumrs.registry import quantity

TIME = quantity("time").label
SPEED = f"speed of the bundles [{quantity('velocity_x').unit}]"
CENTER_OF_MASS = "Center of mass from the axis [mm]"
ENERGY_STORED = f"Energy stored [{quantity('kinetic_energy').unit}]"
ENERGY_RESIDUAL = "Energy ledger: relative residual"
POWERS = f"Power of the drum and losses, means over {{:.2g}} s [{quantity('drum_power').unit}]"

FILL = "fill N d²/D² [%]"
DRUM_POWER = quantity("drum_power").label
DRUM_SPECIFIC_POWER = quantity("drum_specific_power").label
GROSS_WORK_RATIO = f"{quantity('gross_work_ratio').label} N/T"
DISSIPATION_RATIO = f"{quantity('dissipation_ratio').label} N/T"
WORK_RATIO = f"{quantity('work_ratio').label} N/T"
TURNING = "angular momentum over M Ω R²"
FRICTION = "coefficient of friction μ"
RESTITUTION = "coefficient of restitution e"
SIZE_RATIO = f"{quantity('size_ratio').label} D/d"
DRUM_SPEED = "drum speed [rpm]"
