"""`advance`: how the cases run their simulations, so that Ctrl-C ends those under way."""

from contextvars import ContextVar

from drumrs.simulation import Simulation
from drumrs.sweep.worker import Running

# Those of the verification that this thread works for.
under_way: ContextVar[Running] = ContextVar("under_way")


class Halted(Exception):  # noqa: N818 - nothing is wrong with the simulation
    """The verification was broken off; nobody waits for the case any more."""


def advance(simulation: Simulation, steps: int) -> None:
    """Do so many steps.

    Raises
    ------
    Halted
        Where the verification was broken off.
    """
    running = under_way.get(None) or Running()
    running.begin(simulation)
    try:
        if not simulation.run_until(simulation.step + steps):
            raise Halted
    finally:
        running.end(simulation)
