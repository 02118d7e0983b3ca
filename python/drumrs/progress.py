"""Progress of runs: bars in a terminal or notebook, otherwise one line a minute on standard error."""

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from importlib import import_module
from typing import Any, Self

_MINUTE = 60.0
# Pauses between two pictures of the bars [s].
_PAUSE = 0.2


@dataclass(frozen=True)
class Journey:
    """A run to be reported: from where to where, and what a step is worth."""

    label: str
    first_step: int
    last_step: int
    time_step: float
    count: int


@dataclass(frozen=True)
class Campaign:
    """Many cases to be reported: how many, their particle-steps together, what they are.

    Where particle-steps are known roughly only, it is not `rated` by them.
    """

    cases: int
    cost: float
    label: str = "sweep"
    rated: bool = True


class Board:
    """Shows how far one or several runs are; this one, the base of the others, shows nothing."""

    def __enter__(self) -> Self:
        """Begin to show."""
        return self

    def __exit__(self, *_: object) -> None:
        """Stop showing."""

    def add(self, journey: Journey) -> Callable[[int], None]:
        """Show another run; the function returned is to be called with its step number."""
        del journey
        return _ignore

    def add_campaign(self, campaign: Campaign) -> Callable[[int, float], None]:
        """Show many cases; the function returned is to be called with cases and particle-steps done."""
        del campaign
        return _ignore

    def note(self, sentence: str) -> None:
        """Say something once."""


def _ignore(*_: float) -> None:
    """Take how far it is and say nothing."""


def board(*, show: bool) -> Board:
    """Choose how to show progress: bars where someone looks, lines in a log, nothing if not wanted."""
    if not show:
        return Board()
    from rich.console import Console

    if Console().is_jupyter:
        return Cell()
    return _Bars() if sys.stderr.isatty() else _Lines()


class Meter:
    """Rate and time left of one run."""

    def __init__(self, journey: Journey) -> None:
        self.journey = journey
        self.began = time.perf_counter()

    def rate(self, step: int) -> float:
        """Particle-steps per second so far."""
        elapsed = max(time.perf_counter() - self.began, 1e-9)
        return (step - self.journey.first_step) * self.journey.count / elapsed

    def line(self, step: int) -> str:
        """Say in one line how far the run is."""
        journey = self.journey
        done, end = step * journey.time_step, journey.last_step * journey.time_step
        rate = self.rate(step)
        left = (journey.last_step - step) * journey.count / rate if rate else float("inf")
        share = step / max(journey.last_step, 1)
        label = f"{journey.label}: " if journey.label else ""
        return f"{label}{share:.0%}, {done:.2f} of {end:.2f} s, {rate / 1e6:.1f} M particle-steps/s, {left:.0f} s left"


class Score:
    """Rate and time left of many cases, by what they cost and not by their number."""

    def __init__(self, campaign: Campaign) -> None:
        self.campaign = campaign
        self.began = time.perf_counter()

    def state(self, cases: int, cost: float) -> str:
        """Say how many cases are done, and how fast."""
        rate = cost / max(time.perf_counter() - self.began, 1e-9)
        speed = f" · {rate / 1e6:.1f} M particle-steps/s" if self.campaign.rated else ""
        return f"{cases} of {self.campaign.cases} cases{speed}"

    def line(self, cases: int, cost: float) -> str:
        """Say in one line how far it is."""
        share = cost / max(self.campaign.cost, 1.0)
        elapsed = time.perf_counter() - self.began
        left = f"{elapsed * (1.0 / share - 1.0):.0f} s left" if share else "time left unknown"
        return f"{self.campaign.label}: {share:.0%}, {self.state(cases, cost)}, {left}"


class _Lines(Board):
    def add(self, journey: Journey) -> Callable[[int], None]:
        meter = Meter(journey)
        due = meter.began + _MINUTE

        def report(step: int) -> None:
            nonlocal due
            if time.perf_counter() >= due:
                due = time.perf_counter() + _MINUTE
                self.note(meter.line(step))

        return report

    def add_campaign(self, campaign: Campaign) -> Callable[[int, float], None]:
        score = Score(campaign)
        due = score.began + _MINUTE

        def report(cases: int, cost: float) -> None:
            nonlocal due
            if time.perf_counter() >= due:
                due = time.perf_counter() + _MINUTE
                self.note(score.line(cases, cost))

        return report

    def note(self, sentence: str) -> None:
        sys.stderr.write(f"{sentence}\n")
        sys.stderr.flush()


class _Bars(Board):
    def __init__(self) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

        self._progress: Progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TaskProgressColumn(),
            TextColumn("{task.fields[state]}"),
            TimeRemainingColumn(),
            TextColumn("left"),
            console=Console(stderr=True),
        )

    def __enter__(self) -> Self:
        self._progress.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._progress.stop()

    def add(self, journey: Journey) -> Callable[[int], None]:
        meter = Meter(journey)
        label = journey.label or "drum"
        task = self._progress.add_task(label, total=journey.last_step, completed=journey.first_step, state="")
        end = journey.last_step * journey.time_step

        def report(step: int) -> None:
            now = step * journey.time_step
            state = f"{now:.2f} of {end:.2f} s · {meter.rate(step) / 1e6:.1f} M particle-steps/s"
            self._progress.update(task, completed=step, state=state)

        return report

    def add_campaign(self, campaign: Campaign) -> Callable[[int, float], None]:
        score = Score(campaign)
        task = self._progress.add_task(campaign.label, total=max(campaign.cost, 1.0), state="")

        def report(cases: int, cost: float) -> None:
            self._progress.update(task, completed=cost, state=score.state(cases, cost))

        return report

    def note(self, sentence: str) -> None:
        from rich import markup

        self._progress.print(markup.escape(sentence))


@dataclass
class _Row:
    """A bar: which part is done, and what stands beside it."""

    share: float = 0.0
    line: str = ""


class Cell(Board):
    """Shows bars below a notebook's cell: plain HTML, which needs no widgets and stays as it was at the end."""

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
