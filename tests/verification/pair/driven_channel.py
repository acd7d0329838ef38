#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A thick liquid with a neutral bead between two walls, driven by fvOptions: a mean velocity force, and a source of given
strength. What drives it, the profile, and the books are those of plane Poiseuille flow on the mesh (walls half a cell away). And liquids
whose velocity constraints of fvOptions hold, everywhere, in one cell, or where it is fast: what holds it is in the books.

Usage: driven_channel.py DEMVOF"""
import re

import numpy
from box_case import BoxCase, Cyclic, Particle, Wall, command_line, momentum_of_everything, scratch
from box_fields import output_times, vector_field
from record import Record

HEIGHT, CELLS, DENSITY, MEAN = 0.04, 16, 1000.0, 0.01
HEADER = "FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }\n"


def poiseuille(viscosity):
    """Gradient for the mean velocity, Pa/m, and the profile, on the mesh."""
    h = HEIGHT / CELLS
    a = numpy.diag(numpy.full(CELLS, 2.0)) - numpy.diag(numpy.ones(CELLS - 1), 1) - numpy.diag(numpy.ones(CELLS - 1), -1)
    a[0, 0] = a[-1, -1] = 3
    per_gradient = numpy.linalg.solve(a * viscosity / h**2, numpy.ones(CELLS))
    return MEAN / per_gradient.mean(), MEAN * per_gradient / per_gradient.mean()


CONSTRAINTS = {
    "everywhere": "selectionMode all; fieldValues { U (0.2 0 0); }",
    "in a cell": "selectionMode points; points ((0.011 0.011 0.009)); fieldValues { U (0.2 0.1 0.05); }",
}


def constrained(entries, kind="vectorFixedValueConstraint"):
    return lambda _: f"hold {{ type {kind}; {entries} }}\n"


def channel(name, number, options, windows=None, velocity=(0, 0, 0)):
    """number: nu dt/dx2."""
    window = 2e-3
    nu = number * (HEIGHT / CELLS)**2 / window
    end = window * round(2 * HEIGHT**2 / nu / window + 20) if number > 0.5 else 0.8
    if windows:
        end = windows * window
    case = BoxCase(scratch(f"driven_channel/{name}"), (0.02, 0.02, HEIGHT), (8, 8, CELLS), (2, 2, 4), end, window,
                   gravity=(0, 0, 0), liquid=(DENSITY, nu), dem_step=window / 10, output_interval=end, longest_step=window, velocity=velocity,
                   particles=[Particle((0.01, 0.01, 0.02), 1e-3, DENSITY)],
                   extra_files={"fluid/constant/fvOptions": HEADER + options(nu * DENSITY)})
    case.sides = {side: Wall() if side[0] == "z" else Cyclic() for side in case.sides}
    return case, nu * DENSITY


def mean_velocity(_):
    return (f"drive {{ type meanVelocityForce; active yes; selectionMode all; fields (U); Ubar ({MEAN} 0 0); relaxation 1; }}\n")


def given(viscosity):
    return ("drive { type vectorSemiImplicitSource; active yes; selectionMode all; volumeMode specific; "
            f"injectionRateSuSp {{ U (({poiseuille(viscosity)[0]:.12g} 0 0) 0); }} }}\n")


def main():
    options = command_line()
    record = Record("driven_channel", "Channels driven by fvOptions",
                    "A thick liquid and a neutral bead between walls, driven by a mean velocity force and by a given source: gradient "
                    "and profile of plane Poiseuille flow on the mesh, momentum of everything.",
                    "tests/Alltest -- -R pair.driven_channel")
    for name, number, drive, off, gradient_off in (("mean velocity, nu dt/dx2 3.2", 3.2, mean_velocity, 1.2e-5, 1e-4),
                                                   ("mean velocity, nu dt/dx2 100", 100, mean_velocity, 0.017, 0.02),
                                                   ("given source, nu dt/dx2 3.2", 3.2, given, 1.3e-4, None)):
        case, viscosity = channel(re.sub(r"\W+", "_", name), number, drive)
        run = case.run(options.demvof)
        gradient, profile = poiseuille(viscosity)
        u = vector_field(run, output_times(run)[-1], "U", case.fine)[0, 0, :, 0]
        record.at_most(f"{name}: profile, over the mean velocity", abs(u - profile).max() / MEAN, off)
        if gradient_off:
            said = re.findall(r"pressure gradient = (\S+)", (run.folder / "fluid.log").read_text())
            record.at_most(f"{name}: gradient against that of the flow", abs(float(said[-1]) / gradient - 1), gradient_off)
    for number in (0.1, 3.2):
        for place, entries in CONSTRAINTS.items():
            run = channel(f"held_{place.replace(' ', '_')}_{number}", number, constrained(entries), windows=20)[0].run(options.demvof)
            record.at_least(f"velocity held {place}, nu dt/dx2 {number}: what holds it over the momentum it brings",
                            run.results["momentum"]["impulses"]["sources"][0] / run.history["fluid_momentum_x"][-1], 1)
        damping = constrained("selectionMode all; UMax 0.05;", "velocityDampingConstraint")
        run = channel(f"damped_{number}", number, damping, windows=20, velocity=(0.2, 0, 0))[0].run(options.demvof)
        record.at_least(f"velocity damped, nu dt/dx2 {number}: what damps it, N s", -run.results["momentum"]["impulses"]["sources"][0], 5e-7)
    momentum_of_everything(record, 4.8e-13)
    raise SystemExit(record.write())


main()
