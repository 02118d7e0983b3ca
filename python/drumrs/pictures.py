"""Pictures and pages are made from results and never take them along: one that fails is a warning that names it."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from drumrs.errors import PictureWarning


@dataclass
class Attempt:
    """An attempt to make a picture.

    Attributes
    ----------
    failure
        Why there is none, in one line; empty where nothing failed.
    """

    failure: str = ""


@contextmanager
def attempt(picture: str | Path) -> Iterator[Attempt]:
    """Turn whatever goes wrong within into a `PictureWarning`; to be entered once the numbers are saved.

    Parameters
    ----------
    picture
        File or name of the picture.

    Examples
    --------
    >>> import warnings
    >>> from drumrs.pictures import attempt
    >>> with warnings.catch_warnings(record=True) as told:
    ...     warnings.simplefilter("always")
    ...     with attempt("drum.png") as made:
    ...         raise ValueError("no font")
    >>> str(told[0].message), made.failure
    ('drum.png could not be made (ValueError: no font); the numbers are complete', 'ValueError: no font')
    """
    made = Attempt()
    try:
        yield made
    except Exception as error:  # noqa: BLE001 - libraries, fonts, styles, disks: none is worth a finished run
        made.failure = f"{type(error).__name__}: {' '.join(str(error).split()):.300}".rstrip(": ")
        warnings.warn(
            f"{picture} could not be made ({made.failure}); the numbers are complete",
            PictureWarning,
            stacklevel=3,
        )
