"""Reads exports as ParaView and OVITO do, and prints what they see as JSON.

Runs in an environment of its own, target/programs, which `make check-long` makes: vtk and ovito take half a gigabyte.
"""

import json
import sys


def vtkhdf(path: str, index: int) -> dict[str, object]:
    """Read a time with ParaView's reader."""
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    reader.UpdateTimeStep(times[index])
    seen = reader.GetOutputDataObject(0)
    data = seen.GetPointData()
    names = [data.GetArrayName(place) for place in range(data.GetNumberOfArrays())]
    return {
        "times": list(times),
        "points": [seen.GetPoint(place)[:2] for place in range(seen.GetNumberOfPoints())],
        "cells": [seen.GetNumberOfVerts(), seen.GetNumberOfLines(), seen.GetNumberOfPolys()],
        "last": {name: data.GetArray(name).GetTuple(seen.GetNumberOfPoints() - 1) for name in names},
    }


def particles(path: str, index: int) -> dict[str, object]:
    """Read a frame with OVITO."""
    from ovito.io import import_file

    pipeline = import_file(path)
    seen = pipeline.compute(index).particles
    told = {name: seen[name][...].tolist() for name in ("Position", "Radius", "Velocity", "Particle Type")}
    turned = seen["Orientation"][...].tolist() if "Orientation" in seen else None
    types = {kind.id: kind.name for kind in seen.particle_types.types}
    return {"frames": pipeline.source.num_frames, **told, "Orientation": turned, "types": types}


if __name__ == "__main__":
    path, index = sys.argv[1], int(sys.argv[2])
    seen = vtkhdf(path, index) if path.endswith(".vtkhdf") else particles(path, index)
    sys.stdout.write(f"\n{json.dumps(seen)}\n")
