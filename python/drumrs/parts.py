"""`Parts`: the records of a run under way, in files that are added as records come; each is whole or not there.

They lie in the folder "records" of the run's folder, named by the number of their first sample, frame or contact,
counted from the start of the run. What a checkpoint knows to be taken, it finds there after any break; what is beyond,
it drops and records again. What lies before the first part is in the tables of a run that was finished and goes on.
"""

import contextlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.contact_records import CONTACTS_LEVEL, file_words
from drumrs.errors import CheckpointError
from drumrs.files import remove_temporaries, replacing
from drumrs.frames import FramesFile, sink_frames
from drumrs.records import Records
from drumrs.tables import ROW_GROUP_SIZE, sink_table, write_table

if TYPE_CHECKING:
    import polars as pl

# So much in memory is written to a part, whose table takes three times as much while it is made [bytes].
PART_SIZE = 16 * 2**20
_FOLDER = "records"


class Parts:
    """The records of a run under way, in its folder.

    Parameters
    ----------
    folder
        The run's folder.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        # Taken, and not written yet: an interrupt or a full disk must not lose it.
        self._held: dict[str, Any] = {}

    def append(self, records: Records) -> None:
        """Write everything that a simulation holds and that was not taken yet.

        Raises
        ------
        OSError
            Where there is no room; what could not be written is kept, and written first the next time.
        """
        if self._held:
            self._write(records)
        records.take(self._held)
        self._write(records)

    def restore(self, records: Records) -> None:
        """Drop what a simulation that was loaded does not know, and give it its samples back.

        Raises
        ------
        CheckpointError
            Where records that it knows to be taken are not there.
        """
        taken = {
            "series": records.taken_samples,
            "frames": records.taken_frames,
            "contacts": records.taken_contacts,
        }
        for kind, count in taken.items():
            for first, path in self._parts(kind):
                if first >= count:
                    path.unlink()
        self._table("frames", taken["frames"], records.count)
        self._table("contacts", taken["contacts"])
        if taken["series"]:
            records.put_back(self._series(taken["series"]), None)

    def reload(self, records: Records) -> None:
        """Give a simulation that was loaded everything that was taken of it, if it is all there."""
        with contextlib.suppress(CheckpointError):
            series = self._series(records.taken_samples)
            frames = FramesFile(
                self._table("frames", records.taken_frames, records.count), records.none().scene()
            )
            contacts = self._table("contacts", records.taken_contacts) if records.lists_contacts else None
            records.put_back(series, frames.read(), None if contacts is None else contacts.collect())

    def merge_frames(self, path: Path, records: Records) -> None:
        """Write all frames taken to one file: as `Frames.save` would if they were in memory."""
        table = self._table("frames", records.taken_frames, records.count)
        with replacing(path) as temporary:
            sink_frames(temporary, table, records.count, records.none().metadata())

    def merge_contacts(self, path: Path, records: Records) -> None:
        """Write all contacts to one file: those taken, those still open, and what was too small to be listed."""
        import polars as pl

        taken, last = self._table("contacts", records.taken_contacts), records.last_contacts()
        tables = [taken, last.lazy()] if records.taken_contacts else [last.lazy()]
        words = file_words("contacts", records.contact_tables(with_contacts=False)["dissipated"])
        with replacing(path) as temporary:
            table = pl.concat(tables)
            sink_table(temporary, table, words, row_group_size=ROW_GROUP_SIZE, level=CONTACTS_LEVEL)

    def remove(self) -> None:
        """Remove all parts, and what a kill left of one."""
        remove_temporaries(self._folder / _FOLDER)
        for pattern in ("series-*.parquet", "frames-*.parquet", "contacts-*.parquet"):
            # The first ones first: where a kill leaves the others, what lies before them is in the run's tables.
            for path in sorted((self._folder / _FOLDER).glob(pattern)):
                path.unlink()
        with contextlib.suppress(OSError):
            (self._folder / _FOLDER).rmdir()

    def _write(self, records: Records) -> None:
        import polars as pl

        (self._folder / _FOLDER).mkdir(exist_ok=True)
        held = self._held
        if len(held["rows"]):
            table = pl.DataFrame(held["rows"], schema=records.columns, orient="row")
            write_table(self._name("series", held["first_sample"]), table, {})
        frames, first = records.as_frames(held["frames"]), held["first_frame"]
        some = max(1, PART_SIZE // records.sizes["run.frame_every"])
        for start in range(0, len(frames), some):
            part = frames.picked(slice(start, start + some))
            part.save(self._name("frames", first + start), first + start)
        if records.lists_contacts and len(held["contacts"]["opened"]):
            table = records.as_contacts(held["contacts"])
            # It is read and written once more: to compress it would take longer than all else.
            write_table(self._name("contacts", held["first_contact"]), table, {}, "uncompressed")
        held.clear()

    def _name(self, kind: str, first: int) -> Path:
        return self._folder / _FOLDER / f"{kind}-{first:015d}.parquet"

    def _parts(self, kind: str) -> list[tuple[int, Path]]:
        """Return the parts by the number of their first sample, frame or contact, in order."""
        paths = (self._folder / _FOLDER).glob(f"{kind}-*.parquet")
        return sorted((int(path.stem.removeprefix(f"{kind}-")), path) for path in paths)

    def _table(self, kind: str, count: int, rows: int = 1) -> "pl.LazyFrame":
        """Return the first `count` samples, frames or contacts, of so many rows each."""
        import polars as pl

        parts = [(first, path) for first, path in self._parts(kind) if first < count]
        reached = parts[0][0] if parts else count
        try:
            tables = [self._finished(kind, reached, rows)] if reached else []
            for first, path in parts:
                if first != reached:
                    raise self._missing(kind, reached)
                tables.append(pl.scan_parquet(path))
                reached += tables[-1].select(pl.len()).collect().item() // rows
        except (OSError, pl.exceptions.PolarsError):
            raise self._missing(kind, reached) from None
        if reached != count:
            raise self._missing(kind, reached)
        return pl.concat(tables) if tables else pl.LazyFrame()

    def _series(self, count: int) -> "pl.DataFrame":
        import polars as pl

        try:
            return self._table("series", count).collect()
        except pl.exceptions.PolarsError:
            raise self._missing("series", 0) from None

    def _finished(self, kind: str, count: int, rows: int) -> "pl.LazyFrame":
        """Return the first samples, frames or contacts of the run's table."""
        import polars as pl

        table = pl.scan_parquet(self._folder / f"{kind}.parquet")
        if table.select(pl.len()).collect().item() < count * rows:
            raise self._missing(kind, 0)
        return table.head(count * rows)

    def _missing(self, kind: str, reached: int) -> CheckpointError:
        reason = f"{str(self._folder / _FOLDER)!r} lacks the {kind} recorded after the first {reached}"
        return CheckpointError(reason, str(self._folder), "begin the run anew, without --resume")
