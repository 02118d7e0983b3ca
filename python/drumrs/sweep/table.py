"""The table of a sweep: one row a finished case, sorted, whatever order they were finished in."""

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.analysis import Mean
from drumrs.errors import ConfigError
from drumrs.files import write_whole
from drumrs.sweep.case import Case
from drumrs.sweep.columns import metadata, schema, sort_keys
from drumrs.sweep.store import TABLE, Store

if TYPE_CHECKING:
    from collections.abc import Callable

    import polars as pl

    from drumrs.result import Result


def scan(cases: Sequence[Case], store: Store) -> "pl.LazyFrame":
    """Scan the rows of the cases that are finished.

    Raises
    ------
    ConfigError
        Where a file is damaged or another's; it is named.
    """
    import polars as pl

    try:
        found = [path for case in cases if (path := store.summary_path(case)) is not None]
    except ConfigError as error:
        error.hint = "run the sweep again to compute it anew"
        raise
    if not found:
        return pl.LazyFrame(schema=schema())
    return pl.scan_parquet(found, glob=False).sort(sort_keys(), maintain_order=True)


def write(cases: Sequence[Case], store: Store) -> Path:
    """Write the table beside the cases' files and return its path: equal results, equal bytes.

    Raises
    ------
    ConfigError
        Where there is a table that drumrs did not write.
    OSError
        Where it cannot be written; the cases' files are untouched.
    """
    store.require_own()
    buffer = io.BytesIO()
    scan(cases, store).collect().write_parquet(buffer, compression="uncompressed", metadata=metadata())
    path = store.folder / TABLE
    write_whole(path, buffer.getvalue())
    return path


def measured(
    cases: Sequence[Case],
    store: Store,
    measure: "Callable[[Result], Mapping[str, Mean | float | str | None]]",
) -> "pl.DataFrame":
    """Return the table with what a function measures of each finished case; of a mean, its error is a column, too.

    Raises
    ------
    ConfigError
        Where a file is damaged or another's, or the function refuses a case.
    """
    import polars as pl

    table = scan(cases, store).collect()
    finished = set(table["case"])
    rows: list[dict[str, Any]] = []
    for case in cases:
        if case.id in finished:
            rows.append({"case": case.id})
            for name, found in measure(store.result(case)).items():
                if isinstance(found, Mean):
                    rows[-1] |= {name: found.value, f"{name}_error": found.error}
                else:
                    rows[-1][name] = found
    words = {name for row in rows for name, value in row.items() if isinstance(value, str)}
    names = {name: pl.String if name in words else pl.Float64 for row in rows for name in row}
    # A number that is none is null, as everywhere in tables; what was there by that name gives way.
    columns = pl.DataFrame(rows, {"case": pl.String, **names}, orient="row")
    own = table.drop(set(names) - {"case"}, strict=False)
    return own.join(columns.fill_nan(None), on="case", how="left", maintain_order="left")


def facts(cases: Sequence[Case], store: Store) -> "pl.DataFrame":
    """Return time taken and machine of the finished cases: what differs from run to run."""
    import polars as pl

    rows = [found for case in cases if (found := store.facts(case))]
    wanted = {
        "case": pl.String,
        "wall_time": pl.Float64,
        "particle_steps_per_second": pl.Float64,
        "machine": pl.String,
    }
    told = [{name: _of_kind(row.get(name), kind) for name, kind in wanted.items()} for row in rows]
    return pl.DataFrame(told, schema=wanted)


def _of_kind(value: Any, kind: Any) -> Any:
    """Return a value that a column can hold; null in place of what somebody else wrote."""
    import polars as pl

    return value if isinstance(value, str if kind == pl.String else float) else None
