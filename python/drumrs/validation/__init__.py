"""Drums that others published, simulated anew: what agrees, what differs, and what two dimensions cannot match.

Each drum is a module that says what is simulated and compared, with the text of its page beside it as Markdown:
`tracer`, `layer`, `mill`. They share how cases are set up (`cases`), what frames tell (`profile`, `toe`) and
comparisons (`check`, `results`). `Validation` runs the cases in a folder, compares, and writes a page with figures and
a table (`study`, `table`, `page`).
"""

from drumrs.validation.cases import Scale
from drumrs.validation.drum import PublishedDrum
from drumrs.validation.study import DRUMS, Validation

__all__ = ["DRUMS", "PublishedDrum", "Scale", "Validation"]
