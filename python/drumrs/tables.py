"""Tables as parquet files that are whole or not there: written at once, or batch by batch where they may be large."""

import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from drumrs.column_words import with_schema
from drumrs.files import replacing

if TYPE_CHECKING:
    import polars as pl

Compression = Literal["zstd", "uncompressed"]
# Rows that are in memory together while a large table is written or read.
ROW_GROUP_SIZE = 2**18


def write_table(
    path: str | Path,
    table: "pl.DataFrame",
    metadata: Mapping[str, str],
    compression: Compression = "zstd",
    level: int | None = None,
) -> None:
    """Write a table as parquet, whole or not at all, with `metadata` on the file; `level` as in `sink_table`."""
    words = with_schema(metadata, table.schema)
    with replacing(path) as temporary, _system_errors(temporary):
        table.write_parquet(temporary, metadata=words, compression=compression, compression_level=level)


def sink_table(
    path: Path,
    table: "pl.LazyFrame",
    metadata: Mapping[str, str],
    *,
    row_group_size: int,
    compression: Compression = "zstd",
    level: int | None = None,
) -> None:
    """Write a table that may be larger than all memory; the bytes depend on what it holds, not on how it comes.

    Parameters
    ----------
    path
        File to write; an error leaves it in pieces.
    table
        Rows in their order, from wherever they are.
    metadata
        Words on the file.
    row_group_size
        Rows of a group of the file.
    compression
        How columns are compressed.
    level
        How hard; that of polars unless given. Of digits that are chance, more makes files hardly smaller.

    Raises
    ------
    OSError
        Where there is no room, or the folder cannot be written.
    """
    with _system_errors(path):
        table.sink_parquet(
            path,
            row_group_size=row_group_size,
            metadata=with_schema(metadata, table.collect_schema()),
            compression=compression,
            compression_level=level,
            mkdir=False,
        )


@contextmanager
def _system_errors(path: Path) -> Iterator[None]:
    """Raise as `OSError` what polars tells of one in words, while it writes a file."""
    from polars.exceptions import PolarsError

    try:
        yield
    except PolarsError as error:
        told = re.search(r"\(os error (\d+)\)", str(error))
        if told is None:
            # Of a disk that is full at the footer, polars tells nothing of use; the next bytes do.
            with path.open("ab") as file:
                file.write(bytes(2**16))
            raise
        number = int(told.group(1))
        raise OSError(number, os.strerror(number)) from None
