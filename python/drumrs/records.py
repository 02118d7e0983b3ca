"""`Records`: what a simulation has recorded and still holds; handed to whoever keeps it on disk, and taken back."""

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from drumrs.config import Config
from drumrs.contact_records import FLOWS, TableMaker, recorded_tables
from drumrs.errors import CheckpointError, ConfigError
from drumrs.frames import SHAPED, Frames

if TYPE_CHECKING:
    import polars as pl

Array = NDArray[np.float64]


class Core(Protocol):
    """What `Records` asks of the compiled core."""

    @property
    def count(self) -> int:
        """Number of bundles."""

    @property
    def radii(self) -> Array:
        """Radii of the bundles [m]."""

    @property
    def species(self) -> NDArray[np.uint16]:
        """Places of the bundles' species in the list of names."""

    @property
    def first_sample(self) -> int:
        """Samples recorded before the first in memory."""

    @property
    def first_untaken_sample(self) -> int:
        """Samples recorded before the first that was not taken."""

    @property
    def first_frame(self) -> int:
        """Frames recorded before the first in memory."""

    @property
    def record_sizes(self) -> tuple[int, int]:
        """Memory that a sample and a frame take [bytes]."""

    @property
    def untaken_size(self) -> int:
        """Memory of what was not taken yet [bytes]."""

    def outlines(self) -> tuple[Array | None, list[Array], list[Array]]:
        """Return the shell, if there is one, the baffles and the walls [m]."""

    def series(self) -> dict[str, Array]:
        """Columns of the samples in memory."""

    def frames(self) -> dict[str, NDArray[Any]]:
        """Return a copy of the frames in memory."""

    def take_frames(self) -> dict[str, NDArray[Any]]:
        """Return the frames in memory, which are then no longer there."""

    def take_records(self, into: dict[str, Any]) -> None:
        """Put frames and samples that were not taken yet into a dict."""

    def put_back_rows(self, rows: Array, taken: bool) -> None:
        """Put samples before those in memory."""

    def put_back_frames(self, frames: dict[str, NDArray[Any]]) -> None:
        """Put frames before those in memory."""

    @property
    def time_step(self) -> float:
        """Length of a step [s]."""

    @property
    def first_contact(self) -> int:
        """Contacts recorded before the first in memory."""

    def parts(self) -> list[str]:
        """Names of the parts of the drum."""

    def contacts(self, are_open: bool) -> dict[str, NDArray[Any]]:
        """Return the contacts that are open, or those in memory that have ended."""

    def recorded_sums(self) -> dict[str, Any]:
        """Return what is summed up on request, up to now."""

    def put_back_contacts(self, contacts: dict[str, NDArray[Any]]) -> None:
        """Put contacts before those in memory."""


