#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Height of the wave over the Froude number of the beads' front: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

RUN holds the runs light, medium and heavy, or is one run, whose books alone are checked.

  A   highest place of the surface in any output, over the water at rest
  Fr  speed of the front over sqrt(g h): mean place of the 12 beads that are furthest, a line through its outputs from 10 to 50 mm
  A/h over Fr of the three differ by 10 % from their mean at most: what the beads weigh does not matter
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, beads, run_from_command_line  # noqa: E402
from reporting.fields import Fluid  # noqa: E402
from reporting.run import NoRun, Run  # noqa: E402

DEPTH, GRAVITY, CELL = 0.08, 9.81, 0.005  # m, m/s2, m


def level(fluid, time):
    """Highest, of the columns of cells over the channel, m."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkCellCenters

    heights = numpy.zeros(220)
    for mesh in fluid.meshes(time):
        centres = vtkCellCenters()
        centres.SetInputData(mesh)
        centres.Update()
        x = vtk_to_numpy(centres.GetOutput().GetPoints().GetData())[:, 0]
        liquid = vtk_to_numpy(mesh.GetCellData().GetArray(fluid.alpha))
        heights += CELL * numpy.bincount((x[x > 0] / CELL).astype(int), liquid[x > 0], len(heights))
    return heights.max()


def wave(run):
    """Fr and A/h."""
    fluid = Fluid(run.folder)
    fronts = numpy.array([(time, numpy.sort(beads(run, time)["position"][:, 0])[-12:].mean()) for time in fluid.times])
    early = fronts[(fronts[:, 1] > 0.01) & (fronts[:, 1] < 0.05)]
    speed = numpy.polyfit(early[:, 0], early[:, 1], 1)[0]
    return speed / math.sqrt(GRAVITY * DEPTH), max(level(fluid, time) for time in fluid.times) / DEPTH - 1


def main():
    folder, checks = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "run", Checks()
    three = (folder / "light").is_dir()
    try:
        runs = [Run(folder / name) for name in ("light", "medium", "heavy")] if three else [run_from_command_line(here)]
    except NoRun as error:
        print(f"check: {error}", file=sys.stderr)
        return 2
    ratios = []
    for run in runs:
        checks.equal(f"{run.folder.name}: status", run.status, "completed")
        checks.equal("beads lost", run.number("particles.lost"), 0)
        checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-13)
        checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-12)
        if (run.last_time or 0) < 0.4:
            continue  # a run that is meant to end early
        froude, height = wave(run)
        ratios.append(height / froude)
        checks.note("wave over depth, Froude number of the front", f"{height:.3f}, {froude:.3f}: ratio {height / froude:.3f}")
    for run, ratio in zip(runs, ratios if three else []):
        checks.near(f"{run.folder.name}: ratio, against the mean of all", ratio, float(numpy.mean(ratios)), 0.1)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
