"""How many cases run at once."""

from drumrs import _core
from drumrs.errors import ConfigError

MOST_JOBS = 1024


def effective_jobs(jobs: int | None = None) -> int:
    """Return how many cases are to run at once.

    Parameters
    ----------
    jobs
        What was asked for. Unless given, one a core that this process may use: of those of the machine the ones that
        its affinity and the quota of its container (cgroup) leave it.

    Raises
    ------
    ConfigError
        Where it is not a whole number within the limits.

    Examples
    --------
    >>> import drumrs
    >>> drumrs.effective_jobs(3), drumrs.effective_jobs() >= 1
    (3, True)
    """
    if jobs is None:
        return int(_core.info()["cpu_count"])
    if isinstance(jobs, bool) or not isinstance(jobs, int) or not 1 <= jobs <= MOST_JOBS:
        raise ConfigError("jobs", jobs, f"a whole number from 1 to {MOST_JOBS}", bound=MOST_JOBS)
    return jobs
