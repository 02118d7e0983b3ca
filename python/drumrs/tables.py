"""Tables as parquet files that are whole or not there: written at once, or piece by piece where they may be large."""

import io
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from drumrs.files import replacing, write_whole

if TYPE_CHECKING:
    import polars as pl

# Rows that are in memory together while a large table is written or read.
GROUP_ROWS = 2**18


def write_table(path: str | Path, table: "pl.DataFrame", metadata: Mapping[str, str]) -> None:
    """Write a table as parquet, whole or not at all, with `metadata` on the file."""
    buffer = io.BytesIO()
    table.write_parquet(buffer, metadata=dict(metadata))
    write_whole(path, buffer.getvalue())


def write_in_pieces(
    path: str | Path,
    table: "pl.LazyFrame",
    metadata: Mapping[str, str],
    *,
    group_rows: int,
    compression: Literal["zstd", "uncompressed"] = "zstd",
) -> None:
    """Write a table that may be larger than all memory; the bytes depend on what it holds, not on how it comes.

    Parameters
    ----------
    path
        File to write.
    table
        Rows in their order, from wherever they are.
    metadata
        Words on the file.
    group_rows
        Rows of a group of the file.
    compression
        How columns are compressed.

    Raises
    ------
    OSError
        Where there is no room, or the folder cannot be written.
    """
    with replacing(path) as temporary:
        sink(temporary, table, metadata, group_rows=group_rows, compression=compression)


def sink(
    path: Path,
    table: "pl.LazyFrame",
    metadata: Mapping[str, str],
    *,
    group_rows: int,
    compression: Literal["zstd", "uncompressed"] = "zstd",
) -> None:
    """Write a table to this very file, which may be left in pieces."""
    with _system_errors():
        table.sink_parquet(
            path, row_group_size=group_rows, metadata=dict(metadata), compression=compression, mkdir=False
        )


@contextmanager
def _system_errors() -> Iterator[None]:
    """Raise as `OSError` what polars tells of one in words."""
    from polars.exceptions import PolarsError

    try:
        yield
    except PolarsError as error:
        told = re.search(r"\(os error (\d+)\)", str(error))
        if told is None:
            raise
        number = int(told.group(1))
        raise OSError(number, os.strerror(number)) from None
