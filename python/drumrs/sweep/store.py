"""`Store`: the folder of a sweep, a few files a case, each whole or not there.

| file | content |
|---|---|
| `<id>.toml` | the configuration |
| `<id>.series.parquet` | the series |
| `<id>.frames.parquet` | the frames, where the case wants them |
| `<id>.contacts.parquet`, … | what the case's `run.record` asks of contacts |
| `<id>.facts.json` | time taken and machine: what differs from run to run |
| `<id>.parquet` | one row of parameters and summary, written last: its being there means that the case is finished |
| `<id>.error.json` | why the case failed |
| `<id>.checkpoint.bin` | how far a case is that takes long; gone when it is finished |
| `<id>.runner.json` | which process works on it meanwhile; gone when that has ended: `runner` |
| `plan.parquet` | the cases of the last sweep here, finished or not: `plan` |
| `drumrs-sweep.json` | the version of this format |
| `packs` | finished cases that were packed: `packs` |
"""

import contextlib
import json
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.analysis import statistics
from drumrs.contact_records import COLUMNS, file_words
from drumrs.errors import ConfigError, format_value
from drumrs.files import NO_ROOM, parse_object, read_object, write_whole
from drumrs.folders import marker, require_own
from drumrs.frames import Frames
from drumrs.registry import known, metadata
from drumrs.result import Result, Summary
from drumrs.sweep.case import Case, is_id
from drumrs.sweep.columns import TIMINGS, row, schema
from drumrs.sweep.packs import Packs
from drumrs.sweep.plan import PLAN
from drumrs.sweep.runner import ENDING as RUNNER
from drumrs.sweep.sealed import FORMAT, check_sealed, read_sealed, write_sealed, write_sealed_frames

if TYPE_CHECKING:
    import io
    from collections.abc import Mapping

    import polars as pl

MARK = marker("sweep")
TABLE = "table.parquet"
# Endings of the files of a finished case, in the order in which they are written.
RESULTS = (
    *("toml", "series.parquet", "frames.parquet"),
    *(f"{kind}.parquet" for kind in COLUMNS),
    *("facts.json", "parquet"),
)
_ENDINGS = (*RESULTS, "error.json", "checkpoint.bin", RUNNER)
_HOUR = 3600.0


