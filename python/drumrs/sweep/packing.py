"""Packing: the files of finished cases become a few large ones, for file systems that count files.

Nothing is lost wherever it is broken off: a file goes only after its packed copy was read back and found equal, and as
long as it is there it comes before its copy. The same call goes on. Files go through piece by piece: packing a case
takes less memory than running it.
"""

import contextlib
import os
import secrets
import shutil
import time
import zipfile
import zlib
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from drumrs.errors import ConfigError
from drumrs.files import read_plain, replacing, require_plain, write_whole
from drumrs.progress import Task
from drumrs.sweep.case import is_id
from drumrs.sweep.columns import metadata
from drumrs.sweep.folder_status import status
from drumrs.sweep.packs import ROWS, Pack
from drumrs.sweep.sealed import PIECE, check_sealed_stream, write_sealed
from drumrs.sweep.store import RESULTS, Store

# A pack is full with so many cases or bytes.
_MOST_CASES, _MOST_BYTES = 4096, 2**32
# One that zip files can hold: equal results, equal bytes.
_TIME = (1980, 1, 1, 0, 0, 0)
_HOUR = 3600.0


@dataclass(frozen=True)
class Packed:
    """What packing has come to.

    Attributes
    ----------
    cases
        Cases that were packed.
    files
        Files that went.
    packs
        Packs that were made, two files each.
    left
        Finished cases that have files left, by id, and why.
    """

    cases: int
    files: int
    packs: int
    left: dict[str, str]


def pack(folder: str | Path, *, progress: bool = True) -> Packed:
    """Put the files of the finished cases of a sweep's folder into packs, and remove them.

    Failed cases and those under way stay as they are. Sweeps go on in a packed folder, and read what is packed.

    Parameters
    ----------
    folder
        A sweep's folder, in which nobody computes now.
    progress
        Whether to show progress, as a `drumrs.Task` does.

    Raises
    ------
    ConfigError
        Where it is not the folder of a sweep, or another process is at work on a case that has a checkpoint.
    OSError
        Where packs cannot be written; no result is lost.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> from drumrs.sweep import pack
    >>> folder = tempfile.mkdtemp()
    >>> sweep = drumrs.Sweep(drumrs.baseline(fill=0.05).replace({"run.duration": 0.05}), seeds=3)
    >>> outcome = sweep.run(folder, progress=False)
    >>> packed = pack(folder, progress=False)
    >>> packed.cases, packed.packs, sweep.table().collect().height
    (3, 1, 3)
    """
    store = Store(folder)
    store.require_sweep()
    _refuse_running(store)
    files = _loose_files(store.folder)
    # What a call that was broken off has packed, but not removed, comes first.
    again = [(made, sorted(made.ids & files.keys())) for made in store.packs]
    packed = store.packs.ids()
    waiting = sorted(case for case, endings in files.items() if "parquet" in endings and case not in packed)
    count = len(waiting) + sum(len(cases) for _, cases in again)
    left: dict[str, str] = {}
    removed = packs = 0
    with Task("packing", count, "cases", show=progress) as task:
        for made, cases in again:
            removed += _remove_packed(store, made, cases, files, left)
            task.advance(len(cases))
        _remove_halves(store.packs.folder)
        if waiting:
            store.packs.folder.mkdir(exist_ok=True)
        queue = iter(waiting)
        while (new := _write_pack(store, queue, files, left, task)) is not None:
            removed += _remove_packed(store, *new, files, left)
            packs += 1
    return Packed(len(waiting) - len(left.keys() & set(waiting)), removed, packs, left)


def unpack(folder: str | Path, case: str) -> list[Path]:
    """Put the files of a packed case back into the sweep's folder, and return them; the pack stays as it is.

    Parameters
    ----------
    folder
        A sweep's folder.
    case
        Id of the case, or the beginning of it.

    Raises
    ------
    ConfigError
        Where it is not the folder of a sweep, no packed case or more than one has such an id, or its pack is damaged.
    OSError
        Where the files cannot be written.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> from drumrs.sweep import pack, unpack
    >>> folder = tempfile.mkdtemp()
    >>> sweep = drumrs.Sweep(drumrs.baseline(fill=0.05).replace({"run.duration": 0.05}))
    >>> outcome = sweep.run(folder, progress=False)
    >>> packed = pack(folder, progress=False)
    >>> [path.name.partition(".")[2] for path in unpack(folder, sweep.cases[0].id)]
    ['toml', 'series.parquet', 'frames.parquet', 'facts.json', 'parquet']
    """
    store = Store(folder)
    store.require_sweep()
    found = sorted(name for name in store.packs.ids() if name.startswith(case))
    made = store.packs.holding(found[0]) if len(found) == 1 else None
    if made is None:
        limit = f"the id of one packed case, or its beginning: {len(found)} have such an id"
        raise ConfigError("case", case, limit)
    names = [f"{found[0]}.{ending}" for ending in RESULTS]
    contents = {name: data for name in names if (data := made.read(name)) is not None}
    for name, data in contents.items():
        write_whole(store.folder / name, data)
    return [store.folder / name for name in contents]


