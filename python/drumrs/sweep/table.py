"""The table of a sweep: one row a finished case, sorted, whatever order they were finished in; and that of a folder."""

import io
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.analysis import Mean
from drumrs.column_words import with_schema
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

    loose = [case for case in cases if store.has_row(case)]
    others = {case.id for case in cases}.difference(case.id for case in loose)
    try:
        rows = [_scan([store.row_path(case.id) for case in loose])]
    except ConfigError as error:
        error.hint = "run the sweep again to compute it anew"
        raise
    for pack in store.packs:
        if wanted := others & pack.ids:
            rows.append(_scan([pack.check_rows()]).filter(_is_one_of(wanted)))
            # Two that packed one folder at the same time may have packed the same case.
            others -= wanted
    return pl.concat(rows).sort(sort_keys(), maintain_order=True)


def scan_folder(folder: str | Path) -> "pl.LazyFrame":
    """Scan the rows of all finished cases in a sweep's folder, of whichever sweep they are: for very many cases.

    Parameters
    ----------
    folder
        A sweep's folder, packed or not.

    Returns
    -------
    polars.LazyFrame
        The columns of `Sweep.table`, in no particular order. What is collected of it is all that memory has to hold.

    Raises
    ------
    ConfigError
        Where there is no such folder, or a file is damaged or of another version; the sentence names it.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> from drumrs.sweep import scan_folder
    >>> folder = tempfile.mkdtemp()
    >>> sweep = drumrs.Sweep(drumrs.baseline(fill=0.05).replace({"run.duration": 0.05}), seeds=2)
    >>> outcome = sweep.run(folder, progress=False)
    >>> scan_folder(folder).select("seed", "load.fill").sort("seed").collect().rows()
    [(0, 0.05), (1, 0.05)]
    """
    import polars as pl

    store = Store(folder)
    store.require_sweep()
    loose = store.loose_ids()
    packs = [pack for pack in store.packs if not loose or not pack.ids <= loose]
    packed = _scan([pack.check_rows() for pack in packs])
    if loose:
        packed = packed.filter(~_is_one_of(loose))
    # As above; hashes of a million ids take less memory than the ids.
    if not packed.select(pl.col("case").hash().n_unique() == pl.len()).collect(engine="streaming").item():
        packed = packed.unique(subset="case")
    return pl.concat([packed, _scan([store.row_path(case) for case in sorted(loose)])])


def _scan(paths: list[Path]) -> "pl.LazyFrame":
    import polars as pl

    return pl.scan_parquet(paths, glob=False) if paths else pl.LazyFrame(schema=schema())


def _is_one_of(ids: Collection[str]) -> "pl.Expr":
    import polars as pl

    return pl.col("case").is_in(pl.Series(sorted(ids)).implode())


def write(cases: Sequence[Case], store: Store) -> Path:
    """Write the table beside the cases' files and return its path: equal results, equal bytes.

    Raises
    ------
    ConfigError
        Where there is a table that drumrs did not write.
    OSError
        Where it cannot be written; the cases' files are untouched.
    """
    import polars as pl

    store.require_own()
    buffer = io.BytesIO()
    words = with_schema(metadata(), pl.Schema(schema()))
    scan(cases, store).collect().write_parquet(buffer, compression="uncompressed", metadata=words)
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

    rows = [found for case in cases if (found := store.facts(case.id))]
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
