"""A server of the studio in a thread of its own."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from drumrs.studio.server import Server


@contextmanager
def serving(server: Server) -> Iterator[Server]:
    """Serve until the end of the block."""
    ready = threading.Event()
    thread = threading.Thread(target=server.serve, args=(ready.set,))
    thread.start()
    assert ready.wait(10.0)
    try:
        yield server
    finally:
        server.stop()
        thread.join(10.0)
    assert not thread.is_alive()
