"""Sweeps: many cases, each simulated once, kept in a folder, taken up again after any break.

`case` names a case, `design` turns axes and rows into cases, `store` keeps their results in a folder, in `sealed` files
that know whose they are. `worker` runs one case anywhere, `executors` says where, `scheduler` hands the cases out.
`columns` and `table` put the results side by side, `sweep_file` reads what `drumrs sweep` is given, and `sweep` is what
users see of all this; a `study_folder` keeps the cases of a study. `folder_status` tells from the folder alone how far
a sweep is, by its `plan`; `packing` puts many files into few `packs`. Nothing here knows what is made of the results.
"""

from drumrs.sweep.case import Case
from drumrs.sweep.folder_status import Status, status
from drumrs.sweep.packing import Packed, pack, unpack
from drumrs.sweep.scheduler import Failure, Outcome
from drumrs.sweep.sweep import Sweep
from drumrs.sweep.sweep_file import read_sweep
from drumrs.sweep.table import scan_folder
from drumrs.sweep.worker import run_case

__all__ = [
    "Case",
    "Failure",
    "Outcome",
    "Packed",
    "Status",
    "Sweep",
    "pack",
    "read_sweep",
    "run_case",
    "scan_folder",
    "status",
    "unpack",
]
