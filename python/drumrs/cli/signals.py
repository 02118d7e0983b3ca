"""Signals that ask a command to end: SIGTERM, SIGHUP and SIGUSR1 do what Ctrl-C does.

Schedulers of clusters send the first some time before they kill, or SIGUSR1 where one asks them to; a terminal that is
closed sends SIGHUP.
"""

import signal
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

_NAMES = ("SIGTERM", "SIGHUP", "SIGUSR1", "SIGBREAK")


class Asked:
    """Which signal has asked for the end; Ctrl-C where none of ours has."""

    number: int = signal.SIGINT

    @property
    def status(self) -> int:
        """The exit status that says so: 128 and the signal's number."""
        return 128 + self.number

    @property
    def name(self) -> str:
        """Name of the signal, empty for Ctrl-C."""
        return "" if self.number == signal.SIGINT else signal.Signals(self.number).name


@contextmanager
def like_interrupts() -> Iterator[Asked]:
    """Raise `KeyboardInterrupt` within where one of these signals comes; one that is ignored, as by nohup, stays so."""
    asked = Asked()

    def interrupt(number: int, _: object) -> None:
        asked.number = number
        raise KeyboardInterrupt

    with ExitStack() as stack:
        # Handlers can be set in the main thread only.
        if threading.current_thread() is threading.main_thread():
            for name in _NAMES:
                number = getattr(signal, name, None)
                if number is not None and signal.getsignal(number) is signal.SIG_DFL:
                    stack.callback(signal.signal, number, signal.signal(number, interrupt))
        yield asked
