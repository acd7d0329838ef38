# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundaries of the pair: periodic directions, a slanted wall, outlets, frozen particles, particles of two sizes.

Usage: boundaries.py DEMVOF"""
import sys

import numpy

from box_case import BoxCase, Cyclic, Inlet, Open, Outlet, Particle, Slip, Wall, particle_states, scratch
from record import Record

DEMVOF = sys.argv[1]
RECORD = Record("boundaries", "Boundaries",
                "Particles and fluid meet the same ends of the domain: a particle that crosses a periodic end moves "
                "like one that does not; beads come to rest on a slanted wall that cuts bulk cells; particles of two "
                "types and sizes in one bed; frozen particles in a through-flow; particles that leave with the fluid "
                "are counted as left, not as lost; meshes and scripts that disagree are refused.")


def message_of(case, *options):
    """What the run is refused with, blanks and line breaks as one blank."""
    try:
        case.run(DEMVOF, *options, timeout=60)
    except RuntimeError as error:
        return " ".join(str(error).split())
    return "not refused"


# ---- periodic

def periodic_box(name, shift):
    """Two beads settle in a stream along x; shift: by a whole number of bulk cells."""
    length = 0.08
    case = BoxCase(scratch(f"boundaries/{name}"), upper=(length, 0.04, 0.04), fine=(16, 8, 8), bulk=(8, 4, 4),
                   end_time=0.1, window=1e-3, dem_step=1e-4, velocity=(0.4, 0, 0), tolerance=1e-14,
                   relative_tolerance=0)
    case.sides.update({"x-": Cyclic(), "x+": Cyclic(), "y-": Slip(), "y+": Slip(), "z-": Slip(), "z+": Slip()})
    for x, y in ((0.063, 0.021), (0.071, 0.017)):
        case.particles.append(Particle(((x + shift) % length, y, 0.03), 4e-3, 2500, velocity=(0.4, 0, 0)))
    return case, length


def periodic():
    states = []
    for name, shift in (("across", 0.0), ("inside", 0.04)):
        case, length = periodic_box(name, shift)
        run = case.run(DEMVOF)
        state = particle_states(run.folder)
        position = state["position"].astype(float)
        position[:, 0] = (position[:, 0] - shift) % length
        states.append((position, state["velocity"].astype(float)))
        RECORD.at_most(f"periodic, {name}: particles lost", run.results["particles"]["lost"], 0)
        RECORD.at_most(f"periodic, {name}: exchange error", run.number("conservation.exchange"), 1e-12)
        RECORD.at_most(f"periodic, {name}: solid volume error", run.number("conservation.solid_volume"), 1e-12)
    RECORD.at_most("periodic: position, across against inside, over the box",
                   numpy.abs(states[0][0] - states[1][0]).max() / length, 1e-10)
    RECORD.at_most("periodic: velocity, across against inside",
                   numpy.abs(states[0][1] - states[1][1]).max(), 1e-10, "m/s")
    fallen = 0.03 - states[0][0][:, 2].max()
    RECORD.at_least("periodic: the beads fall by", fallen, 1e-3, "m")


def refusals():
    case, _ = periodic_box("no_cyclic_patch", 0)
    case.sides.update({"x-": Wall(), "x+": Wall()})
    case.periodic = [True, False, False]
    text = message_of(case)
    RECORD.at_least("no cyclic patch: refused with both sides named",
                    int("exit code 2" in text and "particles' box is periodic" in text
                        and "no cyclic patches" in text), 1)
    case, _ = periodic_box("box_not_periodic", 0)
    case.periodic = [False, False, False]
    text = message_of(case)
    RECORD.at_least("box not periodic: refused with both sides named",
                    int("exit code 2" in text and "fluid mesh is cyclic" in text and "is not periodic" in text), 1)


periodic()
refusals()
sys.exit(RECORD.write())
