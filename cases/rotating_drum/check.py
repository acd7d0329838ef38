#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wall carries what is in the drum, at rest and turning: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

  torque of the wall on beads and water + torque of their weight = rate of their angular momentum
      about the axis, means over the time at rest and over the turning; exact
The wall's: contacts (LIGGGHTS's mesh/surface/stress), pressure and shear (OpenFOAM's forces). The weight's: -g sum(m x).
"""
import pathlib
import re
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, beads, run_from_command_line  # noqa: E402
from reporting.fields import Fluid  # noqa: E402

COUNT, DENSITY, WATER, AIR, GRAVITY = 1000, 2500.0, 1000.0, 1.2, 9.81
DEM_STEP = 5e-5  # s
AT_REST, TURNING = (0.1, 0.4), (1.0, 3.0)  # s


def prisms(mesh):
    """Centres (x, y) and volumes of the cells, which are all prisms along z."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    corners = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 8)
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)[corners]
    base = numpy.take_along_axis(points, numpy.argsort(points[:, :, 2], axis=1)[:, :4, None], axis=1)[:, :, :2]
    out = base - base.mean(axis=1)[:, None]
    order = numpy.argsort(numpy.arctan2(out[..., 1], out[..., 0]), axis=1)
    one = numpy.take_along_axis(base, order[..., None], axis=1)
    other = numpy.roll(one, -1, axis=1)
    cross = one[..., 0] * other[..., 1] - other[..., 0] * one[..., 1]
    area = cross.sum(axis=1) / 2
    centre = ((one + other) * cross[..., None]).sum(axis=1) / (6 * area[:, None])
    return centre, area * numpy.ptp(points[:, :, 2], axis=1)


def contents(run, fluid, time):
    """Of water and air, and of the beads: torque of the weight, N m, and angular momentum, kg m2/s, both about the axis."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    found = numpy.zeros((2, 2))
    for mesh in fluid.meshes(time):
        centre, volume = prisms(mesh)
        alpha, eps, U = (vtk_to_numpy(mesh.GetCellData().GetArray(name)) for name in (fluid.alpha, "voidFraction", "U"))
        mass = (alpha * WATER + (1 - alpha) * AIR) * eps * volume
        found[0] += -GRAVITY * (mass * centre[:, 0]).sum(), (mass * (centre[:, 0] * U[:, 1] - centre[:, 1] * U[:, 0])).sum()
    state = beads(run, time)
    x, v, mass = state["position"], state["velocity"], DENSITY * 4 / 3 * numpy.pi * state["radius"]**3
    spin = 0.4 * mass * state["radius"]**2 * state["spin"][:, 2]
    found[1] = -GRAVITY * (mass * x[:, 0]).sum(), (mass * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0]) + spin).sum()
    return found


def contacts(run):
    """Rows of time, s, and torque of the beads on the wall, N m, the mean over the 20 ms before."""
    logs = [*sorted((run.folder / "earlier").glob("particles_*.log")), run.folder / "particles.log"]
    rows = re.findall(r"^ *(\d+) +\d+ +(\S+) +\S+ *$", "\n".join(log.read_text() for log in logs), re.MULTILINE)
    table = {int(step): float(torque) for step, torque in reversed(rows)}  # where a run goes on, LIGGGHTS begins with 0
    return numpy.array([(DEM_STEP * step, torque) for step, torque in sorted(table.items()) if step % 400 == 0])


def fluid_on_wall(run):
    """Rows of time, s, torque of pressure and of shear on the wall, N m."""
    files = sorted((run.folder / "fluid" / "postProcessing" / "drum").glob("*/moment.dat"))
    text = "\n".join(file.read_text() for file in files)
    rows = [line.translate(str.maketrans("()", "  ")).split() for line in text.splitlines() if line and line[0] != "#"]
    return numpy.array(rows, dtype=float)[:, [0, 6, 9]]


def over(table, span):
    """Mean of the columns over the time span (begin, end], s; each row is the mean of the time since the one before."""
    steps = numpy.diff(table[:, 0], prepend=0)
    inside = (table[:, 0] > span[0] + 1e-9) & (table[:, 0] < span[1] + 1e-9)
    return (steps[inside, None] * table[inside, 1:]).sum(axis=0) / steps[inside].sum()


def balance(run, fluid, span):
    """Means over the time span: torques by name, N m."""
    times = [time for time in fluid.times if span[0] - 1e-9 < time < span[1] + 1e-9]
    states = numpy.array([contents(run, fluid, time) for time in times])
    weight = numpy.diff(times) @ (states[1:, :, 0] + states[:-1, :, 0]) / 2 / (times[-1] - times[0])
    stored = (states[-1, :, 1] - states[0, :, 1]).sum() / (times[-1] - times[0])
    pressure, shear = over(fluid_on_wall(run), span)
    return {"contacts": -over(contacts(run), span)[0], "pressure": -pressure, "shear": -shear,
            "weight of water": weight[0], "weight of beads": weight[1], "stored": -stored}


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-10)
    if (run.last_time or 0) < TURNING[1] - 1e-9:
        return checks.exit_code()  # a run that is meant to end early
    fluid = Fluid(run.folder)
    for name in ("voidFraction", "U"):
        fluid.reader.SetCellArrayStatus(name, 1)
    rest, turning = (balance(run, fluid, span) for span in (AT_REST, TURNING))
    for name in rest:
        checks.note(f"torque at rest, turning: {name}", f"{1e3 * rest[name]:9.4f} {1e3 * turning[name]:9.4f} mN m")
    wall = turning["contacts"] + turning["pressure"] + turning["shear"]
    checks.near("torque of the wall, of the weight, turning", wall,
                -(turning["weight of water"] + turning["weight of beads"] + turning["stored"]), 0.02, "N m")
    checks.at_most("sum of all torques at rest", abs(sum(rest.values())), 0.02 * abs(wall), "N m")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
