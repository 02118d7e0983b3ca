"""The page of a verification: a table of the cases, and of each a plot, its formula and its numbers."""

import base64
import re
from functools import cache
from typing import TYPE_CHECKING, Any

from drumrs.report import facts
from drumrs.report.template import environment, style, text_of

if TYPE_CHECKING:
    from jinja2 import Template
    from markupsafe import Markup

    from drumrs.verification.case import Trial
    from drumrs.verification.runner import Verification

_TITLE = "Verification of drumrs"


def render(found: "Verification") -> str:
    """Return the page."""
    from drumrs.verification.catalog import FAMILIES

    trials = {trial.case.name: trial for trial in found.trials}
    families = {
        name: [trials[case.name] for case in cases if case.name in trials] for name, cases in FAMILIES.items()
    }
    checked = sum(len(trial.evidence.checks) for trial in found.trials if trial.evidence is not None)
    return _template().render(
        title=_TITLE,
        style=style(),
        found=found,
        families={name: members for name, members in families.items() if members},
        pictures={name: _picture(trial) for name, trial in trials.items()},
        checked=checked,
        versions=facts.versions(),
        machine=facts.machine(),
        times=_times(found),
        theory=_theory(),
    )


def _times(found: "Verification") -> dict[str, str]:
    spent = sum(trial.wall_time for trial in found.trials)
    return {
        "cases": str(len(found.trials)),
        "time taken": f"{facts.duration(found.wall_time)}, {found.jobs} at once",
        "time of all cases": facts.duration(spent),
        "page written": facts.now(),
    }


def _picture(trial: "Trial") -> str:
    """Return a case's plot as an address that holds it, empty where there is none."""
    from drumrs import figures

    if trial.evidence is None:
        return ""
    drawn = figures.svg(figures.agreement(trial.evidence.panel))
    return f"data:image/svg+xml;base64,{base64.b64encode(drawn).decode('ascii')}"


def _theory() -> list["Markup"]:
    """Return the paragraphs on how far a run may be off, as the documentation of `theory` has them."""
    from markupsafe import Markup, escape

    from drumrs.verification import theory

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
