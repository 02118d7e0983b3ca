"""NetCDF by xarray: frames and series as labelled arrays, with units and the configuration as attributes."""

from pathlib import Path

from drumrs.exports.recorded import Recorded
from drumrs.result import to_xarray


def write(run: Recorded, path: Path) -> None:
    """Write what `Result.to_xarray` returns."""
    made = to_xarray(run.config, run.frames, run.series)
    made.attrs |= run.provenance()
    made.to_netcdf(path, engine="h5netcdf")
