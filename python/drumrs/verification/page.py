"""The page of a verification: a table of the cases, and of each a plot, its formula and its numbers."""

import re
from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

from drumrs.pages import address, environment, provenance, style, text_of
from drumrs.pictures import attempt
from drumrs.verification import theory
from drumrs.verification.case import Trial
from drumrs.verification.catalog import FAMILIES

if TYPE_CHECKING:
    from jinja2 import Template
    from markupsafe import Markup

_TITLE = "Verification of drumrs"


def render(tried: Sequence[Trial], wall_time: float, jobs: int) -> str:
    """Return the page."""
    trials = {trial.case.name: trial for trial in tried}
    families = {
        name: [trials[case.name] for case in cases if case.name in trials] for name, cases in FAMILIES.items()
    }
    checked = sum(len(trial.evidence.checks) for trial in tried if trial.evidence is not None)
    return _template().render(
        title=_TITLE,
        style=style(),
        count=len(tried),
        failures=[trial for trial in tried if not trial.passed],
        families={name: members for name, members in families.items() if members},
        pictures={name: _picture(trial) for name, trial in trials.items()},
        checked=checked,
        versions=provenance.versions(),
        machine=provenance.machine(),
        times=_times(tried, wall_time, jobs),
        theory=_theory(),
    )


def _times(tried: Sequence[Trial], wall_time: float, jobs: int) -> dict[str, str]:
    spent = sum(trial.wall_time for trial in tried)
    return {
        "cases": str(len(tried)),
        "time taken": f"{wall_time:.0f} s, {jobs} at once",
        "time of all cases": f"{spent:.0f} s",
        "page written": provenance.now(),
    }


def _picture(trial: Trial) -> str:
    """Return a case's plot as an address that holds it, empty where there is none."""
    if trial.evidence is not None:
        with attempt(f"the plot of {trial.case.name}"):
            from drumrs import figures
            from drumrs.verification.picture import agreement

            return address(figures.render(agreement(trial.evidence.panel), "svg"), "svg")
    return ""


def _theory() -> list["Markup"]:
    """Return the paragraphs on how far a run may be off, as the documentation of `theory` has them."""
    from markupsafe import Markup, escape

    _, _, told = (theory.__doc__ or "").partition("-----\n")
    strong = (
        re.sub(r"\*\*(.+?)\*\*", r"<b>\1</b>", str(escape(" ".join(part.split()))))
        for part in told.split("\n- ")
    )
    return [Markup(part) for part in strong]  # noqa: S704 - escaped before


def _number(value: float, digits: int = 6) -> str:
    return f"{value:.{digits}g}"


def _unit(unit: str) -> str:
    return "" if unit == "1" else unit


@cache
def _template() -> "Template":
    made = environment()
    filters: dict[str, Any] = {"number": _number, "unit": _unit}
    made.filters.update(filters)
    return made.from_string(text_of("drumrs.verification", "page.html.j2"))
