"""Units and meanings of a parquet file's columns, where pandas, PyArrow and DuckDB look for them.

A parquet file has words of its own, under any keys, and an Arrow schema, which has words on the table and on each column.
Polars reads the former, as DuckDB does; PyArrow gives the latter, and pandas takes its `DataFrame.attrs` from there. So
they are written to both. Polars takes such a schema from any object that can export it in Arrow's C data interface, but
has no way to put words on its own: here they are put on it.
"""

import ctypes
import json
import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    import polars as pl

# The words of a file that are a table of words by column, and how each is called on a column.
_ON_COLUMNS = {"units": "unit", "meanings": "meaning"}
# Where pandas keeps and finds the attributes of a table.
_PANDAS = "PANDAS_ATTRS"


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


class WithWords:
    """A schema of polars with the words of a file on the table, and those by column on its columns."""

    def __init__(self, schema: "pl.Schema", words: Mapping[str, str]) -> None:
        self._schema = schema
        by_column = {name: json.loads(words[key]) for key, name in _ON_COLUMNS.items() if key in words}
        attributes = {key: json.loads(words[key]) for key in _ON_COLUMNS if key in words}
        table = {**{key: words[key] for key in attributes}, _PANDAS: json.dumps(attributes)}
        # Polars reads them while it writes the file, so they live as long as this.
        self._on_table = _encoded(table) if attributes else None
        self._on_columns = [
            _encoded({word: told[name] for word, told in by_column.items() if name in told}) for name in schema
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
