"""Progress of what takes long: bars in a terminal or notebook, otherwise lines on standard error.

Whatever takes long opens a `Task`. Tasks that are open at the same time, nested or on several threads, share a display.
"""

import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from html import escape
from importlib import import_module
from itertools import chain, repeat
from types import TracebackType
from typing import Any, ClassVar, Self

_HOUR, _MINUTE = 3600.0, 60.0
# Pauses between lines where there is no terminal, the first ones and all others [s].
_FIRST_PAUSES, _PAUSE = (1.0, 2.0, 7.0, 20.0, 30.0), 60.0
# Time between two updates of a notebook's cell [s].
_REFRESH = 0.2


class Task:
    """Something that takes long, shown while it is open: a bar in a terminal or notebook, else a line now and then.

    Without a terminal the first line comes after a second, then fewer and fewer, a line a minute in the end; what is
    over sooner says nothing. Rate and time left count from where the task began, so that they are right where something
    goes on that was interrupted.

    Parameters
    ----------
    label
        What it is, with its size where that is worth knowing.
    total
        How much there is to do; 0 where nobody knows, which shows the time taken only.
    unit
        What `total` counts; without one no rate is shown.
    done
        How much was done before.
    detail
        Shown beside the share: how far it is, in other words.
    show
        Whether anything is shown.

    Examples
    --------
    >>> import drumrs
    >>> with drumrs.Task("sieving", total=3, unit="loads", show=False) as task:
    ...     for _ in range(3):
    ...         task.advance()
    >>> task.share
    1.0
    """

    def __init__(
        self,
        label: str,
        total: float,
        unit: str = "",
        *,
        done: float = 0.0,
        detail: str = "",
        show: bool = True,
    ) -> None:
        self.label = label
        self.total = total
        self.unit = unit
        self.done = done
        self.detail = detail
        self._show = show
        self._first = done
        self._lock = threading.Lock()
        self._began = time.perf_counter()
        self._ended: float | None = None
        self._display: ProgressDisplay | None = None

    def __enter__(self) -> Self:
        """Begin to count time, and show the task."""
        self._began = time.perf_counter()
        if self._show:
            self._display = ProgressDisplay.of(self)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, _: BaseException | None, __: TracebackType | None
    ) -> None:
        """Show the task no longer; what was shown of it stays."""
        self._ended = time.perf_counter()
        if self._display is not None:
            self._display.close(self, finished=kind is None)

    def advance(self, amount: float = 1.0, detail: str | None = None) -> None:
        """Say that so much more is done; safe from any thread."""
        with self._lock:
            self.done += amount
        self._tell(detail)

    def update(self, done: float, detail: str | None = None) -> None:
        """Say how much is done altogether."""
        self.done = done
        self._tell(detail)

    def note(self, sentence: str) -> None:
        """Say something once, apart from the bars."""
        if self._display is not None:
            self._display.note(sentence)

    @property
    def share(self) -> float:
        """The part that is done, from 0 to 1."""
        return min(self.done / self.total, 1.0) if self.total else float(self._ended is not None)

    @property
    def elapsed(self) -> float:
        """Time since the task was opened [s]."""
        return (self._ended or time.perf_counter()) - self._began

    @property
    def rate(self) -> float:
        """What was done in a second, on average."""
        return (self.done - self._first) / max(self.elapsed, 1e-9)

    def state(self) -> str:
        """Return in words how far the task is, how fast it goes and how long it takes."""
        words = [self.detail] if self.detail else []
        if self.unit and self.rate > 0.0:
            words.append(f"{with_prefix(self.rate)}{self.unit}/s")
        if self._ended is not None or not self.total:
            words.append(f"{format_duration(self.elapsed)} taken")
        elif self.rate > 0.0:
            words.append(f"{format_duration(max(self.total - self.done, 0.0) / self.rate)} left")
        else:
            words.append("time left not known yet")
        return ", ".join(words)

    def __str__(self) -> str:
        """Say in a line how far the task is."""
        share = f"{self.share:.0%}, " if self.total else ""
        return f"{self.label}: {share}{self.state()}"

    def _tell(self, detail: str | None) -> None:
        if detail is not None:
            self.detail = detail
        if self._display is not None:
            self._display.update(self)


def with_prefix(number: float) -> str:
    """Write a large number with a prefix, and a space after it.

    Examples
    --------
    >>> with_prefix(12_340_000.0) + "steps", with_prefix(40) + "steps"
    ('12.3 M steps', '40 steps')
    """
    for scale, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if number >= scale:
            return f"{number / scale:.1f} {prefix} "
    return f"{number:.3g} "


def format_duration(seconds: float) -> str:
    """Write a time as people say it.

    Examples
    --------
    >>> format_duration(42.3), format_duration(125.0), format_duration(9000.0)
    ('42 s', '2 min 5 s', '2 h 30 min')
    """
    whole = round(seconds)
    if whole < _MINUTE:
        return f"{whole} s"
    if whole < _HOUR:
        return f"{whole // 60} min {whole % 60} s" if whole % 60 else f"{whole // 60} min"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


