"""`Config`: a complete simulation; and `baseline`, the paper's Table 1 as one."""

import hashlib
import json
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from pydantic import ModelWrapValidatorHandler, model_validator

from drumrs.config.derived import GREATEST_COUNT, Derived, Facts, derive
from drumrs.config.hints import hints
from drumrs.config.layers import merge, nest, read_json, read_toml
from drumrs.config.liner import anchored, with_drawing
from drumrs.config.messages import conflict
from drumrs.config.softening import layer, softening
from drumrs.config.tables import Tables
from drumrs.config.to_core import core_config
from drumrs.config.toml_writer import to_toml
from drumrs.errors import ConfigError

_CHANGES = "a dict of keys with their values, such as {'load.fill': 0.3}"
_WRITE_ONE = "drumrs config > case.toml writes one with every key"


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

    @model_validator(mode="wrap")
    @classmethod
    def _drawing_is_read(cls, values: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        config = handler(values)
        return config if config.drum.liner.file is None else handler(with_drawing(config))

    @model_validator(mode="after")
    def _bundles_are_smaller_than_the_drum(self) -> Self:
        if self.drum.rim and self.load.diameter >= self.drum.diameter:
            limit = f"smaller than drum.diameter = {self.drum.diameter}"
            raise conflict("load.diameter", self.load.diameter, limit)
        if self.drum.liner.file is not None:
            return self  # How large the drum is, the drawing tells.
        least, one, greatest = (self.fill_of(count) for count in (0.5, 1, GREATEST_COUNT))
        if self.load.fill is not None and not least < self.load.fill <= greatest:
            limit = (
                f"between {least:.4g} and {greatest:.4g}: one bundle of diameter {self.load.diameter} fills {one:.4g} "
                f"of a drum of diameter {self.drum.area_diameter:.4g}"
            )
            raise conflict("load.fill", self.load.fill, limit)
        return self

    @property
    def bundle_count(self) -> int:
        """Number of bundles N: given, or the whole number nearest to fill · D²/d²."""
        if self.load.count is not None:
            return self.load.count
        return round((self.load.fill or 0.0) * (self.drum.area_diameter / self.load.diameter) ** 2)

    @property
    def fill(self) -> float:
        """Fill N d²/D² of the whole number of bundles N; in a drum that is not round D is that of an equal circle."""
        return self.fill_of(self.bundle_count)

    def fill_of(self, count: float) -> float:
        """Return the fill N d²/D² of so many bundles of the configured size."""
        return count * (self.load.diameter / self.drum.area_diameter) ** 2

    @property
    def derived(self) -> Derived:
        """What follows from the configuration: masses, damping, collision times, time step, Froude number.

        The compiled core computes it, by the formulas that it simulates with.

        Raises
        ------
        ConfigError
            Where no simulation can have this configuration.

        Examples
        --------
        >>> import drumrs
        >>> derived = drumrs.baseline().derived
        >>> f"{derived.bundle_mass:.4g} kg/m, damping {derived.bundle.normal_damping:.3g} N s/m"
        '0.443 kg/m, damping 5.35e+03 N s/m'
        >>> f"{derived.bundle.collision_time:.3g} s, Froude number {derived.froude_number:.3g}"
        '0.000191 s, Froude number 0.774'
        """
        return derive(self.to_core_json())

    @property
    def title(self) -> str:
        """A line that tells this case from others: bundles, fill, baffles, speed, seed.

        Examples
        --------
        >>> import drumrs
        >>> drumrs.baseline(fill=0.25, baffles=True).title
        '100 bundles (25 % fill), 3 baffles, 54 rpm, seed 1'
        """
        return self.title_of(self.bundle_count, self.fill)

    def title_of(self, bundle_count: int, fill: float) -> str:
        """Return the title with the number of bundles and the fill of a load that may have been given as a `State`.

        Examples
        --------
        >>> import drumrs
        >>> drumrs.baseline().title_of(1, 0.0025)
        '1 bundle (0.25 % fill), no baffles, 54 rpm, seed 1'
        """
        load = f"{bundle_count} bundle{'s' if bundle_count != 1 else ''} ({100.0 * fill:.3g} % fill)"
        turning = f"{self.rotation.rpm:g} rpm" if self.rotation.rpm is not None else "a program of speeds"
        return f"{load}, {self.drum.fittings}, {turning}, seed {self.run.seed}"

    @property
    def facts(self) -> str:
        """A line that places this case among others: Froude number, critical speed, load, resolution.

        Raises
        ------
        ConfigError
            Where no simulation can have this configuration.

        Examples
        --------
        >>> import drumrs
        >>> print(drumrs.baseline().facts)
        Froude number 0.774, 85.8 % of the critical speed, load 44.3 kg per m of depth, 51.5 steps per collision
        """
        return self.facts_line(self.derived)

    def facts_line(self, facts: Facts) -> str:
        """Return the line of a simulation, whose load may have been given as a `State`."""
        return facts.line(changing=self.rotation.rpm is None)

    @property
    def hints(self) -> list[str]:
        """What may not have been meant, such as a value in another unit, a sentence each; a simulation warns of it.

        Raises
        ------
        ConfigError
            Where no simulation can have this configuration.

        Examples
        --------
        >>> import drumrs
        >>> drumrs.baseline().hints
        []
        >>> drumrs.baseline().replace({"load.density": 1.0}).hints
        ['load.density is 1 kg/m³, below 5: write 1000 where g/cm³ were meant']
        """
        return hints(self, self.derived)

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
            Dotted keys, such as ``"contact.bundle.friction"``, or nested tables. One of an either–or choice
            (fill/count, restitution/normal_damping, rpm/program/phase) takes the place of the others; `None` unsets.

        Raises
        ------
        ConfigError
            Where a key or a value is not accepted, or both of a pair are given.
        """
        if not isinstance(changes, Mapping):
            raise ConfigError("changes", changes, _CHANGES)
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
        return cls().replace(read_json(text))

    @classmethod
    def read(cls, path: str | Path) -> Self:
        """Lay a file over the baseline: TOML, or JSON where its name ends with ``.json``.

        Raises
        ------
        ConfigError
            Where the file cannot be read, or `from_toml` or `from_json` would raise.
        """
        return cls().replace(read_layer(path))

    def to_core_json(self) -> str:
        """Return what crosses to the compiled core: angular velocities, radians, a number of bundles."""
        return json.dumps(core_config(self, self.bundle_count))


def require_config(config: object) -> Config:
    """Return a configuration; refuse what is none, and say how to get one.

    Raises
    ------
    ConfigError
        Where it is not a `Config`.
    """
    if isinstance(config, Config):
        return config
    hint = "drumrs.Config.read(path) reads a file, drumrs.baseline().replace({...}) changes some keys"
    raise ConfigError("config", config, "a Config", hint=hint)


def read_layer(path: str | Path) -> dict[str, Any]:
    """Read a file of configuration keys as a layer: TOML, or JSON where the name ends with ``.json``.

    Raises
    ------
    ConfigError
        Where the file cannot be read, or is not what its name says.
    """
    try:
        data = Path(path).read_bytes()
        # Some editors of Windows begin a file with a mark of its encoding, and write UTF-16.
        text = data.decode("utf-16" if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else "utf-8-sig")
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not text in UTF-8"
        problem = f"cannot be read as a file of configuration keys: {reason}"
        raise ConfigError(Path(path), problem=problem, hint=_WRITE_ONE) from None
    read = read_json if Path(path).suffix == ".json" else read_toml
    return anchored(read(text, Path(path)), Path(path).parent)


def baseline(fill: float = 0.25, *, baffles: bool = False) -> Config:
    """Return the paper's Table 1, averaged over t = 20–30 s.

    Parameters
    ----------
    fill
        Fill N d²/D² (0.25 is 100 bundles).
    baffles
        Whether the drum has three baffles. The paper's drawing of them is lost: the shape is inferred from its text
        (docs/study/baffle.md).

    Examples
    --------
    >>> import drumrs
    >>> drumrs.baseline(fill=0.5).bundle_count
    200
    """
    return Config().replace({"load.fill": fill, "drum.baffles.count": 3 if baffles else 0})
