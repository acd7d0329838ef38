#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wave that was asked for arrives: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

  height     0.015 m over water of 0.1 m: mean of the crests in the outputs while they are between x = 0.4 and 1.1 m
  speed      sqrt(g (h + H))    of a solitary wave (Boussinesq), from the first of these to the last
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line  # noqa: E402
from reporting.fields import Fluid  # noqa: E402

DEPTH, HEIGHT, GRAVITY = 0.1, 0.015, 9.81  # m, m, m/s2
CELL = (0.01, 0.004)  # of the fine mesh along x and z, m


def crests(run):
    """Time, place and height over the water at rest of the highest place of the surface, for each output."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkCellCenters

    fluid = Fluid(run.folder)
    for time in fluid.times:
        heights = 0
        for mesh in fluid.meshes(time):
            centres = vtkCellCenters()
            centres.SetInputData(mesh)
            centres.Update()
            columns = (vtk_to_numpy(centres.GetOutput().GetPoints().GetData())[:, 0] / CELL[0]).astype(int)
            heights = heights + CELL[1] * numpy.bincount(columns, vtk_to_numpy(mesh.GetCellData().GetArray(fluid.alpha)), 240)
        yield time, (heights.argmax() + 0.5) * CELL[0], heights.max() - DEPTH


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-9)
    if (run.last_time or 0) < 1.6:
        return checks.exit_code()  # a run that is meant to end early
    found = list(crests(run))
    before = [crest for crest in found if 0.4 < crest[1] < 1.1]
    height = float(numpy.mean([crest[2] for crest in before])) if before else None
    checks.near("height of the wave before the gravel", height, HEIGHT, 0.05, "m")
    if len(before) > 1:
        speed = (before[-1][1] - before[0][1]) / (before[-1][0] - before[0][0])
        checks.note("its speed", f"{speed:.3f} m/s, solitary wave {math.sqrt(GRAVITY * (DEPTH + HEIGHT)):.3f} m/s")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
