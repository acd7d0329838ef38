# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields of a run on the plane through its middle, read with VTK.

Files of a run that was cut off can crash VTK's readers, so that `read` does the work in a process of its own:
python3 -m reporting.fields RUN [TIME] writes a pickle to standard output.
"""
import math
import os
import pathlib
import pickle
import subprocess
import sys
import xml.etree.ElementTree
from dataclasses import dataclass

import numpy

from reporting.run import read_gravity

RECONSTRUCTED, DECOMPOSED = 1, 0  # VTK's words for the two kinds of OpenFOAM case


@dataclass
class Section:
    """What the plane shows. Points are (horizontal, vertical), m; vertical is against gravity."""

    lower: numpy.ndarray      # corners of the fluid's box in the plane, m
    upper: numpy.ndarray
    normal: str               # axis across the plane, "y"
    position: float           # of the plane on that axis, m
    polygons: list            # one n x 2 array per cut cell
    liquid: numpy.ndarray     # liquid fraction of each polygon, -
    surface: list             # 2 x 2 arrays: where the liquid fraction is 0.5
    centres: numpy.ndarray    # of the particles within one diameter of the plane, m
    radii: numpy.ndarray      # m
    speeds: numpy.ndarray     # m/s


def read(folder, time=None):
    """The times with fields, or the Section at one of them. Throws RuntimeError with the reason."""
    found = in_own_process("reporting.fields", folder, *([] if time is None else [time]))
    return found if time is None else Section(**found)


def in_own_process(module, folder, *arguments):
    """What the module's main pickles for that run; numbers follow: a time, s, and what else the module asks for. Throws
    RuntimeError with the reason."""
    command = [sys.executable, "-m", module, str(folder), *map(repr, arguments)]
    here = pathlib.Path(__file__).resolve().parent.parent
    done = subprocess.run(command, env={**os.environ, "PYTHONPATH": str(here)}, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        lines = done.stderr.decode(errors="replace").strip().splitlines()
        reason = lines[-1] if done.returncode == 1 and lines else f"VTK crashed ({done.returncode})"
        raise RuntimeError(f"the fields{f' at {arguments[0]:g} s' if arguments else ''} cannot be read: {reason}")
    return pickle.loads(done.stdout)


def answer(question):
    """The other end: pickles question(), or ends with the reason in one line."""
    try:
        found = question()
    except ImportError as error:
        sys.exit(f"VTK's Python modules are not installed (Debian: python3-vtk9): {error}")
    except RuntimeError as error:
        sys.exit(str(error))
    pickle.dump(found, sys.stdout.buffer)


class Fluid:
    """The OpenFOAM case of a run, serial or decomposed."""

    def __init__(self, folder):
        from vtkmodules.vtkIOParallel import vtkPOpenFOAMReader
        from vtkmodules.vtkParallelCore import vtkDummyController

        case = folder / "fluid"
        # Without a controller this reader crashes on decomposed cases.
        self.controller = vtkDummyController()
        vtkDummyController.SetGlobalController(self.controller)
        self.reader = vtkPOpenFOAMReader()
        self.reader.SetController(self.controller)
        self.reader.SetFileName(str(case / "system" / "controlDict"))
        decomposed = (case / "processor0").is_dir()
        self.reader.SetCaseType(DECOMPOSED if decomposed else RECONSTRUCTED)
        self.reader.UpdateInformation()
        times = self.reader.GetTimeValues()
        self.times = [times.GetValue(i) for i in range(times.GetNumberOfValues())] if times else []
        names = [self.reader.GetCellArrayName(i) for i in range(self.reader.GetNumberOfCellArrays())]
        self.alpha = next((name for name in names if name.startswith("alpha.")), None)
        for name in names:
            self.reader.SetCellArrayStatus(name, int(name == self.alpha))

    def meshes(self, time, boundary=False):
        """The blocks of the mesh with the liquid fraction, at one of self.times; or its patches, without those between
        ranks."""
        for i in range(self.reader.GetNumberOfPatchArrays()):
            name = self.reader.GetPatchArrayName(i)
            self.reader.SetPatchArrayStatus(name, int((name == "internalMesh") != boundary))
        self.reader.UpdateTimeStep(time)
        self.reader.Update()
        return [mesh for mesh in leaves(self.reader.GetOutputDataObject(0)) if mesh.GetNumberOfCells() > 0]


def leaves(data):
    if data.IsA("vtkMultiBlockDataSet"):
        return [leaf for i in range(data.GetNumberOfBlocks()) if data.GetBlock(i) for leaf in leaves(data.GetBlock(i))]
    return [data]


def section(folder, time):
    """The Section of a run at one of its times."""
    fluid = Fluid(folder)
    meshes = fluid.meshes(time)
    if not meshes:
        raise RuntimeError("there is no mesh")
    boxes = numpy.array([mesh.GetBounds() for mesh in meshes])
    lower, upper = boxes[:, 0::2].min(axis=0), boxes[:, 1::2].max(axis=0)
    vertical, _ = upward(read_gravity(folder))
    across = [axis for axis in range(3) if axis != vertical]
    horizontal = max(across, key=lambda axis: upper[axis] - lower[axis])
    normal = next(axis for axis in across if axis != horizontal)
    axes, middle = [horizontal, vertical], 0.5 * (lower + upper)

    # Slightly off the middle: a plane that lies in faces of the mesh would cut no cell.
    origin = middle.copy()
    origin[normal] += 1e-4 * (upper - lower)[normal]
    polygons, liquid, surface = cut(meshes, fluid.alpha, origin, normal, axes)
    positions, radii, speeds = particles(folder, time)
    near = numpy.abs(positions[:, normal] - middle[normal]) <= 2 * radii
    return Section(lower[axes], upper[axes], "xyz"[normal], middle[normal], polygons, liquid, surface,
                   positions[near][:, axes], radii[near], speeds[near])


def upward(gravity):
    """The axis along which gravity (m/s2) pulls most, and the way up on it, 1 or -1; z without gravity."""
    if not numpy.any(gravity):
        return 2, 1
    axis = int(numpy.argmax(numpy.abs(gravity)))
    return axis, -int(numpy.sign(gravity[axis]))


def cut(meshes, alpha, origin, normal, axes):
    """Polygons, their liquid fraction, and the lines where it is 0.5."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPlane
    from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkCutter

    plane = vtkPlane()
    plane.SetOrigin(*origin)
    plane.SetNormal(*numpy.eye(3)[normal])
    polygons, liquid, surface = [], [numpy.zeros(0)], []
    for mesh in meshes:
        cutter = vtkCutter()
        cutter.SetCutFunction(plane)
        cutter.SetInputData(mesh)
        cutter.GenerateTrianglesOff()
        cutter.Update()
        flat = cutter.GetOutput()
        if flat.GetNumberOfPolys() == 0:
            continue
        values = flat.GetCellData().GetArray(alpha)
        if not values:
            raise RuntimeError(f"there is no {alpha}")
        polygons += cells(flat.GetPolys(), flat.GetPoints(), axes)
        liquid.append(vtk_to_numpy(values))
        contour = vtkContourFilter()
        contour.SetInputData(flat)
        contour.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, alpha)
        contour.SetValue(0, 0.5)
        contour.Update()
        lines = contour.GetOutput()
        if lines.GetNumberOfLines() > 0:
            surface += cells(lines.GetLines(), lines.GetPoints(), axes)
    return polygons, numpy.concatenate(liquid), surface