class Store:
    """The results of cases in a folder."""

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)
        self.packs = Packs(self.folder)

    def open(self, *, tidy: bool = True) -> None:
        """Make the folder where there is none, and mark it.

        Parameters
        ----------
        tidy
            Whether to look for what killed runs were writing, which lists the whole folder.

        Raises
        ------
        ConfigError
            Where it cannot be written, or is not one of a sweep that this version of drumrs knows.
        """
        self.check_format()
        self.require_own()
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            if read_object(self.folder / MARK) != (mark := {"format": FORMAT}):
                write_whole(self.folder / MARK, f"{json.dumps(mark)}\n".encode())
        except OSError as error:
            if error.errno in NO_ROOM:
                raise
            limit = f"a folder that can be written: {error.strerror}"
            raise ConfigError("folder", self.folder, limit) from None
        if tidy:
            self._remove_leftovers()

    def check_format(self) -> None:
        """Refuse a folder that a newer version of drumrs made; one that is not there yet is fine."""
        path = self.folder / MARK
        try:
            if not path.exists():
                return
        except OSError as error:
            limit = f"a folder that can be read: {error.strerror}"
            raise ConfigError("folder", self.folder, limit) from None
        mark = read_object(path)
        if mark is None or "format" not in mark:
            raise ConfigError(path, problem=f"is damaged, but must name the format of the folder, {FORMAT}")
        found = mark["format"]
        if not isinstance(found, int) or found > FORMAT:
            limit = f"of format {FORMAT} at most: a newer drumrs made it"
            problem = f"is of format {format_value(found)}, but must be {limit}"
            raise ConfigError(self.folder, found, limit, problem=problem, bound=FORMAT)

    def require_sweep(self) -> None:
        """Refuse what is not the folder of a sweep that this version of drumrs knows.

        Raises
        ------
        ConfigError
            Where there is no such folder, or it is of something else.
        """
        self.check_format()
        if not (self.folder / MARK).is_file():
            limit = f"the folder of a sweep, with a file {MARK} in it"
            runs = self.folder / "runs"
            hint = f"did you mean {str(runs)!r}?" if (runs / MARK).is_file() else ""
            raise ConfigError("folder", self.folder, limit, hint=hint)

    def loose_ids(self, ending: str = "parquet") -> set[str]:
        """Return the ids of the cases that have a file with this ending in the folder itself, not in a pack."""
        names = (path.name.partition(".") for path in self.folder.glob(f"*.{ending}"))
        return {case for case, _, rest in names if rest == ending and is_id(case)}

    def ids(self) -> set[str]:
        """Return the ids of all finished cases in the folder, those of other sweeps included."""
        return self.loose_ids() | self.packs.ids()

    def require_own(self) -> None:
        """Refuse a folder of something else, or one with a table that drumrs did not write."""
        require_own(self.folder, "sweep", [TABLE, PLAN])

    def is_settled(self, case: Case) -> bool:
        """Tell whether a case has results or an error, without looking into them."""
        loose = any(self._path(case, ending).exists() for ending in ("parquet", "error.json"))
        return loose or self.packs.holding(case.id) is not None

    def require_names(self, case: Case) -> None:
        """Refuse a folder in which something that no write can replace has the name of a case's file.

        Raises
        ------
        ConfigError
            Where there is such a thing; the sentence names it.
        """
        for ending in _ENDINGS:
            path = self._path(case, ending)
            if path.is_dir() and not path.is_symlink():
                raise ConfigError(path, problem="is a folder, but must be a file of results, or not there")

    def fault(self, case: Case) -> str | None:
        """Say what keeps the results of a case from being whole; `None` where the case is finished.

        A case that has not been finished has no record of completion, and an empty fault.
        """
        if not self.has_row(case) and self.packs.holding(case.id) is None:
            return ""
        try:
            self._read_row(case)
            for content in ("series", *(["frames"] if case.wants_frames else []), *case.contact_tables):
                self._read(case, content)
        except ConfigError as error:
            return str(error)
        return None

    def write(self, case: Case, result: Result, facts: "Mapping[str, Any]") -> None:
        """Keep the results of a case; the record of completion comes last.

        Parameters
        ----------
        case
            Whose results they are.
        result
            Summary, series and frames.
        facts
            What differs from run to run, beside the summary's timings.

        Raises
        ------
        OSError
            Where the folder is full or cannot be written.
        """
        write_whole(self._path(case, "toml"), case.config.to_toml().encode())
        write_sealed(
            self._parquet(case, "series"),
            case.id,
            "series",
            result.series,
            metadata(known(result.series.columns)),
        )
        if case.wants_frames:
            write_sealed_frames(self._parquet(case, "frames"), case.id, result.frames)
        tables = result.contact_tables()
        for kind in case.contact_tables:
            words = file_words(kind, tables["dissipated"])
            write_sealed(self._parquet(case, kind), case.id, kind, tables[kind], words)
        timings = {name: getattr(result.summary, name) for name in TIMINGS}
        self._write_json(case, "facts", {"case": case.id, **timings, **facts})
        self._write_row(case, result.summary, result.series)
        for ending in ("error.json", "checkpoint.bin", RUNNER):
            self._path(case, ending).unlink(missing_ok=True)

    def write_config(self, case: Case) -> None:
        """Write the file of a case that has none, in the folder itself or packed."""
        path = self._path(case, "toml")
        if not path.exists() and self.packs.holding(case.id) is None:
            write_whole(path, case.config.to_toml().encode())

    def checkpoint(self, case: Case) -> Path:
        """Return where a case keeps its checkpoint."""
        return self._path(case, "checkpoint.bin")

    def runner(self, case: Case) -> Path:
        """Return where it says who works on a case."""
        return self._path(case, RUNNER)

    def renew(self, case: Case) -> bool:
        """Make the row of a finished case again where an older version wrote it with other columns.

        Everything that the row tells beyond the summary comes from the series, so nothing is simulated.

        Returns
        -------
        bool
            Whether the results are whole now.
        """
        try:
            self._write_row(case, self._summary(case), self.series(case))
        except (ConfigError, KeyError):
            return False
        return self.fault(case) is None

    def write_error(self, case: Case, error: Exception) -> None:
        """Keep why a case failed, beside its configuration."""
        write_whole(self._path(case, "toml"), case.config.to_toml().encode())
        told = {"case": case.id, "error": type(error).__name__, "message": str(error)}
        self._write_json(case, "error", {**told, "config": case.config.model_dump(mode="json")})
        self.checkpoint(case).unlink(missing_ok=True)

    def error(self, case: Case) -> dict[str, Any] | None:
        """Return what `write_error` kept, `None` where the case has not failed."""
        return read_object(self._path(case, "error.json"))

    def has_row(self, case: Case) -> bool:
        """Tell whether the row of a finished case stands in the folder itself, not in a pack."""
        return self._path(case, "parquet").exists()

    def row_path(self, case: str) -> Path:
        """Return the file of a finished case's row, which is not packed, once it has been found whole.

        Raises
        ------
        ConfigError
            Where the file is damaged, another's or of other columns.
        """
        path = self.folder / f"{case}.parquet"
        _check_columns(path, read_sealed(path, case, "summary"))
        return path

    def series(self, case: Case) -> "pl.DataFrame":
        """Return the series of a finished case."""
        import polars as pl

        return pl.read_parquet(self._read(case, "series"))

    def frames(self, case: Case) -> Frames:
        """Return the frames of a finished case."""
        return Frames.load(self._read(case, "frames"))

    def contact_table(self, case: Case, kind: str) -> "pl.DataFrame":
        """Return a table of what a finished case has recorded of contacts, such as "wall_profile"."""
        import polars as pl

        return pl.read_parquet(self._read(case, kind))

    def result(self, case: Case) -> Result:
        """Return a finished case as its run left it, but for timings; without frames where it keeps none."""
        import polars as pl

        tables: dict[str, Any] = {}
        for kind in case.contact_tables:
            tables[kind] = self.contact_table(case, kind)
            tables["dissipated"] = json.loads(pl.read_parquet_metadata(self._read(case, kind))["dissipated"])
        return Result(
            config=case.config,
            summary=self._summary(case),
            series=self.series(case),
            frames=self.frames(case) if case.wants_frames else Frames.none(),
            **tables,
        )

    def facts(self, case: str) -> dict[str, Any]:
        """Return time taken and machine of a case, by its id."""
        path = self.folder / f"{case}.facts.json"
        if not path.exists() and (packed := self.packs.read(path.name)) is not None:
            return parse_object(packed[1]) or {}
        return read_object(path) or {}

    def _read(self, case: Case, content: str) -> "io.BytesIO":
        path = self._parquet(case, content)
        if not path.exists() and (packed := self.packs.read(path.name)) is not None:
            return check_sealed(*packed, case.id, content)
        return read_sealed(path, case.id, content)

    def _summary(self, case: Case) -> Summary:
        import polars as pl

        row = pl.read_parquet(self._read(case, "summary")).row(0, named=True)
        return Summary.from_mapping({**dict.fromkeys(TIMINGS), **row})

    def _write_row(self, case: Case, summary: Summary, series: "pl.DataFrame") -> None:
        found = statistics(series, case.config.run.averaging_window, case.load_mass)
        write_sealed(self._parquet(case, "summary"), case.id, "summary", row(case, summary, found))

    def _read_row(self, case: Case) -> None:
        """Refuse a row that is damaged, another's or of other columns."""
        _check_columns(self._parquet(case, "summary"), self._read(case, "summary"))

    def _parquet(self, case: Case, content: str) -> Path:
        return self._path(case, "parquet" if content == "summary" else f"{content}.parquet")

    def _path(self, case: Case, ending: str) -> Path:
        return self.folder / f"{case.id}.{ending}"

    def _write_json(self, case: Case, name: str, content: dict[str, Any]) -> None:
        write_whole(self._path(case, f"{name}.json"), f"{json.dumps(content, indent=2)}\n".encode())

    def _remove_leftovers(self) -> None:
        """Remove what a killed run was writing; a young file may be in another run's hands."""
        for path in self.folder.glob(".*.tmp"):
            with contextlib.suppress(OSError):
                if time.time() - path.stat().st_mtime > _HOUR:
                    path.unlink()


def _check_columns(path: Path, row: "io.BytesIO") -> None:
    import polars as pl

    if pl.read_parquet_schema(row) != schema():
        raise ConfigError(path, problem="has the columns of another version of drumrs")
