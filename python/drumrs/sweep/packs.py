"""Packs: finished cases of a sweep in two files a few thousand cases, read as if their files were still there.

| file in `packs` | content |
|---|---|
| `<pack>.zip` | the files of its cases as they were, uncompressed |
| `<pack>.parquet` | the rows of its cases, sealed; written last: its being there means that the pack is whole |

A file of a case that stands in the sweep's folder itself comes first.
"""

import io
import struct
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from functools import cached_property, lru_cache
from pathlib import Path
from typing import BinaryIO, NamedTuple

from drumrs.errors import ConfigError
from drumrs.files import require_plain
from drumrs.folders import PACKS
from drumrs.sweep.columns import schema
from drumrs.sweep.sealed import PIECE, read_sealed

ROWS = "pack"
# What stands in a zip file before each of its files; at the end are the lengths of its name and of further words.
_LOCAL_HEADER = struct.Struct("<26xHH")


class _Member(NamedTuple):
    """Where a file stands in a zip file."""

    header: int
    size: int
    crc: int


class Pack:
    """A pack: the rows and the files of some finished cases."""

    def __init__(self, rows: Path) -> None:
        self.rows, self.files = rows, rows.with_suffix(".zip")

    @cached_property
    def ids(self) -> frozenset[str]:
        """The ids of its cases."""
        import polars as pl

        try:
            return frozenset(pl.read_parquet(self.rows, columns=["case"], glob=False)["case"])
        except (OSError, pl.exceptions.PolarsError):
            problem = "is damaged or no file of a pack"
            raise ConfigError(self.rows, hint=self._way_out(), problem=problem) from None

    def names(self) -> Iterable[str]:
        """Return the names of its files.

        Raises
        ------
        ConfigError
            Where they cannot be read.
        """
        return self._members

    def read(self, name: str) -> bytes | None:
        """Return what a file of a case holds, `None` where there is no such file.

        Raises
        ------
        ConfigError
            Where the pack is damaged.
        """
        member = self._members.get(name)
        if member is None:
            return None
        # Opened anew each time: thousands of packs are more than a process may hold open.
        try:
            with self.files.open("rb") as file:
                _seek(file, member)
                data = file.read(member.size)
        except (OSError, struct.error) as error:
            raise ConfigError(self.files, problem=f"cannot be read: {error}") from None
        if zlib.crc32(data) != member.crc:
            raise ConfigError(self.files, problem=f"is damaged at {name}")
        return data

    def has_copy_of(self, path: Path) -> bool:
        """Tell whether what is packed under the name of a file is that file, byte for byte.

        They are read piece by piece, as they may be large.

        Raises
        ------
        ConfigError
            Where the pack cannot be read.
        OSError
            Where the file cannot be read.
        """
        member = self._members.get(path.name)
        require_plain(path)
        with path.open("rb") as own:
            if member is None or path.stat().st_size != member.size:
                return False
            try:
                with self.files.open("rb") as file:
                    _seek(file, member)
                    left = member.size
                    while (piece := file.read(min(left, PIECE))) and piece == own.read(len(piece)):
                        left -= len(piece)
            except (OSError, struct.error) as error:
                raise ConfigError(self.files, problem=f"cannot be read: {error}") from None
        return left == 0

    def check_rows(self) -> Path:
        """Return the file of the rows once it has been found whole.

        Raises
        ------
        ConfigError
            Where it is damaged, another's, or of other columns.
        """
        import polars as pl

        try:
            rows = read_sealed(self.rows, self.rows.stem, ROWS)
        except ConfigError as error:
            error.hint = self._way_out()
            raise
        if pl.read_parquet_schema(rows) != schema():
            problem = "has the columns of another version of drumrs"
            raise ConfigError(
                self.rows, hint="run the sweep again, which makes its rows anew", problem=problem
            )
        return self.rows

    def _way_out(self) -> str:
        """Say how to get on without the rows: each case's own row is among its files."""
        return f"unzip {self.files} -d {self.files.parents[1]}, then remove both files of this pack"

    @cached_property
    def _members(self) -> dict[str, _Member]:
        try:
            with zipfile.ZipFile(self.files) as archive:
                return {
                    info.filename: _Member(info.header_offset, info.file_size, info.CRC)
                    for info in archive.infolist()
                }
        except (OSError, zipfile.BadZipFile) as error:
            raise ConfigError(self.files, problem=f"cannot be read: {error}") from None


def _seek(file: BinaryIO, member: _Member) -> None:
    """Go to where the content of a file begins in a zip file."""
    file.seek(member.header)
    head = file.read(_LOCAL_HEADER.size)
    file.seek(sum(_LOCAL_HEADER.unpack(head)), io.SEEK_CUR)


class Packs:
    """All packs of a sweep's folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / PACKS

    def __iter__(self) -> Iterator[Pack]:
        """Give the packs in the order of their names."""
        try:
            return iter(_listed(self.folder, self.folder.stat().st_mtime_ns))
        except OSError:
            return iter(())

    def holding(self, case: str) -> Pack | None:
        """Return the pack with a case of this id, `None` where there is none."""
        return next((pack for pack in self if case in pack.ids), None)

    def ids(self) -> set[str]:
        """Return the ids of all cases that are packed."""
        return set().union(*(pack.ids for pack in self))

    def read(self, name: str) -> tuple[Path, bytes] | None:
        """Return what a file of a packed case holds, and the file in which it stands; `None` where it is not packed.

        Raises
        ------
        ConfigError
            Where its pack is damaged.
        """
        pack = self.holding(name.partition(".")[0])
        data = None if pack is None else pack.read(name)
        return None if pack is None or data is None else (pack.files, data)


@lru_cache(maxsize=8)
def _listed(folder: Path, _changed: int) -> tuple[Pack, ...]:
    """List the packs of a folder; what is known of them is kept until the folder changes, for a worker asks often."""
    return tuple(Pack(path) for path in sorted(folder.glob("*.parquet")))
