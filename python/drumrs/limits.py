"""Limits of a simulation: threads, steps, samples, and the memory and disk that its records take."""

import math
import os
import shutil
from collections.abc import Mapping
from pathlib import Path

from drumrs.config import Config
from drumrs.errors import ConfigError

_MOST_THREADS = 1024
# Beyond this, step × time step is no longer exact to a step.
_MOST_STEPS = 2**53
# What is recorded may take so much memory [bytes].
_MOST_MEMORY = 8 * 2**30
# Records in memory are there twice when they are read: in the simulation, and with whoever reads them. On disk as well,
# when the parts of a run are put together.
_COPIES = 2


def check_threads(threads: int) -> None:
    """Refuse what is no number of threads, or too large a one."""
    if isinstance(threads, bool) or not isinstance(threads, int) or not 1 <= threads <= _MOST_THREADS:
        limit = f"a whole number from 1 to {_MOST_THREADS}"
        raise ConfigError("threads", threads, limit, bound=_MOST_THREADS)


def check_steps(steps: int) -> int:
    """Return a number of steps; refuse what is no such number."""
    if isinstance(steps, bool) or not isinstance(steps, int) or not 0 <= steps <= _MOST_STEPS:
        raise ConfigError("steps", steps, f"a whole number from 0 to {_MOST_STEPS}", bound=_MOST_STEPS)
    return steps


def step_count(key: str, duration: float, time_step: float) -> int:
    """Return the number of steps that a duration [s] takes, rounded up."""
    if not duration / time_step <= _MOST_STEPS:
        greatest = _MOST_STEPS * time_step
        limit = f"at most {greatest:.4g}, {_MOST_STEPS} time steps of {time_step:.4g} s"
        raise ConfigError(key, duration, limit, bound=greatest)
    return math.ceil(duration / time_step)


def require_samples(config: Config, time_step: float) -> None:
    """Refuse a window in which the averages would lack samples: now, not at the end of a long run."""
    run, (start, end) = config.run, config.run.averaging_window
    if run.sample_every < run.duration:
        interval = time_step * max(1, round(run.sample_every / time_step))
        last = math.floor(step_count("run.duration", run.duration, time_step) * time_step / interval)
        if math.floor(start / interval + 0.5) < min(math.floor(end / interval + 0.5), last):
            return
    greatest = (end - start) / 2.0
    limit = f"at most {greatest:.4g}, half the length of the window [{start:.4g}, {end:.4g}]"
    raise ConfigError("run.sample_every", run.sample_every, limit, bound=greatest)


def require_memory(config: Config, time_step: float, sizes: Mapping[str, int], *, with_frames: bool) -> None:
    """Refuse samples or frames that come so often that they would not fit into memory at the end.

    Parameters
    ----------
    config
        What is to be simulated.
    time_step
        Time step [s].
    sizes
        Size of one record [bytes] by the key of its interval, as `Records.sizes`.
    with_frames
        Whether frames stay in memory.
    """
    kept = {key: size for key, size in sizes.items() if with_frames or key != "run.frame_every"}
    hint = "shorten run.duration" + (
        ", or let drumrs run --out OUT write frames to disk as they come" if with_frames else ""
    )
    _require_room(config, time_step, kept, _memory(), "of memory", hint)


def require_disk(config: Config, time_step: float, sizes: Mapping[str, int], folder: Path) -> None:
    """Refuse samples and frames that the disk of a folder has no room for; the parameters are as above."""
    existing = next(path for path in (folder.absolute(), *folder.absolute().parents) if path.exists())
    disk = shutil.disk_usage(existing)
    # File systems without a size, such as /proc and some of a network, do not tell what they hold.
    if disk.total:
        where = f"on the disk of {str(folder)!r}"
        _require_room(config, time_step, sizes, disk.free, where, "shorten run.duration, or free the disk")


def _require_room(
    config: Config, time_step: float, sizes: Mapping[str, int], most: float, where: str, hint: str
) -> None:
    duration = config.run.duration
    intervals = {"run.sample_every": config.run.sample_every, "run.frame_every": config.run.frame_every}
    needed = {key: duration / max(intervals[key], time_step) * _COPIES * size for key, size in sizes.items()}
    total = sum(needed.values())
    if total <= most:
        return
    key = max(needed, key=lambda key: needed[key])
    # The rest is the smaller part; half of the room is enough for it. A full disk has room for nothing.
    left = max(most - (total - needed[key]), most / 2.0, 1.0)
    least = duration * _COPIES * sizes[key] / left
    limit = (
        f"at least {least:.4g}: what is recorded over run.duration = {duration} would take "
        f"{total / 2**30:.4g} GiB {where}, and {most / 2**30:.4g} are there for it"
    )
    raise ConfigError(key, intervals[key], limit, hint=hint, bound=least)


def _memory() -> float:
    """Return the memory that records may take [bytes]: no more than there is, or than this process may have."""
    try:
        import resource

        granted, _ = resource.getrlimit(resource.RLIMIT_AS)
        there = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (ImportError, AttributeError, ValueError, OSError):
        return _MOST_MEMORY
    return min(_MOST_MEMORY, there, granted if granted != resource.RLIM_INFINITY else math.inf)


def in_terms_of_fill(config: Config, error: ConfigError) -> ConfigError:
    """Name the fill or mass that the user wrote, where the core refuses the number of bundles that follows."""
    key, value, one = config.amount
    if key == "load.count" or error.key != "load.count" or error.bound is None:
        return error
    most = int(error.bound)
    limit = f"at most {most * one:.4g} ({most} bundles): no more of them fit into this drum"
    problem = f"is {value} ({config.bundle_count} bundles), but must be {limit}"
    of_percent = value / 100.0
    is_percent = key != "load.mass" and of_percent <= 1.0 < value
    hint = f"a fill of {value:g} % is {of_percent:g}" if is_percent else ""
    return ConfigError(key, value, limit, problem=problem, hint=hint, bound=most * one)
