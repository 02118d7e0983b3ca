"""The report's page: a study in, one HTML file out that needs nothing else."""

import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.config import baseline
from drumrs.files import write_whole
from drumrs.pages import environment, provenance, style, text_of
from drumrs.paper.cases import THIRDS
from drumrs.paper.data import StudyData
from drumrs.paper.drums import BAFFLED
from drumrs.paper.figures import FIGURES
from drumrs.paper.report import checks, facts, headline, pictures, table1
from drumrs.paper.verdict import FAILS, HOLDS, IN_PART, UNDECIDED
from drumrs.registry import quantity
from drumrs.viewer import script

if TYPE_CHECKING:
    from jinja2 import Template

_TITLE = "Loads tumbling in a rotating drum"
# Classes of the style sheet.
_CLASSES = {HOLDS: "holds", IN_PART: "partly", FAILS: "fails", UNDECIDED: "undecided"}
_CONTENTS = {
    "in-short": "In short",
    "claims": "The paper’s claims",
    "figures": "The paper’s figures",
    "motion": "See it move",
    "model": "Model and parameters",
    "checks": "Checks",
    "provenance": "Provenance",
}
_NAMES = {"speed": "Speed", "restitution": "Restitution", "drift": "Drift"}


def write(data: StudyData, path: str | Path, figures_folder: str | Path) -> pictures.Pictures:
    """Draw the figures, and write the report as one HTML file.

    Parameters
    ----------
    data
        The finished study.
    path
        File of the report.
    figures_folder
        Where the figures are kept as PNG and SVG.

    Returns
    -------
    Pictures
        The figures, with what some of them lack, and the pictures of claims.

    Raises
    ------
    OSError
        Where a file cannot be written.
    """
    drawn = pictures.draw(data, Path(figures_folder))
    write_whole(path, render(data, drawn).encode())
    return drawn


def render(data: StudyData, drawn: pictures.Pictures) -> str:
    """Return the report's page."""
    shown = [
        player.element(start=player.window[0] if player.window else None) for player in pictures.players(data)
    ]
    contents = [(anchor, name) for anchor, name in _CONTENTS.items() if shown or anchor != "motion"]
    return _template().render(
        title=_TITLE,
        quantity=quantity,
        style=style(),
        contents=contents,
        outcomes=_CLASSES,
        pictures=drawn.figures,
        thumbnails=drawn.thumbnails,
        drawn={one.figure.number for one in drawn.figures if one.address},
        names={number: _NAMES.get(number, f"Figure {number[1:]}") for number in FIGURES},
        players=shown,
        player_script=script() if shown else "",
        **_study(data),
        **_model(),
        **_checks(data),
        **_provenance(data),
    )


def _study(data: StudyData) -> dict[str, Any]:
    configs = list(data.configs.values())
    return {
        "scale": data.scale,
        "table_height": data.table.height,
        "duration": configs[0].run.duration,
        "window": configs[0].run.averaging_window,
        "seeds": headline.seeds(data),
        "softer": headline.softer(data),
        "more_seeds": headline.more_seeds(data),
        "verdicts": data.verdicts,
        "counts": headline.count_of_verdicts(data.verdicts),
        "takeaway": headline.takeaway(data),
        "how_judged": headline.HOW_JUDGED,
        "evidence": headline.EVIDENCE if any(one.is_evidence for one in data.verdicts) else "",
        "sentences": headline.sentences(data),
        "headline": headline.table(data),
        "fills": THIRDS,
        "failures": data.failures,
    }


def _model() -> dict[str, Any]:
    config = baseline()
    baffles = BAFFLED.config().drum.baffles
    return {
        "table1": table1.rows(),
        "contacts": table1.contacts(config),
        "scanned_stiffness": table1.SCANNED_STIFFNESS,
        "scanned_damping": table1.SCANNED_DAMPING,
        "scientific": table1.scientific,
        "mass": config.derived.bundle_mass,
        "restitution": config.contact.bundle.restitution,
        "step": config.run.time_step,
        "diameter": config.load.diameter,
        "baffle": baffles,
        "baffles_share": BAFFLED.baffles_share,
    }


def _checks(data: StudyData) -> dict[str, Any]:
    listed = checks.runs(data)
    return {
        "runs": listed,
        "parameters": checks.PARAMETERS,
        "drifting": [run for run in listed if run.drifting],
        "worst_residual": max(listed, key=lambda run: run.residual, default=None),
        "worst_disagreement": max(listed, key=lambda run: run.disagreement, default=None),
        "softness": checks.softness(data),
        "tiny": lambda value: table1.scientific(value) if value else "0",
    }


def _provenance(data: StudyData) -> dict[str, Any]:
    return {
        "versions": provenance.versions(),
        "machine": provenance.machine(),
        "times": facts.times(data),
        "software": facts.SOFTWARE,
        "authors": facts.AUTHORS,
        "paper": facts.PAPER,
        "paper_authors": facts.PAPER_AUTHORS,
    }


def _subscripts(text: str) -> str:
    """Set what follows an underscore lower: k_N."""
    from markupsafe import Markup, escape

    return Markup(re.sub(r"_(\w)", r"<sub>\1</sub>", str(escape(text))))  # noqa: S704 - escaped before


@cache
def _template() -> "Template":
    made = environment()
    made.filters["subscripts"] = _subscripts
    return made.from_string(text_of("drumrs.paper.report", "report.html.j2"))
