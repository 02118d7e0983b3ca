"""`Case`: a drum and its load in the numbers that every code takes, and the files that carry them."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import drumrs
from drumrs.config import DerivedContact, LinearContact

Array = NDArray[np.float64]

# The boxes of the other codes end so far outside of the rim.
_ROOM = 1.02


@dataclass(frozen=True)
class Law:
    """A linear spring and dashpot with friction.

    Attributes
    ----------
    stiffness
        Normal and tangential stiffness [N/m].
    damping
        Of the normal dashpot [N s/m].
    damping_rate
        The same over the effective mass [1/s].
    friction
        Coefficient of friction.
    """

    stiffness: float
    damping: float
    damping_rate: float
    friction: float

    @classmethod
    def of(cls, contact: LinearContact, derived: DerivedContact) -> "Law":
        """Read a contact's table, and what follows from it."""
        if contact.stiffness_ratio != 1.0:
            raise ValueError(f"stiffness_ratio is {contact.stiffness_ratio}, but must be 1 in every deck")
        damping = derived.normal_damping
        if damping is None:
            raise ValueError("contact.base is 'hertz', but must be 'linear' in every deck")
        return cls(contact.normal_stiffness, damping, damping / derived.effective_mass, contact.friction)


def laws(config: drumrs.Config) -> tuple[Law, Law]:
    """Return the laws between bundles, and between a bundle and the drum."""
    contact, derived = config.contact, config.derived
    return Law.of(contact.bundle, derived.bundle), Law.of(contact.drum, derived.drum)


@dataclass(frozen=True, eq=False)
class Case:
    """A configuration and the state that it starts from.

    Attributes
    ----------
    config
        What to simulate; one speed, equal bundles.
    state
        Where the bundles are at t = 0; contacts have no past in any code.
    """

    config: drumrs.Config
    state: drumrs.State

    @classmethod
    def packed(cls, config: drumrs.Config) -> "Case":
        """Start from drumrs's own packing, at rest in the turning drum."""
        return cls(config, drumrs.Simulation(config).state)

    @property
    def count(self) -> int:
        """Number of bundles."""
        return len(np.asarray(self.state.positions))

    @property
    def radius(self) -> float:
        """The drum's radius [m]."""
        return self.config.drum.diameter / 2.0

    @property
    def angular_velocity(self) -> float:
        """The drum's angular velocity [rad/s]."""
        speed = self.config.derived.angular_velocity
        if speed is None:
            raise ValueError("rotation.program is given, but every deck turns at one speed")
        return speed

    @property
    def time_step(self) -> float:
        """Time step [s]."""
        step = self.config.run.time_step
        if step == "auto":
            raise ValueError("run.time_step is 'auto', but must be a number here")
        return float(step)

    @property
    def pair(self) -> Law:
        """The law between bundles."""
        return laws(self.config)[0]

    @property
    def wall(self) -> Law:
        """The law between a bundle and the drum."""
        return laws(self.config)[1]

    @property
    def fastest(self) -> float:
        """Speed that no bundle exceeds [m/s]: the rim's at the top, and a fall through the drum."""
        rim = self.angular_velocity * self.radius
        return math.sqrt(rim**2 + 4.0 * 9.81 * self.radius)

    def motion(self) -> Array:
        """Return x, y, vx, vy, spin of every bundle, shape (n, 5)."""
        state = self.state
        positions = np.asarray(state.positions, dtype=float)
        velocities = np.zeros_like(positions) if state.velocities is None else np.asarray(state.velocities)
        spins = np.zeros(len(positions)) if state.angular_velocities is None else state.angular_velocities
        return np.column_stack([positions, velocities, spins])

    def write_data(self, path: Path, *, types: int = 1) -> None:
        """Write the state as a data file of LAMMPS or LIGGGHTS, in a slice that is periodic across the plane."""
        diameter, half = self.config.load.diameter, _ROOM * self.radius
        depth = 2.0 * diameter
        head = [
            "discs in a drum\n",
            f"{self.count} atoms",
            f"{types} atom types\n",
            *(
                f"{-side:.17g} {side:.17g} {axis}lo {axis}hi"
                for side, axis in ((half, "x"), (half, "y"), (depth, "z"))
            ),
        ]
        motion = self.motion()
        atoms = (
            f"{k} 1 {diameter:.17g} {self.config.load.density:.17g} {x:.17g} {y:.17g} 0"
            for k, (x, y, *_) in enumerate(motion, 1)
        )
        speeds = (f"{k} {u:.17g} {v:.17g} 0 0 0 {w:.17g}" for k, (_, _, u, v, w) in enumerate(motion, 1))
        parts = [*head, "\nAtoms # sphere\n", *atoms, "\nVelocities\n", *speeds, ""]
        path.write_text("\n".join(parts), encoding="utf-8")

    def baffles(self) -> list[Array]:
        """Return the baffles at t = 0 as open polylines from rim to rim [m], each of shape (corners, 2)."""
        if not self.config.drum.baffles.count:
            return []
        return list(drumrs.Simulation(self.config, state=self.state).frames.baffles)
