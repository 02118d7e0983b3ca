"""`advance`: how the cases run their simulations, so that Ctrl-C ends those under way."""

import threading
from contextvars import ContextVar

from drumrs import Simulation

# Set once the verification that this thread works for is broken off.
broken_off: ContextVar[threading.Event | None] = ContextVar("broken_off", default=None)

# How often it is looked whether a verification is broken off [s].
PAUSE = 0.1


class Halted(Exception):  # noqa: N818 - nothing is wrong with the simulation
    """The verification was broken off; nobody waits for the case any more."""


def advance(simulation: Simulation, steps: int) -> None:
    """Do so many steps.

    Raises
    ------
    Halted
        Where the verification was broken off.
    """
    halt, end = broken_off.get(), simulation.step + steps
    while simulation.step < end:
        if halt is not None and halt.is_set():
            raise Halted
        simulation.run_to_step(end, wall_limit=PAUSE)