class ProgressDisplay:
    """Where the tasks that are open are shown; there is one at a time."""

    _lock: ClassVar = threading.RLock()
    _current: "ClassVar[ProgressDisplay | None]" = None
    is_hidden: ClassVar[bool] = False

    def __init__(self) -> None:
        self.tasks: list[Task] = []

    @classmethod
    def of(cls, task: Task) -> "ProgressDisplay":
        """Show a task on the display that is there, or on a new one."""
        with cls._lock:
            display = ProgressDisplay._current
            if display is None:
                display = _suitable()
                display.start()
                ProgressDisplay._current = display
            display.tasks.append(task)
            display.update(task)
        return display

    def close(self, task: Task, *, finished: bool) -> None:
        """Show a task for the last time; with the last task the display ends."""
        with self._lock:
            self.tasks.remove(task)
            try:
                self.end(task, finished=finished)
            finally:
                if not self.tasks:
                    ProgressDisplay._current = None
                    self.stop()

    def start(self) -> None:
        """Begin to show tasks."""

    def stop(self) -> None:
        """End showing tasks."""

    def update(self, task: Task) -> None:
        """Show how far a task is now."""

    def end(self, task: Task, *, finished: bool) -> None:
        """Show how a task ended."""
        del finished
        self.update(task)

    def note(self, sentence: str) -> None:
        """Say something once."""
        raise NotImplementedError


@contextmanager
def hidden() -> Iterator[None]:
    """Show nothing of any task within."""
    before, ProgressDisplay.is_hidden = ProgressDisplay.is_hidden, True
    try:
        yield
    finally:
        ProgressDisplay.is_hidden = before


def _suitable() -> ProgressDisplay:
    if ProgressDisplay.is_hidden:
        return _NoDisplay()
    from rich.console import Console

    if Console().is_jupyter:
        return _NotebookDisplay()
    return _TerminalDisplay() if sys.stderr.isatty() else _LogDisplay()


class _NoDisplay(ProgressDisplay):
    """Nothing at all."""

    def note(self, sentence: str) -> None:
        """Say nothing."""


class _LogDisplay(ProgressDisplay):
    """Lines on standard error, written on a thread of their own: some tasks have nothing to tell for a while."""

    def start(self) -> None:
        self._over = threading.Event()
        self._writer = threading.Thread(target=self._write, name="drumrs progress", daemon=True)
        self._writer.start()

    def stop(self) -> None:
        self._over.set()
        self._writer.join()

    def end(self, task: Task, *, finished: bool) -> None:
        if finished and task.elapsed >= _FIRST_PAUSES[0]:
            self.note(str(task))

    def note(self, sentence: str) -> None:
        sys.stderr.write(f"{sentence}\n")
        sys.stderr.flush()

    def _write(self) -> None:
        for pause in chain(_FIRST_PAUSES, repeat(_PAUSE)):
            if self._over.wait(pause):
                return
            for task in tuple(self.tasks):
                self.note(str(task))


class _TerminalDisplay(ProgressDisplay):
    """Bars in a terminal, drawn by rich."""

    def __init__(self) -> None:
        super().__init__()
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TaskID, TaskProgressColumn, TextColumn

        self._bars: dict[Task, TaskID] = {}
        # Labels and details may hold what rich takes for markup.
        self._progress = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(bar_width=24),
            TaskProgressColumn(),
            TextColumn("{task.fields[state]}", markup=False),
            console=Console(stderr=True),
        )

    def start(self) -> None:
        self._progress.start()

    def stop(self) -> None:
        self._progress.stop()

    def update(self, task: Task) -> None:
        if task not in self._bars:
            self._bars[task] = self._progress.add_task(task.label, total=task.total or None, state="")
        self._progress.update(self._bars[task], completed=task.done, state=task.state())

    def note(self, sentence: str) -> None:
        self._progress.console.print(sentence, markup=False, highlight=False)


class _NotebookDisplay(ProgressDisplay):
    """Bars below a notebook's cell: plain HTML, which needs no widgets and stays as it was at the end."""

    def __init__(self) -> None:
        super().__init__()
        self._rows: dict[Task, str] = {}
        self._notes: list[str] = []
        self._shown = 0.0
        self._output: Any = None

    def start(self) -> None:
        # Where there is a notebook there is IPython.
        self._output = import_module("IPython.display").display(self, display_id=True)

    def stop(self) -> None:
        self._refresh()

    def update(self, task: Task) -> None:
        self._rows[task] = str(task)
        if time.perf_counter() >= self._shown + _REFRESH:
            self._refresh()

    def note(self, sentence: str) -> None:
        self._notes.append(sentence)
        self._refresh()

    def _refresh(self) -> None:
        self._shown = time.perf_counter()
        if self._output is not None:
            self._output.update(self)

    def __repr__(self) -> str:
        return "\n".join([*self._rows.values(), *self._notes])

    def _repr_html_(self) -> str:
        bars = (
            f'<div><progress max="1" value="{task.share:.4f}"></progress> {escape(line)}</div>'
            for task, line in tuple(self._rows.items())
        )
        return "".join([*bars, *(f"<div>{escape(note)}</div>" for note in self._notes)])
