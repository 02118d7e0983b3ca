"""`Recorded`: what a format is given of a run, and what it has to say of where that comes from."""

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from drumrs.config import Config
from drumrs.frames import Frames
from drumrs.simulation import info

if TYPE_CHECKING:
    import polars as pl


class Recorded(NamedTuple):
    """The records of a run.

    Attributes
    ----------
    config
        The configuration, seed included.
    frames
        Where the bundles are, frame by frame.
    series
        The series.
    """

    config: Config
    frames: Frames
    series: "pl.DataFrame"

    def provenance(self) -> dict[str, str]:
        """Return where the run comes from, in words by name."""
        about = info()
        return {
            "title": self.config.title,
            "source": f"drumrs {about['version']}, physics {about['physics_version']}",
            "units": "SI, angles in radians; depth 1 m",
            "digest": self.config.digest,
            "configuration": self.config.to_toml(),
        }


def write_config(run: Recorded, path: Path) -> None:
    """Write the configuration, for formats that have no room for it."""
    words = {name: word for name, word in run.provenance().items() if name != "configuration"}
    head = "".join(f"# {name}: {word}\n" for name, word in words.items())
    path.write_text(f"{head}\n{run.config.to_toml()}", encoding="utf-8", newline="\n")
