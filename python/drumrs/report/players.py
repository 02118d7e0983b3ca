"""The runs that the report plays: 25 % fill, without and with baffles."""

from drumrs.report.findings import Findings
from drumrs.study import MissingError
from drumrs.study.cases import BASELINE_FILL
from drumrs.viewer import Player


def players(findings: Findings) -> list[Player]:
    """Return a player of the first seed without and one with baffles, as far as they are finished."""
    found = []
    for baffles in (False, True):
        try:
            sweep, case = findings.material.cases(BASELINE_FILL, baffles=baffles)[0]
        except MissingError:
            continue
        frames = sweep.frames(case, findings.folder)
        series = sweep.series(case, findings.folder)
        found.append(Player(frames, series, title=case.config.title, window=case.config.run.averaging_window))
    return found
