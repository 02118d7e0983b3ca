"""Runs in the formats of other programs, one file a format, listed in `FORMATS`; and runs as films.

`recorded` is what a format is given, `particles` the bundles and the drum for formats that hold nothing but particles.
"""

from drumrs.exports.film import movie
from drumrs.exports.formats import FORMATS, default_file, export, read, write

__all__ = ["FORMATS", "default_file", "export", "movie", "read", "write"]