def _refuse_running(store: Store) -> None:
    running = status(store.folder).running
    if running:
        case, age = min(running.items(), key=lambda entry: entry[1])
        limit = "a folder in which nobody computes"
        problem = f"has a checkpoint that was written {age:.0f} s ago, of case {case}, but must be {limit}"
        hint = (
            "wait until the sweep has ended; where it was killed on another machine, until its checkpoints are "
            "some minutes old"
        )
        raise ConfigError(store.folder, limit=limit, problem=problem, hint=hint)


def _loose_files(folder: Path) -> dict[str, list[str]]:
    """Return the endings of the files of results in the folder itself, by case."""
    files: dict[str, list[str]] = defaultdict(list)
    for entry in os.scandir(folder):
        case, _, ending = entry.name.partition(".")
        if ending in RESULTS and is_id(case):
            files[case].append(ending)
    return dict(files)


def _write_pack(
    store: Store, waiting: Iterator[str], files: Mapping[str, list[str]], left: dict[str, str], task: Task
) -> tuple[Pack, list[str]] | None:
    """Write the next cases as a pack, until it is full, and return both; `None` where no case is left."""
    import polars as pl

    # Two that pack one folder at the same time must not write into each other's.
    made = Pack(store.packs.folder / f"{secrets.token_hex(8)}.parquet")
    cases: list[str] = []
    size = 0
    with replacing(made.files) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        for case in waiting:
            task.advance()
            try:
                checked = {ending: _checked(store, case, ending) for ending in files[case]}
            except (ConfigError, OSError) as error:
                left[case] = str(error)
                continue
            copies = {ending: _copy(archive, store.folder / f"{case}.{ending}") for ending in checked}
            size += sum(copy.file_size for copy in copies.values())
            changed = [ending for ending, copy in copies.items() if checked[ending] != copy.CRC]
            if changed:
                # What was copied of it belongs to no case.
                left[case] = f"{case}.{changed[0]} has changed meanwhile"
                continue
            cases.append(case)
            if len(cases) == _MOST_CASES or size >= _MOST_BYTES:
                break
    if not cases:
        made.files.unlink()
        return None
    rows = pl.read_parquet([store.folder / f"{case}.parquet" for case in cases], glob=False)
    write_sealed(made.rows, made.rows.stem, ROWS, rows, metadata(), "zstd")
    _synchronize(made.rows.parent)
    made.check_rows()
    return made, cases


def _copy(archive: zipfile.ZipFile, path: Path) -> zipfile.ZipInfo:
    """Copy a file into a zip file, piece by piece."""
    entry = zipfile.ZipInfo(path.name, _TIME)
    entry.external_attr = 0o644 << 16
    entry.file_size = path.stat().st_size
    with path.open("rb") as file, archive.open(entry, "w") as copy:
        shutil.copyfileobj(file, copy, PIECE)
    return entry


def _checked(store: Store, case: str, ending: str) -> int:
    """Return the CRC-32 of a file of results, once it is known to be whole."""
    path = store.folder / f"{case}.{ending}"
    if ending == "parquet":
        store.row_path(case)
    elif ending.endswith(".parquet"):
        require_plain(path)
        with path.open("rb") as file:
            return check_sealed_stream(path, file, case, ending.removesuffix(".parquet"))
    return zlib.crc32(read_plain(path))


def _remove_packed(
    store: Store, made: Pack, cases: Collection[str], files: Mapping[str, list[str]], left: dict[str, str]
) -> int:
    """Remove the files whose packed copies read back equal, and return their number."""
    removed = 0
    for case in cases:
        for ending in files[case]:
            path = store.folder / f"{case}.{ending}"
            try:
                is_equal = made.has_copy_of(path)
            except FileNotFoundError:
                continue
            except (ConfigError, OSError) as error:
                left[case] = str(error)
                continue
            if is_equal:
                path.unlink(missing_ok=True)
                removed += 1
            else:
                left[case] = f"{path.name} is not what is packed under this name, and comes before it"
    return removed


def _remove_halves(folder: Path) -> None:
    """Remove what a call that was killed has left; what is young may be another's, who packs as well."""
    for path in (*folder.glob("*.zip"), *folder.glob(".*.tmp")):
        with contextlib.suppress(OSError):
            if not path.with_suffix(".parquet").exists() and time.time() - path.stat().st_mtime > _HOUR:
                path.unlink()


def _synchronize(folder: Path) -> None:
    """See to it that files renamed into a folder are on the disk under their names, before others are removed."""
    if hasattr(os, "O_DIRECTORY"):
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
