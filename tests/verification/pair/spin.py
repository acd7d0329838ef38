#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A sphere that spins in a fluid at rest, and one in a shear flow, through the real pair.

In the fluid at rest the spin decays as exp(-60 mu t/(rho_p d^2)). In u_x = gamma z the fluid turns the sphere with half
its curl, gamma/2 about y; there the torque is stiff, 48 spin times in a window and DEM step.
"""
import math
import sys

from box_case import BoxCase, Cyclic, Inlet, Particle, command_line, particle_states, scratch
from record import Record

DIAMETER, DENSITY, FLUID = 1e-3, 2500, 1000


def spin_time(viscosity):
    return DENSITY * DIAMETER ** 2 / (60 * viscosity)


def box(name, height, viscosity, end_time, window, **options):
    case = BoxCase(scratch(name), upper=(height, height, height), fine=(4, 4, 10), bulk=(2, 2, 5), end_time=end_time,
                   window=window, liquid=(FLUID, viscosity / FLUID), gravity=(0, 0, 0), forces=["torque"], **options)
    for name in ("x-", "x+", "y-", "y+"):
        case.sides[name] = Cyclic()
    return case


def decay(demvof, record):
    tau, spin = spin_time(0.1), (0, 300, -100)
    case = box("spin_decay", 0.02, 0.1, end_time=2.5 * tau, window=tau / 4, dem_step=tau / 400)
    case.particles = [Particle((0.009, 0.0105, 0.011), DIAMETER, DENSITY, spin=spin)]
    run = case.run(demvof)
    left = particle_states(run.folder)["spin"][0] / math.exp(-2.5)
    record.at_most("spin decay: relative error after 2.5 spin times", max(abs(left[axis] / spin[axis] - 1) for axis in (1, 2)),
                   3.7e-3)
    record.at_most("spin decay: velocity that the torque gave", max(abs(particle_states(run.folder)["velocity"][0])), 0,
                   "m/s")


def shear(demvof, record):
    height, gamma = 0.02, 1.0
    case = box("spin_shear", height, 1, end_time=0.3, window=2e-3)
    for side, z in (("z-", 0), ("z+", height)):
        case.sides[side] = Inlet((gamma * (z - height / 2), 0, 0))
    case.particles = [Particle((0.009, 0.0105, 0.011), DIAMETER, DENSITY)]
    run = case.run(demvof)
    spin = particle_states(run.folder)["spin"][0]
    record.note("shear: DEM step over spin time", 2e-3 / spin_time(1))
    record.at_most("shear: spin / (gamma/2), relative error", abs(spin[1] / (gamma / 2) - 1), 2.4e-4)
    record.at_most("shear: spin about the other axes / (gamma/2)", max(abs(spin[0]), abs(spin[2])) / (gamma / 2), 1e-13)


def main():
    record = Record("spin", "Spin of a sphere in a fluid at rest and in shear",
                    "Torque of the fluid through the real pair: the spin of a sphere in a fluid at rest against Stokes's decay, "
                    "and of one between two walls that slide against each other against half the curl of the flow.",
                    "tests/Alltest --verification -- -R pair.spin")
    demvof = command_line().demvof
    decay(demvof, record)
    shear(demvof, record)
    sys.exit(record.write())


if __name__ == "__main__":
    main()
