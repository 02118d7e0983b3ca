"""Units and meanings of a parquet file's columns, where pandas, PyArrow and DuckDB look for them.

A parquet file has words of its own, which polars and DuckDB read, and an Arrow schema, which has words on the table and
on each column: those PyArrow gives, and pandas takes its `DataFrame.attrs` from them. So they are written to both.
Polars writes the schema of any object that exports one in Arrow's C data interface, but has no way to put words on its
own: here they are put on it.
"""

import ctypes
import io
import json
import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import polars as pl

# The words of a file that are a table of words by column, and how each is called on a column.
_ON_COLUMNS = {"units": "unit", "meanings": "meaning"}
# Where pandas keeps and finds the attributes of a table.
_PANDAS = "PANDAS_ATTRS"
# Under which word of a parquet file its Arrow schema stands.
_SCHEMA = "ARROW:schema"


class _ArrowSchema(ctypes.Structure):
    """`struct ArrowSchema` of Arrow's C data interface."""


_ArrowSchema._fields_ = [
    ("format", ctypes.c_char_p),
    ("name", ctypes.c_char_p),
    ("metadata", ctypes.c_char_p),
    ("flags", ctypes.c_int64),
    ("n_children", ctypes.c_int64),
    ("children", ctypes.POINTER(ctypes.POINTER(_ArrowSchema))),
    ("dictionary", ctypes.POINTER(_ArrowSchema)),
    ("release", ctypes.c_void_p),
    ("private_data", ctypes.c_void_p),
]
_pointer_of = ctypes.pythonapi.PyCapsule_GetPointer
_pointer_of.restype = ctypes.POINTER(_ArrowSchema)
_pointer_of.argtypes = [ctypes.py_object, ctypes.c_char_p]


def with_schema(words: Mapping[str, str], schema: "pl.Schema") -> dict[str, str]:
    """Return the words of a file with the Arrow schema that says them, too: what polars takes as a file's metadata.

    Parameters
    ----------
    words
        What the file is to carry; "units" and "meanings", JSON by column, go to the columns as well.
    schema
        The columns of the file.
    """
    import polars as pl

    by_key = {key: json.loads(words[key]) for key in _ON_COLUMNS if key in words}
    if not by_key:
        return dict(words)
    # A file of these columns without rows has the schema as it is written to files.
    file = io.BytesIO()
    pl.DataFrame(schema=schema).write_parquet(file, arrow_schema=_WithWords(schema, by_key))
    file.seek(0)
    return {**words, _SCHEMA: pl.read_parquet_metadata(file)[_SCHEMA]}


class _WithWords:
    """A schema of polars with words on the table and on its columns."""

    def __init__(self, schema: "pl.Schema", by_key: Mapping[str, Mapping[str, str]]) -> None:
        self._schema = schema
        on_table = {key: json.dumps(told, ensure_ascii=False) for key, told in by_key.items()}
        # Polars reads them while it writes the file, so they live as long as this.
        self._on_table = _encoded({**on_table, _PANDAS: json.dumps(by_key, ensure_ascii=False)})
        self._on_columns = [
            _encoded({_ON_COLUMNS[key]: told[column] for key, told in by_key.items() if column in told})
            for column in schema
        ]

    def __arrow_c_schema__(self) -> object:
        """Export the schema."""
        capsule = self._schema.__arrow_c_schema__()
        exported = _pointer_of(capsule, b"arrow_schema").contents
        # Polars has no words of its own there, and releases none.
        exported.metadata = self._on_table
        for column, words in enumerate(self._on_columns):
            exported.children[column].contents.metadata = words
        return capsule


def _encoded(words: Mapping[str, str]) -> bytes:
    """Return words as the C data interface has them: their number, then each key and value after its length."""
    parts = [text.encode() for entry in words.items() for text in entry]
    return struct.pack("=i", len(words)) + b"".join(struct.pack("=i", len(part)) + part for part in parts)
