"""Runs in the formats of other programs: one file a format, listed in `FORMATS`.

`recorded` is what a format is given, `beads` the drum for formats that hold nothing but particles.
"""

from drumrs.exports.export import FORMATS, default_file, export, read, write

__all__ = ["FORMATS", "default_file", "export", "read", "write"]
