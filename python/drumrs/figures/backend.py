"""Imports matplotlib, whatever the environment says about windows: figures of drumrs never open one.

A notebook's kernel sets MPLBACKEND for every process that it starts. In an environment without the backend named there,
matplotlib cannot even be imported.
"""

import os
import sys
from contextlib import suppress

_VARIABLE = "MPLBACKEND"

if "matplotlib" not in sys.modules:
    _wanted = os.environ.pop(_VARIABLE, None)
    try:
        import matplotlib as mpl
    finally:
        if _wanted is not None:
            os.environ[_VARIABLE] = _wanted
    # Whoever uses matplotlib later in this process gets the backend that was asked for, where there is one.
    if _wanted:
        with suppress(ValueError):
            mpl.rcParams["backend"] = _wanted
