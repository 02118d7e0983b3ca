"""Progress in a notebook's cell: bars of plain HTML, which need no widgets and stay as they were at the end."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from importlib import import_module
from typing import Any, Self

from drumrs.progress import Board, Campaign, Journey, Meter, Score

# Pauses between two pictures of the bars [s].
_PAUSE = 0.2


@dataclass
class _Row:
    """A bar: which part is done, and what stands beside it."""

    share: float = 0.0
    line: str = ""


class Cell(Board):
    """Shows bars below a notebook's cell."""

    def __init__(self) -> None:
        self._rows: list[_Row] = []
        self._notes: list[str] = []
        self._shown = 0.0
        self._display: Any = None

    def __enter__(self) -> Self:
        """Take a place below the cell."""
        # Where there is a notebook there is IPython.
        self._display = import_module("IPython.display").display(self, display_id=True)
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the bars as they were at the end."""
        self._show(now=True)

    def add(self, journey: Journey) -> Callable[[int], None]:
        """Show another run; the function returned is to be called with its step number."""
        meter, row = Meter(journey), self._add()

        def report(step: int) -> None:
            row.share, row.line = step / max(journey.last_step, 1), meter.line(step)
            self._show()

        return report

    def add_campaign(self, campaign: Campaign) -> Callable[[int, float], None]:
        """Show many cases; the function returned is to be called with cases and particle-steps done."""
        score, row = Score(campaign), self._add()

        def report(cases: int, cost: float) -> None:
            row.share, row.line = cost / max(campaign.cost, 1.0), score.line(cases, cost)
            self._show()

        return report

    def note(self, sentence: str) -> None:
        """Say something once, below the bars."""
        self._notes.append(sentence)
        self._show(now=True)

    def _add(self) -> _Row:
        self._rows.append(_Row())
        return self._rows[-1]

    def _show(self, *, now: bool = False) -> None:
        if self._display is not None and (now or time.perf_counter() >= self._shown + _PAUSE):
            self._shown = time.perf_counter()
            self._display.update(self)

    def __repr__(self) -> str:
        """Say how far it is, where no HTML is shown."""
        return "\n".join([*(row.line for row in self._rows), *self._notes])

    def _repr_html_(self) -> str:
        bars = (
            f'<div><progress max="1" value="{row.share:.4f}"></progress> {escape(row.line)}</div>'
            for row in self._rows
        )
        return "".join([*bars, *(f"<div>{escape(note)}</div>" for note in self._notes)])
