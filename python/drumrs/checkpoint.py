"""The checkpoint file: a line with the format's version, the configuration, the core's bytes, a digest of it all."""

import hashlib
import json
from pathlib import Path

from drumrs.config import Config
from drumrs.errors import CheckpointError
from drumrs.files import read_plain, write_whole

_NAME = b"drumrs checkpoint "
_VERSION = b"1"
_DIGEST_SIZE = hashlib.sha256().digest_size
# The core's own bytes, as src/io/checkpoint.rs lays them out: magic and format, digest, and the rest in postcard.
_CORE_HEAD = 12
_CORE_BODY = _CORE_HEAD + _DIGEST_SIZE


def write_checkpoint(path: str | Path, config: Config, core: bytes | memoryview) -> None:
    """Write a checkpoint that is whole or not there.

    Parameters
    ----------
    path
        File to write.
    config
        The simulation's configuration; the core's bytes hold only what the core reads of it.
    core
        What the core's `checkpoint` returned.
    """
    head = json.dumps(config.model_dump(mode="json", exclude_none=True)).encode()
    before = _NAME + _VERSION + b"\n" + head + b"\n"
    digest = hashlib.sha256(before)
    digest.update(core)
    # The core's bytes may be large: they are not copied together with the rest.
    write_whole(path, before, core, digest.digest())


def read_checkpoint(path: str | Path) -> tuple[Config, bytes]:
    """Read a checkpoint back.

    Raises
    ------
    CheckpointError
        Where the file cannot be read, is no checkpoint, of another version, truncated or damaged.
    """
    try:
        data = read_plain(Path(path))
    except OSError as error:
        raise CheckpointError(f"it cannot be read: {error.strerror}", str(path)) from None
    body, digest = data[:-_DIGEST_SIZE], data[-_DIGEST_SIZE:]
    line, _, rest = body.partition(b"\n")
    if not line.startswith(_NAME):
        raise CheckpointError("it is not a checkpoint of drumrs", str(path))
    version = line.removeprefix(_NAME)
    if version != _VERSION:
        found = version.decode(errors="replace")[:20]
        raise CheckpointError(f"it is of version {found!r}, but must be of {_VERSION.decode()!r}", str(path))
    if hashlib.sha256(body).digest() != digest:
        raise CheckpointError("it is truncated or damaged: its digest does not match", str(path))
    head, _, core = rest.partition(b"\n")
    try:
        return Config.model_validate(json.loads(head)), core
    except (ValueError, RecursionError):
        # A digest that matches is not yet one that drumrs made.
        raise CheckpointError("it holds no valid configuration", str(path)) from None


def with_config(core: bytes | memoryview, config: str) -> bytes:
    """Return the core's bytes with another configuration: what comes of them goes on from the same state under it.

    Parameters
    ----------
    core
        What the core's `checkpoint` returned.
    config
        The configuration as the core reads it.
    """
    data = memoryview(core)
    _, version_end = _read_varint(data, _CORE_BODY)
    size, text = _read_varint(data, version_end)
    said = config.encode()
    body = b"".join((data[_CORE_BODY:version_end], _varint(len(said)), said, data[text + size :]))
    return b"".join((data[:_CORE_HEAD], hashlib.sha256(body).digest(), body))


def _read_varint(data: memoryview, at: int) -> tuple[int, int]:
    """Read a whole number of postcard, seven bits a byte, the lowest first; return it and where it ends."""
    value = shift = 0
    while data[at] & 0x80:
        value |= (data[at] & 0x7F) << shift
        at, shift = at + 1, shift + 7
    return value | data[at] << shift, at + 1


def _varint(value: int) -> bytes:
    digits = bytearray()
    while value >= 0x80:  # noqa: PLR2004 - a byte's flag that another one follows
        digits.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*digits, value])