class Records:
    """What a simulation has recorded and still holds in memory.

    Parameters
    ----------
    core
        The compiled core.
    config
        The simulation's configuration.
    columns
        Names of the columns of the series.

    Attributes
    ----------
    columns
        Names of the columns of the series.
    """

    def __init__(self, core: Core, config: Config, columns: list[str]) -> None:
        self.columns = columns
        self._core = core
        self._drum = config.drum
        self._names = config.load.names
        self._kinds = recorded_tables(config.run)
        self._zones = tuple(zone.name for zone in config.run.zone or ())
        self._floor = config.run.contact_floor

    @property
    def count(self) -> int:
        """Number of bundles n."""
        return self._core.count

    @property
    def species(self) -> tuple[str, ...]:
        """Name of each bundle's species; empty where the load has none."""
        return tuple(self._names[own] for own in self._core.species) if self._names else ()

    @property
    def size(self) -> int:
        """Memory of what was not taken yet [bytes]."""
        return self._core.untaken_size

    @property
    def sizes(self) -> dict[str, int]:
        """Size of one sample and of one frame [bytes], by the key of its interval."""
        return dict(zip(("run.sample_every", "run.frame_every"), self._core.record_sizes, strict=True))

    @property
    def taken_samples(self) -> int:
        """Samples taken so far, the first ones recorded."""
        return self._core.first_untaken_sample

    @property
    def taken_frames(self) -> int:
        """Frames taken so far, the first ones recorded."""
        return self._core.first_frame

    @property
    def taken_contacts(self) -> int:
        """Contacts taken so far, the first ones that ended."""
        return self._core.first_contact

    @property
    def lists_contacts(self) -> bool:
        """Whether contacts are recorded one by one."""
        return "contacts" in self._kinds

    @property
    def are_whole(self) -> bool:
        """Whether everything recorded is in memory."""
        return self._core.first_sample == self._core.first_frame == self._core.first_contact == 0

    @property
    def has_whole_series(self) -> bool:
        """Whether all samples are in memory."""
        return self._core.first_sample == 0

    def series(self) -> "pl.DataFrame":
        """Return the samples in memory, one row each."""
        import polars as pl

        columns = self._core.series()
        # polars copies: a column at a time, or there would be two tables for a moment.
        return pl.DataFrame([pl.Series(name, columns.pop(name)) for name in list(columns)])

    def frames(self, *, keep: bool = True) -> Frames:
        """Return the frames in memory.

        Parameters
        ----------
        keep
            Whether they stay there, too; without it nothing is copied.
        """
        return self.as_frames(self._core.frames() if keep else self._core.take_frames())

    def as_contacts(self, arrays: dict[str, NDArray[Any]]) -> "pl.DataFrame":
        """Return contacts of the core that have ended as a table."""
        return self._tables.contacts(arrays)

    def last_contacts(self) -> "pl.DataFrame":
        """Return the end of the table of contacts: those still open, and what was too small to be listed."""
        import polars as pl

        tables = self._tables
        open_now = tables.contacts(self._core.contacts(True), is_open=True)
        if not self._floor:
            return open_now
        return pl.concat([open_now, tables.below_floor(*self._core.recorded_sums()["below_floor"])])

    def contact_tables(self, *, with_contacts: bool = True) -> dict[str, Any]:
        """Return what is recorded on request, by table, and "dissipated", what those of contacts add up to [J/m].

        Parameters
        ----------
        with_contacts
            Whether the list of contacts is among them.

        Raises
        ------
        ConfigError
            Where that list is asked for and contacts were taken out of memory.
        """
        import polars as pl

        if not self._kinds:
            return {}
        sums, tables = self._core.recorded_sums(), self._tables
        made: dict[str, Any] = {"dissipated": dict(zip(FLOWS, sums["dissipated"], strict=True))}
        if self.lists_contacts and with_contacts:
            if self.taken_contacts:
                problem = (
                    f"has 'contacts', but the first {self.taken_contacts} of them are no longer in memory"
                )
                hint = "load the checkpoint where its run wrote it, beside its records"
                raise ConfigError("run.record", problem=problem, hint=hint)
            ended = tables.contacts(self._core.contacts(False))
            made["contacts"] = pl.concat([ended, self.last_contacts()])
        if "wall_profile" in self._kinds:
            made["wall_profile"] = tables.wall_profile(sums["profile"])
        if "ledger_split" in self._kinds:
            made["ledger_split"] = tables.ledger_split(sums["split"])
        if "discs" in self._kinds:
            made["discs"] = tables.discs(sums["discs"], self._core.radii, self._core.species)
        if "fields" in self._kinds:
            made["fields"] = tables.fields(sums["fields"])
        if "zone_visits" in self._kinds:
            made["zone_visits"] = tables.zone_visits(sums["visits"], self._zones, self._core.species)
        return made

    @property
    def _tables(self) -> TableMaker:
        return TableMaker(tuple(self._core.parts()), tuple(self._names) or ("bundle",), self._core.time_step)

    def take(self, into: dict[str, Any]) -> None:
        """Hand over what was not taken yet: frames leave the memory, samples stay and are noted as taken.

        Parameters
        ----------
        into
            Gets "first_sample", "rows", "first_frame", "frames", "first_contact" and "contacts". It is filled at once:
            an interrupt loses nothing.
        """
        self._core.take_records(into)

    def put_back(
        self, series: "pl.DataFrame", frames: Frames | None, contacts: "pl.DataFrame | None" = None
    ) -> None:
        """Take back what was recorded before the first in memory.

        Parameters
        ----------
        series
            The samples that were taken.
        frames
            The frames that were taken. Without them, all stay where they are, and samples are noted as taken.
        contacts
            The contacts that were taken, where they are recorded; without them, these stay where they are.

        Raises
        ------
        CheckpointError
            Where another version of drumrs wrote the samples, whose columns have other names.
        """
        if series.columns != self.columns:
            raise CheckpointError(
                "the records have columns of other names than this version of drumrs gives them; "
                "begin the run anew, without --resume"
            )
        rows = series.to_numpy(order="c")
        self._core.put_back_rows(rows, frames is None)
        if frames is not None:
            arrays: dict[str, NDArray[Any]] = {name: getattr(frames, name) for name in SHAPED}
            self._core.put_back_frames({"time": frames.times, "drum_angle": frames.drum_angles, **arrays})
        if contacts is not None:
            self._core.put_back_contacts(self._tables.arrays(contacts))

    def none(self) -> Frames:
        """Return no frames of this load in this drum."""
        shape = (0, self.count)
        vectors = np.empty((*shape, 2), np.float32)
        return self.as_frames(
            {
                "time": np.empty(0),
                "drum_angle": np.empty(0),
                "positions": vectors,
                "angles": np.empty(shape, np.float32),
                "velocities": vectors,
                "contacts": np.empty(shape, np.uint16),
            }
        )

    def as_frames(self, arrays: dict[str, NDArray[Any]]) -> Frames:
        """Return the core's arrays as frames of this load in this drum."""
        drum, (shell, baffles, walls) = self._drum, self._core.outlines()
        return Frames(
            times=arrays["time"],
            drum_angles=arrays["drum_angle"],
            **{name: arrays[name] for name in SHAPED},
            radii=self._core.radii,
            species=self.species,
            drum_radius=drum.diameter / 2.0 if drum.rim else None,
            shell=shell,
            baffles=tuple(baffles),
            walls=tuple(walls),
        )


class HasRecords:
    """The part of a simulation that shows what it has recorded."""

    _records: Records

    @property
    def series(self) -> "pl.DataFrame":
        """Polars table of the recorded quantities, one row a sample; `drumrs.quantities` has meanings and units."""
        return self._records.series()

    @property
    def frames(self) -> Frames:
        """Positions, angles, velocities and numbers of contacts of the bundles at the frames' times."""
        return self._records.frames()

    @property
    def records(self) -> Records:
        """What is behind `series` and `frames`, for whoever takes it as it comes."""
        return self._records
