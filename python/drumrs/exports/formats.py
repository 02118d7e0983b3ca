"""`export`: a run written in the format of another program; the list of formats."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from drumrs.errors import ConfigError, missing_package
from drumrs.exports import gsd, lammps, netcdf, table, vtkhdf, xyz
from drumrs.exports.recorded import Recorded, write_config
from drumrs.files import replacing
from drumrs.result import Result
from drumrs.unstable import UnstableRun
from drumrs.viewer.folder import config_of, find
from drumrs.viewer.source import read_frames, read_series_beside

Writer = Callable[[Recorded, Path], None]


class Format(NamedTuple):
    """A format of files.

    Attributes
    ----------
    ending
        How names of its files end.
    programs
        What opens it.
    write
        Writes the file.
    beside
        What is written beside it, by name: what the format itself cannot hold. "{name}" is the name of the file,
        "{stem}" the same without its ending.
    """

    ending: str
    programs: str
    write: Writer
    beside: "dict[str, Writer]"


_CONFIG: dict[str, Writer] = {"{name}.toml": write_config}
FORMATS = {
    "vtkhdf": Format(
        ".vtkhdf", "ParaView, VTK, PyVista", vtkhdf.write, {"{stem}-drum.vtkhdf": vtkhdf.write_drum}
    ),
    "gsd": Format(".gsd", "OVITO, HOOMD-blue, freud", gsd.write, {}),
    "lammps": Format(".lammpstrj", "OVITO, VMD, LAMMPS", lammps.write, _CONFIG),
    "xyz": Format(".xyz", "OVITO, ASE", xyz.write, _CONFIG),
    "csv": Format(
        ".csv", "spreadsheets, R, MATLAB", table.write, {"{stem}-drum.csv": table.write_drum, **_CONFIG}
    ),
    "netcdf": Format(".nc", "xarray, MATLAB, Panoply", netcdf.write, {}),
}


def export(
    run: Result | UnstableRun, path: str | Path, to: str | None = None, *, force: bool = False
) -> list[Path]:
    """Write the frames of a run, and the drum that turns about them, in the format of another program.

    docs/how-to/export.md has what each format holds, and how it is opened. ``vtkhdf``, ``gsd``, ``netcdf`` need
    packages of the extra ``export``: ``pip install 'drumrs[export]'``.

    Parameters
    ----------
    run
        A finished run, or one that ended unstable.
    path
        File to write, whole or not at all.
    to
        ``"vtkhdf"``, ``"gsd"``, ``"lammps"``, ``"xyz"``, ``"csv"`` or ``"netcdf"``; what the name of the file ends with
        tells it unless given.
    force
        Whether to replace a file that is there.

    Returns
    -------
    list of Path
        The files written: formats without room for the configuration have it in a file beside, ``NAME.toml``.

    Raises
    ------
    ConfigError
        Where there is no such format, no frame, a package is missing, or a file is there already.
    OSError
        Where a file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import drumrs
    >>> result = drumrs.run(drumrs.baseline(fill=0.1).replace({"run.duration": 0.1}), progress=False)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path.name for path in drumrs.export(result, Path(folder, "drum.xyz"))]
    ['drum.xyz', 'drum.xyz.toml']
    """
    return write(Recorded(run.config, run.frames, run.series), Path(path), to, force=force, option="path")


def read(path: Path, wanted: Sequence[str] = ()) -> tuple[Path, Recorded]:
    """Read what can be exported of a run's folder, or of a case of a sweep, as `viewer.find` finds it.

    Returns
    -------
    tuple
        The file of the frames, and what was recorded.

    Raises
    ------
    ConfigError
        Where there are no frames, or those of several runs, or their series or configuration does not lie beside them.
    """
    found = find(path, wanted)
    config, series = config_of(found), read_series_beside(found)
    if config is None or series is None:
        problem = "has no configuration or no series beside it, but must have both"
        raise ConfigError(found, problem=problem, hint="give the folder in which drumrs wrote it")
    return found, Recorded(config, read_frames(found), series)


def write(run: Recorded, path: Path, to: str | None = None, *, force: bool, option: str) -> list[Path]:
    """Write what was recorded, as `export` does; `option` is what the user called the file."""
    kind = _format(path, to, option)
    if not len(run.frames):
        hint = "run.frame_every must be smaller than run.duration"
        raise ConfigError("the run", problem="has no frames to export", hint=hint)
    writers = {path: kind.write}
    for name, writer in kind.beside.items():
        writers[path.with_name(name.format(name=path.name, stem=path.stem))] = writer
    for file in writers:
        if file.is_dir() or (file.exists() and not force):
            hint = (
                "" if file.is_dir() else "choose another name, or replace it: --force, force=True in Python"
            )
            raise ConfigError(option, file, "a file that is not there yet", hint=hint)
    for file, writer in writers.items():
        try:
            with replacing(file) as temporary:
                writer(run, temporary)
        except ModuleNotFoundError as error:
            raise missing_package(f"the format {kind.ending}", error, "export") from None
    return list(writers)


def default_file(frames: Path, to: str) -> Path:
    """Return where the export of a file of frames goes unless told otherwise: beside it."""
    return frames.with_suffix(FORMATS[to].ending)


def _format(path: Path, to: str | None, option: str) -> Format:
    known = ", ".join(FORMATS)
    if to is not None:
        if to not in FORMATS:
            raise ConfigError("to", to, f"one of {known}")
        return FORMATS[to]
    found = [one for one in FORMATS.values() if path.name.endswith(one.ending)]
    if not found:
        endings = ", ".join(one.ending for one in FORMATS.values())
        raise ConfigError(
            option, path, f"a name that ends in one of {endings}", hint=f"or say which of {known}"
        )
    return found[0]
