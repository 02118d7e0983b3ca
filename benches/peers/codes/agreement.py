"""Do the codes find the same power? Means over seeds of equal windows, compared within the errors of both."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import drumrs
from codes.balance import LEVEL, Measured, agree
from codes.beds import grown
from codes.case import Case, laws
from codes.ours import Drumrs
from codes.program import Code
from drumrs.analysis import Estimate
from drumrs.analysis import estimate as over_seeds

_COUNTS = (100, 200, 300)


def check(codes: Sequence[Code], options: argparse.Namespace, scratch: Path) -> bool:
    """Print specific powers of Table 1's drum in every code; return whether all agree with drumrs."""
    if all(code.name == "drumrs" for code in codes):
        sys.stderr.write("compare.py: check needs another code beside drumrs, but there is none\n")
        return False
    window = (options.duration / 3.0, options.duration)
    print(f"\nSpecific power [W/kg] by the balance of moments: {options.seeds} starts, ", end="")
    print(f"means over t = {window[0]:.3g} to {window[1]:.3g} s")
    print(f"agreement: zero lies in the {100 * LEVEL:.0f} % interval of the difference\n")
    print("| N | code | power | drumrs, same law | agree |")
    print("|---|---|---|---|---|")
    verdicts = []
    for count in _COUNTS:
        ours: dict[str, Estimate] = {}
        for code in codes:
            if code.name == "drumrs":
                continue
            law = "clipped" if code.name == "Yade" else "allowed"
            if law not in ours:
                ours[law] = _power(Drumrs(), count, law, options, scratch)
            theirs = _power(code, count, law, options, scratch)
            verdicts.append(agree(ours[law], theirs))
            print(
                f"| {count} | {code.name} | {show(theirs)} | {show(ours[law])} | {'yes' if verdicts[-1] else 'NO'} |",
                flush=True,
            )
    return all(verdicts)


def _power(code: Code, count: int, tension: str, options: argparse.Namespace, scratch: Path) -> Estimate:
    """Return a code's specific power, a mean over seeds."""
    window = (options.duration / 3.0, options.duration)
    means = []
    for seed in range(1, options.seeds + 1):
        case = Case.packed(check_config(count, seed, tension, options.duration))
        means.append(Measured.over(code.trace(case, options.duration, scratch), window).power)
    return over_seeds([mean.value for mean in means], [mean.error for mean in means])


def check_config(count: int, seed: int, tension: str, duration: float) -> drumrs.Config:
    """Return Table 1's drum; with tension clipped the dashpots stay as they are, as in Yade, and restitution rises."""
    config = grown(count)
    run = {"seed": seed, "duration": duration, "frame_every": duration}
    law: dict[str, float | str] = {}
    if tension == "clipped":
        pair, wall = laws(config)
        law = {f"contact.{side}.tension": tension for side in ("bundle", "drum")}
        law |= {"contact.bundle.normal_damping": pair.damping, "contact.drum.normal_damping": wall.damping}
    return config.replace({**law, "run": run})


def show(value: Estimate) -> str:
    """Write a mean with its standard error.

    Examples
    --------
    >>> from drumrs.analysis import Estimate
    >>> show(Estimate(4.1234, 0.0521, 3))
    '4.123 ± 0.052'
    """
    return f"{value.mean:.3f} ± {value.error:.3f}"
