"""Drums that others published, simulated anew: what agrees, what differs, and what two dimensions cannot match.

Each drum is a module that says what was published, what is simulated and how numbers are read: `tracer`. `Validation`
runs their cases in a folder, compares, and writes a page with figures and a table.
"""

from drumrs.validation.drum import PublishedDrum
from drumrs.validation.setup import Scale
from drumrs.validation.study import DRUMS, Validation

__all__ = ["DRUMS", "PublishedDrum", "Scale", "Validation"]