def cells(array, points, axes):
    """The corners of each cell of a vtkCellArray, in two of the three axes."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    corners = vtk_to_numpy(points.GetData())[:, axes]
    connectivity = vtk_to_numpy(array.GetConnectivityArray())
    offsets = vtk_to_numpy(array.GetOffsetsArray())
    return [corners[connectivity[a:b]] for a, b in zip(offsets[:-1], offsets[1:])]


def series_output(folder, name, time):
    """VTK's data of a series of a run, "particles" or "surfaces", at that time; None if there is no such output or no
    point in it."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPPolyDataReader

    index = folder / name / f"{name}.pvd"
    if not index.is_file():
        return None
    files = {float(e.get("timestep")): e.get("file") for e in xml.etree.ElementTree.parse(index).iter("DataSet")}
    nearest = min(files, key=lambda t: abs(t - time), default=None)
    if nearest is None or not math.isclose(nearest, time, rel_tol=1e-6, abs_tol=1e-9):
        return None
    path = index.parent / files[nearest]
    if not path.is_file():
        return None
    reader = vtkXMLPPolyDataReader() if path.suffix == ".pvtp" else vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput() if reader.GetOutput().GetNumberOfPoints() > 0 else None


def particle_arrays(folder, time):
    """Arrays by name, "position" among them, of the particles' output at that time, rows sorted by the particles' id if
    they have one; none if there is no such output or no particle in it."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    data = series_output(folder, "particles", time)
    if not data:
        return {}
    values = data.GetPointData()
    arrays = {values.GetArrayName(i): vtk_to_numpy(values.GetArray(i)) for i in range(values.GetNumberOfArrays())}
    arrays["position"] = vtk_to_numpy(data.GetPoints().GetData())
    order = numpy.argsort(arrays["id"]) if "id" in arrays else slice(None)
    return {name: array[order] for name, array in arrays.items()}


def particles(folder, time):
    """Positions, radii and speeds of the series' output at that time; empty arrays if there is none."""
    arrays = particle_arrays(folder, time)
    if not arrays:
        return numpy.zeros((0, 3)), numpy.zeros(0), numpy.zeros(0)
    return arrays["position"], arrays["radius"], numpy.linalg.norm(arrays["velocity"], axis=1)


def main():
    folder = pathlib.Path(sys.argv[1])
    answer(lambda: vars(section(folder, float(sys.argv[2]))) if len(sys.argv) > 2 else Fluid(folder).times)


if __name__ == "__main__":
    main()
