"""`Config`: a complete simulation; and `baseline`, the paper's Table 1 as one."""

import hashlib
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from pydantic import ModelWrapValidatorHandler, model_validator

from drumrs.config.derived import GREATEST_COUNT, Derived, Facts, compose, derive
from drumrs.config.drum_tables import Liner
from drumrs.config.hints import hints
from drumrs.config.laws import laws
from drumrs.config.layer_file import read_layer
from drumrs.config.layers import flat, merge, nest, read_json, read_toml
from drumrs.config.liner import with_drawing
from drumrs.config.load import SOLID_FRACTION
from drumrs.config.messages import conflict
from drumrs.config.scaling import Keep, scaling
from drumrs.config.softening import layer, softening
from drumrs.config.tables import Tables
from drumrs.config.to_core import core_config
from drumrs.config.toml_writer import to_toml
from drumrs.errors import ConfigError, format_value
from drumrs.notebook import table

_CHANGES = "a dict of keys with their values, such as {'load.fill': 0.3}"
# Less load than such a part of a bundle comes of lengths in another unit.
_FAR_OFF = 10.0


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
    def _species_have_laws_and_sizes(self) -> Self:
        laws(self.load, self.contact)
        if self.load.mass is not None and self.drum.depth is None:
            limit = "given where load.mass is: a mass is that of a whole drum"
            raise conflict("drum.depth", limit=limit, problem=f"is missing, but must be {limit}")
        if self.load.species:
            try:
                self._mean_bundle()
            except ConfigError as error:
                raise conflict(
                    error.key, error.value, error.limit, hint=error.hint, problem=error.problem
                ) from None
        return self

    @model_validator(mode="after")
    def _bundles_fit_into_the_drum(self) -> Self:
        load, drum = self.load, self.drum
        if drum.liner.file is not None:
            return self  # How large the drum is, the drawing tells.
        if drum.rim and not load.species and load.diameter >= drum.diameter:
            raise conflict("load.diameter", load.diameter, f"smaller than drum.diameter = {drum.diameter}")
        key, value, one = self.amount
        if key != "load.count" and not 0.5 * one < value <= GREATEST_COUNT * one:
            which = "on average" if load.species else f"of diameter {load.diameter}"
            does = (
                f"weighs {one:.4g} kg in a drum {drum.depth:g} m deep"
                if key == "load.mass"
                else f"fills {one:.4g} of a drum of diameter {drum.area_diameter:.6g}"
            )
            limit = f"between {0.5 * one:.4g} and {GREATEST_COUNT * one:.4g}: one bundle {which} {does}"
            far_off = value > GREATEST_COUNT * one or value < one / _FAR_OFF
            hint = "lengths are in meters: are some of these millimeters?" if far_off else ""
            raise conflict(key, value, limit, hint=hint)
        return self

    def _mean_bundle(self) -> tuple[float, float]:
        """Return area [m²] and mass, with its water [kg/m], of a bundle, on average."""
        load = self.load
        if load.species:
            return compose(load.species_to_core(), load.share_by or "number")[:2]
        area = math.pi / 4.0 * load.diameter * load.diameter
        return area, load.wet(load.density) * area

    @property
    def amount(self) -> tuple[str, float, float]:
        """How much load there is: the key that says it, its value, and how much of that one bundle is, on average."""
        load = self.load
        if load.count is not None:
            return "load.count", load.count, 1
        if load.mass is not None:
            dry = self._mean_bundle()[1] / load.wet(1.0)
            return "load.mass", load.mass, dry * (self.drum.depth or 0.0)
        if load.bulk_fill is not None:
            return "load.bulk_fill", load.bulk_fill, self.fill_of(1) / (load.solid_fraction or SOLID_FRACTION)
        return "load.fill", load.fill or 0.0, self.fill_of(1)

    @property
    def bundle_count(self) -> int:
        """Number of bundles N: given, or the whole number nearest to what fill or mass ask for."""
        key, value, one = self.amount
        if key == "load.fill" and not self.load.species:
            return round(value * (self.drum.area_diameter / self.load.diameter) ** 2)
        return round(value / one)

    @property
    def species_counts(self) -> dict[str, int]:
        """Number of bundles of each species of ``load.species``; empty where all are equal."""
        load = self.load
        if not load.species:
            return {}
        counts = compose(load.species_to_core(), load.share_by or "number", self.bundle_count)[2]
        return dict(zip(load.names, counts, strict=True))

    @property
    def fill(self) -> float:
        """Fill of the whole number of bundles N: their area over the bare drum's."""
        return self.fill_of(self.bundle_count)

    def fill_of(self, count: float) -> float:
        """Return the fill of so many bundles of the configured sizes: N d²/D² where all are equal."""
        if self.load.species:
            return (
                count
                * self._mean_bundle()[0]
                / (math.pi / 4.0 * self.drum.area_diameter * self.drum.area_diameter)
            )
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
        return derive(self.to_core_json(), self.run.seed, self.load.names)

    @property
    def title(self) -> str:
        """A line that tells this case from others: bundles, fill, baffles, speed, seed.

        Examples
        --------
        >>> import drumrs
        >>> drumrs.baseline(fill=0.25, baffles=True).title
        '100 bundles (25 % fill), 3 baffles, 54 rpm, seed 1'
        """
        return self.title_of(self.species_counts or self.bundle_count, self.fill)

    def title_of(self, bundles: int | Mapping[str, int], fill: float) -> str:
        """Return the title with the number and the fill of a load that may have been given as a `State`.

        Parameters
        ----------
        bundles
            Number of bundles, or of those of each species by its name.
        fill
            Their area over the bare drum's.

        Examples
        --------
        >>> import drumrs
        >>> drumrs.baseline().title_of(1, 0.0025)
        '1 bundle (0.25 % fill), no baffles, 54 rpm, seed 1'
        """
        counts = (
            bundles if isinstance(bundles, Mapping) else {"bundle" if bundles == 1 else "bundles": bundles}
        )
        load = (
            f"{' + '.join(f'{count} {name}' for name, count in counts.items())} ({100.0 * fill:.3g} % fill)"
        )
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
        >>> drumrs.baseline().replace({"load.density": 1.0, "run.time_step": "auto"}).hints
        ['load.density is 1 kg/m³, below 5: write 1000 where g/cm³ were meant']
        """
        return hints(self, self.derived)

    @property
    def digest(self) -> str:
        """32 hexadecimal digits that name this configuration: equal values, equal digest."""
        said = self.model_dump(mode="json", exclude_none=True)
        # Keys that say no more than their absence do not rename the results that lie on disk.
        if not self.load.species:
            said["contact"] |= {"species": 1, "pairs": [], "walls": []}
        if not self.drum.tilt:
            del said["drum"]["tilt"]
        if self.drum.liner == Liner():
            del said["drum"]["liner"]
        if not self.drum.baffles.corner_radius:
            del said["drum"]["baffles"]["corner_radius"]
        if not self.run.contact_floor:
            del said["run"]["contact_floor"]
        canonical = json.dumps(said, sort_keys=True)
        return hashlib.sha256(canonical.encode()).hexdigest()[:32]

    def replace(self, changes: Mapping[str, Any]) -> Self:
        """Return a copy with some keys changed, validated again.

        Parameters
        ----------
        changes
            Dotted keys, such as ``"contact.bundle.friction"``, or nested tables. One of an either–or choice
            (fill/bulk_fill/count/mass, restitution/normal_damping, rpm/program/phase) takes the place of the others;
            `None` unsets.

        Raises
        ------
        ConfigError
            Where a key or a value is not accepted, or two keys are given that stand for each other.
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

    def scaled(self, factor: float, keep: Keep = "groups") -> Self:
        """Return a drum whose lengths are larger by a factor, at the same Froude number and fill.

        Gravity and densities stay, so times go with the root of the factor, and the drum turns slower by it.

        Parameters
        ----------
        factor
            What the drum's lengths are multiplied with.
        keep
            ``"groups"``: bundles, stiffness, damping, adhesion and time step follow, so that every dimensionless group
            is what it was, and the motion is the same: bit for bit where the factor is a power of 4, or of 16 with
            ``contact.base = "hertz"``, whose damping has a fourth root.
            ``"bundle"``: bundles and their contacts stay what they are, and more of them fill the drum; D/d changes,
            and with it whatever depends on it.

        Raises
        ------
        ConfigError
            Where the factor or `keep` is not accepted, or no drum can be so large or so small.

        Examples
        --------
        >>> import drumrs
        >>> large = drumrs.baseline().scaled(4.0)
        >>> large.drum.diameter, large.rotation.rpm, large.bundle_count
        (1.9, 27.0, 100)
        >>> drumrs.baseline().scaled(4.0, keep="bundle").bundle_count
        1600
        """
        return self.replace(scaling(self, factor, keep))

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

    def _repr_html_(self) -> str:
        """Show in a notebook what differs from the baseline, and every key to unfold."""
        differs = {key: format_value(value) for key, value in self._beside_baseline().items()}
        return table(self.title, differs, ("all keys", self.to_toml()))

    def _beside_baseline(self) -> dict[str, Any]:
        """Return the values that differ from the baseline's by dotted key."""
        own, baseline = (
            flat(config.model_dump(mode="json", exclude_none=True)) for config in (self, type(self)())
        )
        return {key: value for key, value in own.items() if baseline.get(key) != value}

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
