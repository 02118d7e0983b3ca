"""Parquet files that know whose they are and notice damage.

The file's metadata hold one JSON object under the key "drumrs": format, what the file holds, whose it is, the version
of the physics, and the digest of all its bytes, itself counted as zeros. No time, no machine: equal data, equal bytes.
"""

import contextlib
import hashlib
import io
import json
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from drumrs.column_words import with_schema
from drumrs.errors import ConfigError
from drumrs.files import read_plain, replacing, write_whole
from drumrs.frames import Frames, sink_frames
from drumrs.sweep.case import physics_version

if TYPE_CHECKING:
    from collections.abc import Mapping

    import polars as pl

    from drumrs.tables import Compression

FORMAT = 3
_KEY = "drumrs"
# What the seal says of the version that wrote the file.
_VERSIONS = ("format", "physics_version")
_MAGIC = b"PAR1"
# What stands before the digest in the file.
_DIGEST = b'"sha256": "'
_BLANK = "0" * hashlib.sha256().digest_size * 2
# What comes after the footer: its length and the magic number.
_LENGTH = 8
# How much of a large file is in memory at a time [bytes].
PIECE = 2**20


def write_sealed(
    path: Path,
    owner: str,
    content: str,
    table: "pl.DataFrame",
    metadata: "Mapping[str, str] | None" = None,
    compression: "Compression" = "uncompressed",
) -> None:
    """Write a table, whole or not at all.

    Parameters
    ----------
    path
        File to write.
    owner
        Id of the case whose results they are, or name of the pack.
    content
        What the file holds: "summary", "series", "frames", "pack".
    table
        The results.
    metadata
        Further words on the file, such as units.
    compression
        How columns are compressed.
    """
    buffer = io.BytesIO()
    seal = json.dumps({**_claims(owner, content), "sha256": _BLANK})
    words = {**with_schema(metadata or {}, table.schema), _KEY: seal}
    table.write_parquet(buffer, compression=compression, metadata=words)
    data = buffer.getvalue()
    head, _, tail = data.rpartition(_BLANK.encode())
    write_whole(path, head, hashlib.sha256(data).hexdigest().encode(), tail)


def write_sealed_frames(path: Path, owner: str, frames: Frames) -> None:
    """Write the frames of a case, whole or not at all, and batch by batch: the table takes three times their memory."""
    seal = json.dumps({**_claims(owner, "frames"), "sha256": _BLANK})
    with replacing(path) as temporary:
        words = {**frames.metadata(), _KEY: seal}
        sink_frames(temporary, frames.lazy_table(), frames.count, words, "uncompressed")
        with temporary.open("rb+") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
            # The seal stands in the footer, whose length the file's last words tell.
            file.seek(-8, io.SEEK_END)
            start = file.seek(-8 - int.from_bytes(file.read(4), "little"), io.SEEK_END)
            file.seek(start + file.read().rindex(_BLANK.encode()))
            file.write(digest.encode())


def read_sealed(path: Path, owner: str, content: str) -> io.BytesIO:
    """Return the bytes of a file that is whole and its owner's.

    Raises
    ------
    ConfigError
        Where the file is missing, damaged, or holds something else; the sentence names it.
    """
    return check_sealed(path, _read(path), owner, content)


def check_sealed(path: Path, data: bytes, owner: str, content: str) -> io.BytesIO:
    """Return bytes that were read from a file once they are known to be whole and its owner's.

    Raises
    ------
    ConfigError
        Where they are damaged, or hold something else; the sentence names the file.
    """
    check_sealed_stream(path, io.BytesIO(data), owner, content)
    return io.BytesIO(data)


def check_sealed_stream(path: Path, file: BinaryIO, owner: str, content: str) -> int:
    """Check a file that is open, as `check_sealed` does, but piece by piece: it may be as large as it likes.

    Returns
    -------
    int
        Its CRC-32.
    """
    end = file.seek(0, io.SEEK_END)
    footer = _footer(file, end)
    _, mark, tail = footer.rpartition(_DIGEST)
    digest = tail[: len(_BLANK)] if mark else b""
    hashed, crc = hashlib.sha256(), 0
    file.seek(0)
    for piece in _pieces(file, end - len(tail)):
        hashed.update(piece)
        crc = zlib.crc32(piece, crc)
    # Where the digest stands, there was nothing yet when it was made.
    hashed.update(_BLANK.encode() + tail[len(digest) :])
    crc = zlib.crc32(tail, crc)
    # Before the parser sees it: some damage makes it give up in a way of its own.
    if digest and hashed.hexdigest().encode() != digest:
        raise ConfigError(path, problem="is damaged: its digest does not match")
    seal = _seal(path, _MAGIC + footer)
    if not isinstance(seal, dict):
        raise ConfigError(path, problem="was not written by drumrs")
    for name, wanted in _claims(owner, content).items():
        if seal.get(name) != wanted:
            whose = "another version of drumrs wrote it" if name in _VERSIONS else "it is another's file"
            problem = f"has {name} {seal.get(name)!r}, but must have {wanted!r}: {whose}"
            raise ConfigError(path, seal.get(name), repr(wanted), problem=problem)
    if not digest or seal.get("sha256") != digest.decode(errors="replace"):
        raise ConfigError(path, problem="is damaged: its digest does not match")
    return crc


def _footer(file: BinaryIO, end: int) -> bytes:
    """Return the last words of a file, in which the seal stands; all of it where they do not tell how long they are."""
    file.seek(max(end - _LENGTH, 0))
    length = int.from_bytes(file.read(4), "little") + _LENGTH
    file.seek(end - length if _LENGTH < length <= end else 0)
    return file.read()


def _pieces(file: BinaryIO, size: int) -> Iterator[bytes]:
    while size > 0 and (piece := file.read(min(size, PIECE))):
        size -= len(piece)
        yield piece


def _read(path: Path) -> bytes:
    try:
        # A file that is none of ours may be larger than all memory.
        with path.open("rb") if path.is_file() else contextlib.nullcontext() as file:
            if file is not None and (path.stat().st_size < len(_MAGIC) or _ending(file) != _MAGIC):
                raise ConfigError(path, problem="is damaged or no parquet file")
        return read_plain(path)
    except OSError as error:
        raise ConfigError(path, problem=f"cannot be read: {error.strerror}") from None


def _ending(file: BinaryIO) -> bytes:
    file.seek(-len(_MAGIC), io.SEEK_END)
    return file.read()


def _seal(path: Path, data: bytes) -> Any:
    """Return what the file says of itself; its last words suffice."""
    import polars as pl
    from polars.exceptions import PanicException

    try:
        pl.read_parquet_schema(io.BytesIO(data))
        return json.loads(pl.read_parquet_metadata(io.BytesIO(data)).get(_KEY, "null"))
    # Polars raises what its parser meets, on some damage a panic, which is no `Exception`.
    except (Exception, PanicException):  # noqa: BLE001 - whatever it was, the file is not one that drumrs wrote
        raise ConfigError(path, problem="is damaged or no parquet file") from None


def _claims(owner: str, content: str) -> dict[str, object]:
    return {"format": FORMAT, "content": content, "case": owner, "physics_version": physics_version()}
