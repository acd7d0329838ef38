# SPDX-License-Identifier: GPL-3.0-or-later
"""Cell fields of a BoxCase run on one fluid rank, as arrays [x, y, z] (scalars) and [x, y, z, component]."""
import re

import numpy


def output_times(run):
    """Names of the time folders that hold fields, in the order of time."""
    folders = [f.name for f in (run.folder / "fluid").iterdir() if (f / "U").is_file()]
    return sorted(folders, key=float)


def cell_field(run, time, name, fine):
    """time: a name of output_times; fine: cells of the fluid mesh in each direction."""
    data = (run.folder / "fluid" / time / name).read_bytes()
    uniform = re.search(rb"internalField\s+uniform\s+([^;]+);", data)
    if uniform:
        return numpy.full(fine, float(uniform.group(1)))
    head = re.search(rb"internalField\s+nonuniform\s+List<scalar>\s+(\d+)\s*\(", data)
    count = int(head.group(1))
    values = numpy.frombuffer(data, dtype="<f8", count=count, offset=head.end())
    return values.reshape(tuple(reversed(fine))).transpose()


def vector_field(run, time, name, fine):
    """As cell_field, of a field that is not uniform."""
    data = (run.folder / "fluid" / time / name).read_bytes()
    head = re.search(rb"internalField\s+nonuniform\s+List<vector>\s+(\d+)\s*\(", data)
    values = numpy.frombuffer(data, dtype="<f8", count=3 * int(head.group(1)), offset=head.end())
    return values.reshape((*reversed(fine), 3)).transpose(2, 1, 0, 3)


def surface_height(column, spacing):
    """Height at which a column of cell values (bottom first) last falls through 0.5, m."""
    above = numpy.flatnonzero((column[:-1] >= 0.5) & (column[1:] < 0.5))
    if len(above) == 0:
        return float("nan")
    low = above[-1]
    share = (column[low] - 0.5) / (column[low] - column[low + 1])
    return float((low + 0.5 + share) * spacing)


def sampled(run, time, shape, spacing, offset=(0, 0, 0)):
    """alpha of the cells of any mesh that hold the points offset + (i + 0.5, j + 0.5, k + 0.5) spacing, [x, y, z]."""
    from reporting.fields import Fluid
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkProbeFilter

    fluid = Fluid(run.folder)
    [mesh] = fluid.meshes(min(fluid.times, key=lambda t: abs(t - float(time))))
    points = vtkImageData()
    points.SetDimensions(*shape)
    points.SetSpacing(spacing, spacing, spacing)
    points.SetOrigin(*(o + 0.5 * spacing for o in offset))
    probe = vtkProbeFilter()
    probe.SetInputData(points)
    probe.SetSourceData(mesh)
    probe.Update()
    values = vtk_to_numpy(probe.GetOutput().GetPointData().GetArray(fluid.alpha))
    return values.reshape(tuple(reversed(shape))).transpose()
