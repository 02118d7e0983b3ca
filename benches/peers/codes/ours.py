"""drumrs, run as the other codes are: ledger and recording on."""

import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import drumrs
from codes.balance import Trace
from codes.case import Case
from codes.program import Timing


@dataclass(frozen=True)
class Drumrs:
    """drumrs in this process.

    Attributes
    ----------
    threads
        Threads that share a step.
    """

    threads: int = 1
    name: str = "drumrs"
    pace: float = 60e6

    def require(self) -> None:
        """Do nothing: it is here."""

    def time(self, case: Case, settle: int, timed: int, folder: Path) -> Timing:  # noqa: ARG002
        """Time a number of steps, after some that are not timed."""
        simulation = drumrs.Simulation(case.config, threads=self.threads, state=case.state)
        simulation.run(steps=settle)
        began = time.perf_counter()
        simulation.run(steps=timed)
        return Timing(timed, time.perf_counter() - began)

    def trace(self, case: Case, duration: float, folder: Path) -> Trace:  # noqa: ARG002
        """Run for so long [s] and tell power and center of mass."""
        simulation = drumrs.Simulation(case.config, threads=self.threads, state=case.state)
        simulation.run(duration=duration)
        return trace_of(simulation)


def trace_of(simulation: drumrs.Simulation) -> Trace:
    """Return what a run recorded; its work by the balance of moments is exact for any sampling."""
    series = simulation.series
    times = series["time"].to_numpy()
    work = np.diff(series["moment_balance_work"].to_numpy()) / np.diff(times)
    x, y = (series[f"center_of_mass_{axis}"].to_numpy()[1:] for axis in "xy")
    return Trace(times, work / float(simulation.masses.sum()), x, y)
