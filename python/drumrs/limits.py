"""What a simulation may be asked for: threads, steps, samples, memory; each refusal is one sentence."""

import math
import re

from drumrs.config import Config
from drumrs.errors import ConfigError

_MOST_THREADS = 1024
# Beyond this, step × time step is no longer exact to a step.
_MOST_STEPS = 2**53
# What samples and frames may each take in memory [bytes].
_MOST_MEMORY = 8 * 2**30
# A sample has some thirty columns, and three for each baffle and wall; a frame has four single numbers a bundle.
_SAMPLE, _SURFACE, _BUNDLE = 30 * 8, 3 * 8, 4 * 4


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


def require_memory(config: Config, count: int, time_step: float) -> None:
    """Refuse samples or frames that come so often that they would flood the memory in the end."""
    run, drum = config.run, config.drum
    sample = _SAMPLE + _SURFACE * (1 + drum.baffles.count + len(drum.walls))
    for key, interval, size in (
        ("run.sample_every", run.sample_every, sample),
        ("run.frame_every", run.frame_every, _BUNDLE * count),
    ):
        needed = run.duration / max(interval, time_step) * size
        if needed > _MOST_MEMORY:
            raise ConfigError(
                f"{key} is {interval}, but must be at least {run.duration * size / _MOST_MEMORY:.4g}: "
                f"what is recorded over run.duration = {run.duration} would take {needed / 2**30:.4g} GiB of memory, "
                f"and {_MOST_MEMORY / 2**30:g} are allowed"
            )


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
