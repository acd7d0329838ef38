# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run left at a time in space: the liquid's surface, the walls it wets, the edges of the fluid's domain, particles.

VTK reads and thins in a process of its own (fields.in_own_process):
python3 -m reporting.space RUN TIME TRIANGLES PARTICLES writes a pickle to standard output.
"""
import pathlib
import sys
from dataclasses import dataclass

import numpy

from reporting.fields import Fluid, answer, in_own_process, particle_arrays, series_output, upward
from reporting.run import read_gravity

WALLS = 5000  # triangles
EDGE = 30  # degrees between two faces of the boundary from which their edge is drawn


@dataclass
class Space:
    """Points are n x 3, m; triangles and lines name their corners."""

    lower: numpy.ndarray      # corners of the fluid's box, m
    upper: numpy.ndarray
    vertical: tuple           # axis against gravity, the way up on it
    surface: tuple            # points, triangles n x 3: where the liquid fraction is 0.5
    surface_triangles: int    # before thinning
    wetted: tuple             # points, triangles n x 3: the domain's boundary where it is above 0.5
    edges: tuple              # points, lines n x 2: sharp edges of the domain's boundary
    walls: tuple              # points, triangles: surfaces of the script, as far as the box and a twentieth beyond
    positions: numpy.ndarray  # of the particles, m
    radii: numpy.ndarray      # m
    speeds: numpy.ndarray     # m/s
    particles: int            # before thinning


def read(folder, time, triangles, particles):
    """The Space of a run at one of its times, with no more triangles of surface and of wetted walls each, and no more
    particles, than that. Throws RuntimeError with the reason."""
    return Space(**in_own_process("reporting.space", folder, time, triangles, particles))


def space(folder, time, most_triangles, most_particles):
    fluid = Fluid(folder)
    fluid.reader.DecomposePolyhedraOn()
    mesh, liquid = whole(fluid.meshes(time), fluid.alpha)
    boundary = outside(fluid.meshes(time, boundary=True))
    found = contour(mesh, liquid) if liquid else None
    count = found.GetNumberOfPolys() if found else 0
    # Where no surface is, one fluid fills all: walls that are all wet or all dry say nothing.
    wetted = above_half(boundary, liquid) if count and boundary.GetPointData().GetArray(liquid) else None
    positions, radii, speeds, particles = thinned(particle_arrays(folder, time), most_particles)
    bounds = numpy.array(mesh.GetBounds())
    lower, upper = bounds[0::2], bounds[1::2]
    walls = decimated(within(series_output(folder, "surfaces", time), lower, upper), WALLS)
    return {"lower": lower, "upper": upper, "walls": arrays(walls), "vertical": upward(read_gravity(folder)),
            "surface": arrays(decimated(found, most_triangles)), "surface_triangles": count,
            "wetted": arrays(decimated(wetted, most_triangles)), "edges": arrays(sharp_edges(boundary), 2),
            "positions": positions, "radii": radii, "speeds": speeds, "particles": particles}


def whole(meshes, alpha):
    """The blocks as one mesh, and the name of its liquid fraction at points, or None. Polyhedra have to be decomposed."""
    from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkCellDataToPointData

    if not meshes:
        raise RuntimeError("there is no mesh")
    together = vtkAppendFilter()
    for mesh in meshes:
        mesh.GetPointData().Initialize()  # of the reader, by rank: different on both sides of a face between them
        together.AddInputData(mesh)
    together.Update()
    mesh = output(vtkCellDataToPointData(), with_common_points(together.GetOutput()))
    return mesh, alpha if alpha and mesh.GetPointData().GetArray(alpha) else None


def with_common_points(mesh):
    """The mesh with one point where ranks meet: else the surface had gaps there. (VTK 9.1 does it for polygons only.)"""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray

    places = numpy.ascontiguousarray(vtk_to_numpy(mesh.GetPoints().GetData())) + 0.0  # no -0
    rows = places.view(f"V{places.itemsize * 3}").ravel()
    _, first, names = numpy.unique(rows, return_index=True, return_inverse=True)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(places[first], deep=True))
    cells = vtkCellArray()
    corners = names[vtk_to_numpy(mesh.GetCells().GetConnectivityArray())].astype(numpy.int64)
    cells.SetData(mesh.GetCells().GetOffsetsArray(), numpy_to_vtkIdTypeArray(corners, deep=True))
    mesh.SetCells(mesh.GetCellTypesArray(), cells)
    mesh.SetPoints(points)
    return mesh


def output(filter_, data):
    filter_.SetInputData(data)
    filter_.Update()
    return filter_.GetOutput()


def contour(mesh, liquid):
    from vtkmodules.vtkCommonDataModel import vtkDataObject
    from vtkmodules.vtkFiltersCore import vtkContourFilter

    half = vtkContourFilter()
    half.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, liquid)
    half.SetValue(0, 0.5)
    half.ComputeNormalsOff()
    return output(half, mesh)


def outside(patches):
    from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCleanPolyData

    together = vtkAppendPolyData()
    for patch in patches:
        together.AddInputData(patch)
    together.Update()
    return output(vtkCleanPolyData(), together.GetOutput())


def above_half(boundary, liquid):
    """The part of the boundary where the liquid fraction is above 0.5."""
    from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkTriangleFilter

    triangles = output(vtkTriangleFilter(), boundary)
    triangles.GetPointData().SetActiveScalars(liquid)
    clip = vtkClipPolyData()
    clip.SetValue(0.5)
    return output(clip, triangles)


def within(surface, lower, upper):
    """Of a surface what is in that box and a twentieth of its longest side around it: a floor may be far larger."""
    from vtkmodules.vtkCommonDataModel import vtkPlane
    from vtkmodules.vtkFiltersCore import vtkClipPolyData

    beyond = (upper - lower).max() / 20
    for corner, inwards in ((lower - beyond, 1), (upper + beyond, -1)):
        for axis in range(3):
            if surface is None or surface.GetNumberOfPolys() == 0:
                return None
            plane = vtkPlane()
            plane.SetOrigin(*corner)
            plane.SetNormal(*(inwards * numpy.eye(3)[axis]))
            clip = vtkClipPolyData()
            clip.SetClipFunction(plane)
            surface = output(clip, surface)
    return surface


def sharp_edges(boundary):
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges

    edges = vtkFeatureEdges()
    edges.SetFeatureAngle(EDGE)
    edges.NonManifoldEdgesOff()
    edges.ColoringOff()
    return output(edges, boundary)


def decimated(surface, most):
    """The same surface of no more than so many triangles, as few as its shape allows where it is flat."""
    from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkQuadricDecimation, vtkTriangleFilter

    if surface is None or surface.GetNumberOfPolys() == 0:
        return None
    surface = output(vtkTriangleFilter(), output(vtkCleanPolyData(), surface))
    if surface.GetNumberOfPolys() <= most:
        return surface
    fewer = vtkQuadricDecimation()
    fewer.SetTargetReduction(1 - most / surface.GetNumberOfPolys())
    return output(fewer, surface)


def arrays(data, corners=3):
    """Points and cells, all with so many corners, of VTK's data; empty arrays for None."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    cells = None if data is None else data.GetLines() if corners == 2 else data.GetPolys()
    if cells is None or cells.GetNumberOfCells() == 0:
        return numpy.zeros((0, 3), numpy.float32), numpy.zeros((0, corners), numpy.int64)
    used, names = numpy.unique(vtk_to_numpy(cells.GetConnectivityArray()), return_inverse=True)
    points = vtk_to_numpy(data.GetPoints().GetData())[used]
    return points.astype(numpy.float32), names.reshape(-1, corners)


def thinned(found, most):
    """Positions, radii, speeds and how many there were. Each id has its lot: the same particles at every time."""
    if not found:
        return numpy.zeros((0, 3)), numpy.zeros(0), numpy.zeros(0), 0
    count = len(found["position"])
    kept = slice(None)
    if count > most:
        ids = numpy.asarray(found.get("id", numpy.arange(count)), int)
        lots = numpy.random.default_rng(0).random(ids.max() + 1)
        kept = numpy.argsort(lots[ids])[:most]
    return (found["position"][kept].astype(numpy.float64), found["radius"][kept],
            numpy.linalg.norm(found["velocity"][kept], axis=1), count)


def main():
    folder, time, triangles, particles = sys.argv[1:]
    answer(lambda: space(pathlib.Path(folder), float(time), int(triangles), int(particles)))


if __name__ == "__main__":
    main()
