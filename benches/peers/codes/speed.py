"""Speeds: codes in turn, drums with and without baffles, sweeps on one core and two."""

import argparse
import os
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from statistics import median

import numpy as np

import drumrs
from codes.beds import settled
from codes.case import Case
from codes.ours import Drumrs
from codes.program import Code, Timing

# No fewer steps than lists live for, so that making them has its share.
_FEWEST_STEPS = 200
# Steps before the clock runs: contacts must open, lists be made.
_SETTLE, _FEWEST_SETTLED = 0.2, 100
# Bare drums whose cost is known at many numbers of contacts.
_BARE = (60, 80, 100, 125, 150, 175, 200, 250, 300)
_WITH_BAFFLES = (100, 150, 200, 250)
_CASES = 24


def steps_for(code: Code, count: int, seconds: float) -> int:
    """Return the number of steps that takes a code about so long [s]."""
    return max(_FEWEST_STEPS, round(seconds * code.pace / count))


def time_code(code: Code, case: Case, seconds: float, scratch: Path) -> Timing:
    """Time a code for about so long [s], after some steps that are not timed."""
    steps = steps_for(code, case.count, seconds)
    return code.time(case, max(_FEWEST_SETTLED, round(_SETTLE * steps)), steps, scratch)


def spread(values: Sequence[float], places: int = 1) -> str:
    """Write a median with the least and the greatest.

    Examples
    --------
    >>> spread([5.0, 4.0, 4.5])
    '4.5 (4.0 … 5.0)'
    """
    middle, low, high = (f"{value:.{places}f}" for value in (median(values), min(values), max(values)))
    return f"{middle} ({low} … {high})"


def compare_speeds(codes: Sequence[Code], options: argparse.Namespace, scratch: Path) -> None:
    """Time every code in turn, round by round, and print a table of speeds and ratios."""
    print("\nSpeed, 10⁶ particle-steps per second, one core: median (least … greatest)")
    print("ratio: drumrs over the code, round by round\n")
    print(
        "| N | "
        + " | ".join(f"{code.name} | ratio" if code.name != "drumrs" else code.name for code in codes)
        + " |"
    )
    print("|---" * (1 + sum(1 if code.name == "drumrs" else 2 for code in codes)) + "|")
    for count in options.sizes:
        case = settled(count, options.beds)
        rates = rounds(codes, case, options, scratch)
        print(f"| {count} | " + " | ".join(_cells(rates, code.name) for code in codes) + " |", flush=True)


def rounds(
    codes: Sequence[Code], case: Case, options: argparse.Namespace, scratch: Path
) -> dict[str, list[float]]:
    """Return the speeds of each code [10⁶/s], one a round."""
    rates: dict[str, list[float]] = {code.name: [] for code in codes}
    for _ in range(options.repeats):
        for code in codes:
            timing = time_code(code, case, options.seconds, scratch)
            rates[code.name].append(timing.rate(case.count) / 1e6)
    return rates


def _cells(rates: dict[str, list[float]], name: str) -> str:
    """Write a code's speed and, but for drumrs, the ratio."""
    if name == "drumrs" or "drumrs" not in rates:
        return spread(rates[name]) + (" | –" if name != "drumrs" else "")
    ratios = [ours / theirs for ours, theirs in zip(rates["drumrs"], rates[name], strict=True)]
    return f"{spread(rates[name])} | {spread(ratios)}"


def compare_baffles(options: argparse.Namespace, scratch: Path) -> None:
    """Print what a step with baffles costs over one without at the same number of contacts, by interpolation."""
    print("\nA step of drumrs with three baffles over one of a bare drum with as many contacts\n")
    print("| N | contacts | time of a step [µs] | bare, same contacts [µs] | ratio |")
    print("|---|---|---|---|---|")
    cases = {(count, False): settled(count, options.beds) for count in _BARE}
    cases |= {(count, True): settled(count, options.beds, baffles=True) for count in _WITH_BAFFLES}
    costs: dict[tuple[int, bool], list[float]] = {key: [] for key in cases}
    for _ in range(options.repeats):
        for key, case in cases.items():
            timing = time_code(Drumrs(), case, options.seconds, scratch)
            costs[key].append(1e6 * timing.seconds / timing.steps)
    contacts = {key: mean_contacts(case, options.seconds) for key, case in cases.items()}
    bare = sorted((contacts[key], key) for key in cases if not key[1])
    for key in (key for key in cases if key[1]):
        ratios, same = [], []
        for turn in range(options.repeats):
            grid, values = [known for known, _ in bare], [costs[at][turn] for _, at in bare]
            same.append(float(np.interp(contacts[key], grid, values)))
            ratios.append(costs[key][turn] / same[-1])
        print(
            f"| {key[0]} | {contacts[key]:.0f} | {median(costs[key]):.2f} | {median(same):.2f} | {spread(ratios, 2)} |"
        )


def mean_contacts(case: Case, seconds: float) -> float:
    """Return the mean number of contacts over the steps that are timed."""
    simulation = drumrs.Simulation(case.config, state=case.state)
    simulation.run(steps=round((1.0 + _SETTLE) * steps_for(Drumrs(), case.count, seconds)))
    counts = simulation.series["contact_count"].to_numpy()
    return float(counts[len(counts) // 6 :].mean())


def compare_sweeps(repeats: int) -> None:
    """Print how much faster two cores are than one for a sweep of so many cases that the last ones count for little."""
    cores = sorted(os.sched_getaffinity(0))
    print(f"\nA sweep of {_CASES} cases on two cores over one\n")
    if len(cores) < 2:  # noqa: PLR2004
        print("not measured: there is one core only")
        return
    rounds = [(_sweep_seconds(1), _sweep_seconds(2)) for _ in range(repeats)]
    least_one, least_two = (min(times) for times in zip(*rounds, strict=True))
    ratios = [one / two for one, two in rounds]
    print(f"{spread(ratios, 2)}; {least_one / least_two:.2f} by the least time of each")


def _sweep_seconds(jobs: int) -> float:
    """Return the time that a sweep of equal cases of five seconds takes on so many threads [s]."""
    base = drumrs.baseline().replace({"run.duration": 5.0, "run.window": (2.0, 5.0)})
    sweep = drumrs.Sweep(base, seeds=_CASES)
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(jobs) as executor:
        began = time.perf_counter()
        sweep.run(folder, executor, progress=False)
        return time.perf_counter() - began
