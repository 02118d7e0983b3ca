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
