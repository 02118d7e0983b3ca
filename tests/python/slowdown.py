"""How much longer anything takes while the machine is busy with other things."""

import time


def slowdown() -> float:
    """Return the time that some work takes over that of its CPU: 1 on a machine at rest, more where CPUs are shared.

    What a process must do within two seconds it must do within so many more on a busy machine.
    """
    began, cpu = time.monotonic(), time.thread_time()
    while time.thread_time() - cpu < 0.2:
        pass
    return (time.monotonic() - began) / (time.thread_time() - cpu)
