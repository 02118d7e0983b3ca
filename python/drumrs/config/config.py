"""`Config`: a complete simulation; and `baseline`, the paper's Table 1 as one."""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from pydantic import model_validator

from drumrs.config import types
from drumrs.config.layers import merge, nest, read_toml
from drumrs.config.messages import relation
from drumrs.config.softening import layer, softening
from drumrs.config.tables import Tables
from drumrs.config.to_core import core_config
from drumrs.config.toml_writer import to_toml
from drumrs.errors import ConfigError


class Config(Tables):
    """Everything that defines a simulation: frozen, validated, in SI units but for rpm and degrees.

    Examples
    --------
    >>> import drumrs
    >>> config = drumrs.baseline(fill=0.25, baffles=True)
    >>> config = config.replace({"contact.bundle.friction": 0.3, "load.count": 160})
    >>> config.contact.bundle.friction, config.bundle_count
    (0.3, 160)
    """

    @model_validator(mode="after")
    def _bundles_are_smaller_than_the_drum(self) -> Self:
        if self.drum.rim and self.load.diameter >= self.drum.diameter:
            raise relation(
                f"load.diameter is {self.load.diameter}, but must be smaller than "
                f"drum.diameter = {self.drum.diameter}"
            )
        one = (self.load.diameter / self.drum.diameter) ** 2
        if self.load.fill is not None and not one / 2.0 < self.load.fill <= one * types.GREATEST_COUNT:
            raise relation(
                f"load.fill is {self.load.fill}, but must be between {one / 2.0:.4g} and "
                f"{one * types.GREATEST_COUNT:.4g}: one bundle of diameter {self.load.diameter} fills {one:.4g} "
                f"of a drum of diameter {self.drum.diameter}"
            )
        return self

    @property
    def bundle_count(self) -> int:
        """Number of bundles N: given, or the whole number nearest to fill · D²/d²."""
        if self.load.count is not None:
            return self.load.count
        return round((self.load.fill or 0.0) * (self.drum.diameter / self.load.diameter) ** 2)

    @property
    def title(self) -> str:
        """A line that tells this case from others: bundles, fill, baffles, speed, seed.

        Examples
        --------
        >>> import drumrs
        >>> drumrs.baseline(fill=0.25, baffles=True).title
        '100 bundles (25 % fill), 3 baffles, 54 rpm, seed 1'
        """
        return self.title_of(
            self.bundle_count, self.bundle_count * (self.load.diameter / self.drum.diameter) ** 2
        )

    def title_of(self, bundle_count: int, fill: float) -> str:
        """Return the title with the number of bundles and the fill of a load that may have been given as a `State`.

        Examples
        --------
        >>> import drumrs
        >>> drumrs.baseline().title_of(1, 0.0025)
        '1 bundle (0.25 % fill), no baffles, 54 rpm, seed 1'
        """
        baffles = self.drum.baffles.count
        load = f"{bundle_count} bundle{'s' if bundle_count != 1 else ''} ({100.0 * fill:.3g} % fill)"
        many = "no baffles" if baffles == 0 else f"{baffles} baffle{'s' if baffles > 1 else ''}"
        turning = f"{self.rotation.rpm:g} rpm" if self.rotation.rpm is not None else "a program of speeds"
        return f"{load}, {many}, {turning}, seed {self.run.seed}"

    @property
    def digest(self) -> str:
        """32 hexadecimal digits that name this configuration: equal values, equal digest."""
        canonical = json.dumps(self.model_dump(mode="json", exclude_none=True), sort_keys=True)
        return hashlib.sha256(canonical.encode()).hexdigest()[:32]

    def replace(self, changes: Mapping[str, Any]) -> Self:
        """Return a copy with some keys changed, validated again.

        Parameters
        ----------
        changes
            Dotted keys, such as ``"contact.bundle.friction"``, or nested tables. One of an either–or pair
            (fill/count, restitution/normal_damping, rpm/program) takes the place of the other; `None` unsets.

        Raises
        ------
        ConfigError
            Where a key or a value is not accepted, or both of a pair are given.
        """
        lower = self.model_dump(exclude_none=True)
        return self.model_validate(merge(type(self), lower, nest(changes)))

    def softer(self, factor: float) -> Self:
        """Return a copy with both stiffnesses lowered by a factor, and the time step longer by its square root.

        A contact then lasts longer by that root and still takes as many steps; restitution stays what it is, so a
        `normal_damping` that is given is lowered by the root too. ``docs/accuracy.md`` tells what it costs.

        Parameters
        ----------
        factor
            At least 1.

        Raises
        ------
        ConfigError
            Where the factor is not accepted.

        Examples
        --------
        >>> import drumrs
        >>> config = drumrs.baseline().softer(100.0)
        >>> config.contact.bundle.normal_stiffness, f"{config.run.time_step:.3g}"
        (925000.0, '3.7e-05')
        """
        return self.replace(layer(self, softening(self, factor)))

    def to_toml(self, *, comments: bool = True) -> str:
        """Return the configuration as TOML, each key with its unit and meaning unless `comments` is false."""
        return to_toml(self, comments=comments)

    @classmethod
    def from_toml(cls, text: str) -> Self:
        """Lay TOML over the baseline.

        Raises
        ------
        ConfigError
            Where the text is not TOML, or a key or value is not accepted.
        """
        return cls().replace(read_toml(text))

    def to_json(self) -> str:
        """Return the configuration as JSON, keys that are not set left out."""
        return self.model_dump_json(exclude_none=True, indent=2)

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Lay a JSON object over the baseline.

        Raises
        ------
        ConfigError
            Where the text is not a JSON object, or a key or value is not accepted.
        """
        try:
            layer = json.loads(text)
        except (ValueError, RecursionError) as error:
            # Besides what is not JSON: integers of thousands of digits, lists nested a thousand deep.
            raise ConfigError(f"the configuration is not valid JSON: {error}") from None
        if not isinstance(layer, dict):
            raise ConfigError("the configuration is not a JSON object, but must be one of tables")
        return cls().replace(layer)

    @classmethod
    def read(cls, path: str | Path) -> Self:
        """Lay a TOML file over the baseline.

        Raises
        ------
        ConfigError
            Where the file cannot be read, or `from_toml` would raise.
        """
        return cls().replace(read_toml_file(path))

    def to_core_json(self) -> str:
        """Return what crosses to the compiled core: angular velocities, radians, a number of bundles."""
        return json.dumps(core_config(self, self.bundle_count))


def read_toml_file(path: str | Path) -> dict[str, Any]:
    """Read a case file as a layer.

    Raises
    ------
    ConfigError
        Where the file cannot be read or is not TOML.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise ConfigError(
            f"the case file is {str(path)!r}, but must be one that can be read: {reason}"
        ) from None
    return read_toml(text, str(path))


def baseline(fill: float = 0.25, *, baffles: bool = False) -> Config:
    """Return the paper's Table 1, averaged over t = 20–30 s.

    Parameters
    ----------
    fill
        Fill N d²/D² (0.25 is 100 bundles).
    baffles
        Whether the drum has three triangular baffles. Their size is an assumption: the paper's is lost.

    Examples
    --------
    >>> import drumrs
    >>> drumrs.baseline(fill=0.5).bundle_count
    200
    """
    return Config().replace({"load.fill": fill, "drum.baffles.count": 3 if baffles else 0})
