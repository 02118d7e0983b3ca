"""`RunFolder`: the folder of a run: records and checkpoints while it is under way, its results at the end."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from drumrs.config import Config
from drumrs.contact_records import write_contact_tables
from drumrs.errors import UnstableError
from drumrs.files import remove_temporaries, write_whole
from drumrs.folders import claim
from drumrs.frames import Frames, FramesFile, thinned
from drumrs.output import claim_folder, clear_folder, complete, draw, save_unstable, write_phases
from drumrs.parts import PART_SIZE, Parts
from drumrs.pictures import attempt
from drumrs.result import Summary, write_tables
from drumrs.simulation import Simulation
from drumrs.unstable import UnstableRun

if TYPE_CHECKING:
    import polars as pl

_CHECKPOINT = "checkpoint.bin"


class RunFolder:
    """The folder of a run.

    Parameters
    ----------
    path
        The folder, which exists by the time that something is written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._parts = Parts(path)

    def begin(self, config: Config) -> None:
        """Make the folder that of a new run, which has recorded nothing yet.

        Raises
        ------
        OSError
            Where it cannot be written.
        """
        clear_folder(self.path)
        claim_folder(self.path, config)
        write_whole(self.path / "config.toml", config.to_toml().encode())

    def load(self, threads: int) -> Simulation:
        """Return the simulation of the last checkpoint; its frames stay in the folder.

        Raises
        ------
        CheckpointError
            Where there is none, or it cannot be used.
        """
        return Simulation.load(self.path / _CHECKPOINT, threads, with_records=False)

    def restore(self, simulation: Simulation) -> None:
        """Give a simulation of `load` its series, and drop what was recorded after its checkpoint, or half written."""
        remove_temporaries(self.path)
        self._parts.restore(simulation.records)

    def flush(self, simulation: Simulation) -> None:
        """Write what was recorded since, where that has grown to a part."""
        if simulation.records.size >= PART_SIZE:
            self._parts.append(simulation.records)

    def save(self, simulation: Simulation) -> None:
        """Write what was recorded since, then a checkpoint."""
        self._parts.append(simulation.records)
        simulation.save(self.path / _CHECKPOINT)

    def conclude(self, simulation: Simulation) -> tuple[Summary, list[Path]]:
        """Write what `drumrs.save` writes; return the summary and the files written."""
        summary, series = simulation.summary(), simulation.series
        written = self._write_tables(simulation, series)
        file = FramesFile.of(self.path / "frames.parquet")
        written.append(complete(self.path, summary))
        self._parts.remove()
        with attempt(f"pictures in {self.path}"):
            written += draw(self.path, simulation.config, summary, series, _pictured(file, simulation))
        return summary, written

    def conclude_unstable(self, simulation: Simulation, error: UnstableError) -> None:
        """Write what `save_unstable` writes."""
        series = simulation.series
        self._write_tables(simulation, series)
        frames = _shown(FramesFile.of(self.path / "frames.parquet"))
        save_unstable(UnstableRun.of(simulation, error, series, frames), self.path)
        self._parts.remove()

    def _write_tables(self, simulation: Simulation, series: "pl.DataFrame") -> list[Path]:
        self._parts.append(simulation.records)
        path = self.path / "frames.parquet"
        # A run that went on beyond its duration is that of another configuration now.
        claim(self.path, "run", simulation.config.title, simulation.config.digest)
        written = write_tables(self.path, simulation.config, series)
        written += write_phases(self.path, simulation.config, series)
        self._parts.merge_frames(path, simulation.records)
        tables = simulation.records.contact_tables(with_contacts=False)
        listed = [self.path / "contacts.parquet"] if simulation.records.lists_contacts else []
        for contacts in listed:
            self._parts.merge_contacts(contacts, simulation.records)
        return [*written, path, *listed, *write_contact_tables(self.path, tables)]


def _shown(file: FramesFile) -> Frames:
    """Read as many frames as a player shows."""
    from drumrs.viewer.recording import MOST_PLACES

    return file.read(thinned(len(file), file.count, MOST_PLACES))


def _pictured(file: FramesFile, simulation: Simulation) -> Frames:
    """Read the frames of the snapshots with the ones beside them."""
    start, end = simulation.config.run.averaging_window
    times = file.times()
    nearest = np.array(
        [int(np.abs(times - time).argmin()) for time in (0.0, start, end)] if len(times) else []
    )
    beside = np.unique([nearest - 1, nearest, nearest + 1]).astype(int)
    return file.read(beside[(beside >= 0) & (beside < len(times))])
