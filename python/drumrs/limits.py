"""What a simulation may be asked for: threads, steps, samples, memory; each refusal is one sentence."""

import math
import os
import re
import shutil
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
# A sample has some thirty columns, and four for each baffle and wall; a frame has four single numbers a bundle.
_SAMPLE, _SURFACE, _BUNDLE, _FRAME = 30 * 8, 4 * 8, 4 * 4, 2 * 8


def check_threads(threads: int) -> None:
    """Refuse a number of threads that is none, or too many."""
    if isinstance(threads, bool) or not isinstance(threads, int) or not 1 <= threads <= _MOST_THREADS:
        raise ConfigError(f"threads is {threads!r}, but must be a whole number from 1 to {_MOST_THREADS}")


def check_steps(steps: int) -> int:
    """Return a number of steps; refuse what is none."""
    if isinstance(steps, bool) or not isinstance(steps, int) or not 0 <= steps <= _MOST_STEPS:
        raise ConfigError(f"steps is {steps!r}, but must be a whole number from 0 to {_MOST_STEPS}")
    return steps


def step_count(name: str, duration: float, time_step: float) -> int:
    """Return the number of steps that a time takes, rounded up."""
    if not duration / time_step <= _MOST_STEPS:
        greatest = f"{_MOST_STEPS * time_step:.4g}, {_MOST_STEPS} time steps of {time_step:.4g} s"
        raise ConfigError(f"{name} is {duration}, but must be at most {greatest}")
    return math.ceil(duration / time_step)


def require_samples(config: Config, time_step: float) -> None:
    """Refuse a window in which the averages would lack samples: now, not at the end of a long run."""
    run, (start, end) = config.run, config.run.averaging_window
    if run.sample_every < run.duration:
        interval = time_step * max(1, round(run.sample_every / time_step))
        last = math.floor(step_count("run.duration", run.duration, time_step) * time_step / interval)
        if math.floor(start / interval + 0.5) < min(math.floor(end / interval + 0.5), last):
            return
    raise ConfigError(
        f"run.sample_every is {run.sample_every}, but must be at most {(end - start) / 2.0:.4g}, "
        f"half the length of the window [{start:.4g}, {end:.4g}]"
    )


def require_memory(config: Config, count: int, time_step: float, *, with_frames: bool) -> None:
    """Refuse samples or frames that come so often that they would flood the memory in the end.

    Parameters
    ----------
    config
        What is to be simulated.
    count
        Number of bundles.
    time_step
        Time step [s].
    with_frames
        Whether frames stay in memory.
    """
    sizes = _sizes(config, count)
    if not with_frames:
        del sizes["run.frame_every"]
    way_out = "shorten run.duration" + (
        ", or let drumrs run --out OUT write frames to disk as they come" if with_frames else ""
    )
    _require_room(config, time_step, sizes, _memory(), "of memory", way_out)


def require_disk(config: Config, count: int, time_step: float, folder: Path) -> None:
    """Refuse samples and frames that the disk of a folder has no room for."""
    existing = next(path for path in (folder.absolute(), *folder.absolute().parents) if path.exists())
    disk = shutil.disk_usage(existing)
    # File systems without a size, such as /proc and some of a network, do not tell what they hold.
    if disk.total:
        where = f"on the disk of {str(folder)!r}"
        _require_room(
            config,
            time_step,
            _sizes(config, count),
            disk.free,
            where,
            "shorten run.duration, or free the disk",
        )


def _sizes(config: Config, count: int) -> dict[str, tuple[float, int]]:
    """Return how often samples and frames come [s], and how much room one of them takes [bytes]."""
    run, drum = config.run, config.drum
    sample = _SAMPLE + _SURFACE * (1 + drum.baffles.count + len(drum.walls))
    return {
        "run.sample_every": (run.sample_every, _COPIES * sample),
        "run.frame_every": (run.frame_every, _COPIES * (_FRAME + _BUNDLE * count)),
    }


def _require_room(
    config: Config,
    time_step: float,
    sizes: dict[str, tuple[float, int]],
    most: float,
    where: str,
    way_out: str,
) -> None:
    duration = config.run.duration
    needed = {key: duration / max(interval, time_step) * size for key, (interval, size) in sizes.items()}
    total = sum(needed.values())
    if total <= most:
        return
    key = max(needed, key=lambda key: needed[key])
    interval, size = sizes[key]
    # The rest is the smaller part; half of the room is enough for it. A full disk has room for nothing.
    left = max(most - (total - needed[key]), most / 2.0, 1.0)
    raise ConfigError(
        f"{key} is {interval}, but must be at least {duration * size / left:.4g}: "
        f"what is recorded over run.duration = {duration} would take {total / 2**30:.4g} GiB {where}, "
        f"and {most / 2**30:.4g} are there for it; {way_out}"
    )


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
    """Name the fill, which the user wrote, where the core refuses the count that follows from it."""
    refused = re.fullmatch(r"load\.count is (\d+), but must be at most (\d+): (.*)", str(error))
    if config.load.fill is None or refused is None:
        return error
    count, most, why = refused.groups()
    greatest = int(most) * (config.load.diameter / config.drum.diameter) ** 2
    return ConfigError(
        f"load.fill is {config.load.fill} ({count} bundles), but must be at most {greatest:.4g} "
        f"({most} bundles): {why}"
    )
