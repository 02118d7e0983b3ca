"""`Case`: one configuration with its seed, the name of its results and what it costs."""

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache, cached_property

from drumrs.config import Config
from drumrs.contact_records import recorded_tables
from drumrs.errors import ConfigError
from drumrs.simulation import info

_ID_DIGITS = 20
# So many digits are shown where they tell cases apart.
_SHORT_ID_DIGITS = 8


@dataclass(frozen=True, repr=False)
class Case:
    """One configuration, seed included.

    Attributes
    ----------
    config
        The configuration; its ``run.seed`` is the case's.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.sweep import Case
    >>> case = Case(drumrs.baseline(fill=0.25))
    >>> len(case.id), f"{case.cost:.3g}"
    (20, '8.11e+08')
    """

    config: Config

    def __repr__(self) -> str:
        """Say which case it is and how large."""
        return f"<Case {self.id}: {self.config.bundle_count} bundles, seed {self.seed}>"

    @cached_property
    def id(self) -> str:
        """Name of the case's results: equal configuration and equal physics, equal name."""
        words = f"{self.config.digest} physics {physics_version()}"
        return hashlib.sha256(words.encode()).hexdigest()[:_ID_DIGITS]

    @property
    def seed(self) -> int:
        """Seed of the random start."""
        return self.config.run.seed

    @property
    def load_mass(self) -> float:
        """Mass of the load per meter of drum depth [kg/m]."""
        return self.config.derived.load_mass

    @property
    def wants_frames(self) -> bool:
        """Whether frames are kept: where ``run.frame_every`` is smaller than ``run.duration``."""
        return self.config.run.frame_every < self.config.run.duration

    @property
    def contact_tables(self) -> tuple[str, ...]:
        """Names of the tables that are kept on request, by ``run.record`` and ``run.zone``."""
        return recorded_tables(self.config.run)

    @cached_property
    def cost(self) -> float:
        """Particle-steps that the case takes; 0 where its configuration is refused, as its run will say."""
        try:
            time_step = self.config.derived.time_step
        except ConfigError:
            return 0.0
        return self.config.bundle_count * self.config.run.duration / time_step


def is_id(text: str) -> bool:
    """Tell whether a word is the id of a case."""
    return len(text) == _ID_DIGITS and set(text) <= set("0123456789abcdef")


def short_ids(ids: Iterable[str], others: Iterable[str] = ()) -> dict[str, str]:
    """Return the beginnings of ids, by id, that tell them apart from each other and from others.

    Examples
    --------
    >>> from drumrs.sweep.case import short_ids
    >>> short_ids(["0123456789", "abcdefghij"], ["abcdefgh00"])
    {'0123456789': '012345678', 'abcdefghij': 'abcdefghi'}
    """
    ids = list(ids)
    known = {*ids, *others}
    lengths = range(_SHORT_ID_DIGITS, _ID_DIGITS)
    digits = next((n for n in lengths if len({one[:n] for one in known}) == len(known)), _ID_DIGITS)
    return {one: one[:digits] for one in ids}


@cache
def physics_version() -> int:
    """Return the version of the physics: results of different versions are different results."""
    return int(info()["physics_version"])
