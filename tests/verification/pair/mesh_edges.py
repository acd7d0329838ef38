# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the fluid's mesh ends, particles meet no fluid: a wall inside on faces of the bulk grid, the space above an
open top, and behind an outlet. Where it goes on, at the other end of a period or on another rank, there is no wall.

Usage: mesh_edges.py DEMVOF"""
import sys

import numpy

from box_case import BoxCase, Cyclic, Open, Outlet, Inlet, Particle, Slip, particle_states, scratch, vector
from box_fields import cell_field, output_times, vector_field
from record import Record

DEMVOF = sys.argv[1]
RECORD = Record("mesh_edges", "Where the fluid's mesh ends",
                "A wall inside the mesh, on faces of the bulk grid: nothing of a bead beside it arrives on the other side, "
                "with any kernel. Beads above an open top and behind an outlet displace nothing, feel nothing and are "
                "counted, until they fall in. A bead beside the end of a period, or beside cells of another rank, is as far from "
                "any wall, with fine cells larger than bulk cells too.",
                "tests/Alltest --verification -- -R pair.mesh_edges")


def wall_inside():
    """A bead rises beside a wall that parts the box in two; both halves are full of water."""
    half, edge, height = 0.02, 0.02, 0.06

    def block(x0):
        return " ".join(vector((x, y, z)) for z in (0, height)
                        for x, y in ((x0, 0), (x0 + half, 0), (x0 + half, edge), (x0, edge)))

    mesh = (f"FoamFile {{ version 2.0; format ascii; class dictionary; object blockMeshDict; }}\nscale 1;\n"
            f"vertices ( {block(0)} {block(half)} );\n"
            "blocks ( hex (0 1 2 3 4 5 6 7) (4 4 12) simpleGrading (1 1 1)\n"
            "         hex (8 9 10 11 12 13 14 15) (4 4 12) simpleGrading (1 1 1) );\nboundary\n(\n"
            "    xlow { type wall; faces ((0 4 7 3) (1 2 6 5)); }\n    xhigh { type wall; faces ((8 12 15 11) (9 10 14 13)); }\n"
            "    ylow { type wall; faces ((0 1 5 4) (8 9 13 12)); }\n    yhigh { type wall; faces ((3 7 6 2) (11 15 14 10)); }\n"
            "    zlow { type wall; faces ((0 3 2 1) (8 11 10 9)); }\n    zhigh { type patch; faces ((4 5 6 7) (12 13 14 15)); }\n);\n")
    for kernel in ({"kernel": "gaussian"}, {"kernel": "linear"}, {"kernel": "diffusion", "bandwidth": 0.01}):
        name = kernel["kernel"]
        case = BoxCase(scratch(f"mesh_edges/wall_{name}"), upper=(2 * half, edge, height), fine=(4, 4, 12), bulk=(4, 2, 6),
                       end_time=0.01, window=1e-3, dem_step=1e-4, gravity=(0, 0, 0), coupling={"averaging": kernel})
        case.sides["z+"] = Open(alpha=1)
        case.particles.append(Particle((half - 2e-3, edge / 2, 0.02), 4e-3, 2500, velocity=(0, 0, 0.3)))
        case.extra_files["fluid/system/blockMeshDict"] = mesh
        run = case.run(DEMVOF)
        # The cells of the two blocks come one after the other.
        last = output_times(run)[-1]
        solid = 1 - numpy.stack([block.reshape(12, 4, 4) for block in
                                 numpy.split(cell_field(run, last, "voidFraction", (1, 1, 384)).ravel(), 2)])
        speed = numpy.abs(numpy.stack(numpy.split(vector_field(run, last, "U", (1, 1, 384)).reshape(-1, 3), 2)))
        RECORD.at_least(f"wall inside, {name}: solid fraction beside the bead", solid[0].max(), 0.004)
        RECORD.at_most(f"wall inside, {name}: solid fraction behind the wall", numpy.abs(solid[1]).max(), 0)
        RECORD.at_most(f"wall inside, {name}: water behind the wall over that beside the bead",
                       speed[1].max() / speed[0].max(), 0)
        RECORD.at_most(f"wall inside, {name}: solid volume error", run.number("conservation.solid_volume"), 1e-13)
        RECORD.at_most(f"wall inside, {name}: exchange error", run.number("conservation.exchange"), 2e-14)


def above_an_open_top():
    """A bead falls from above the mesh into water that is at rest until then."""
    edge, top, height, start = 0.02, 0.04, 0.08, 0.06
    case = BoxCase(scratch("mesh_edges/above"), upper=(edge, edge, top), fine=(4, 4, 8), bulk=(2, 2, 8), end_time=0.08,
                   window=1e-3, dem_step=1e-4, margin=height - top, level=0.02,
                   history_interval=1e-3,
                   sections={"bulk_grid": {"upper": [edge, edge, height]}})
    case.sides["z+"] = Open()
    case.particles.append(Particle((edge / 2, edge / 2, start), 4e-3, 2500))
    run = case.run(DEMVOF)
    solid, time = numpy.array(run.history["solid_volume_mesh"]), numpy.array(run.times)
    volume = numpy.pi / 6 * 4e-3**3
    momentum = numpy.array(run.history["particle_momentum_z"])
    above = start - 9.81 * time**2 / 2 > top + 1e-3  # of the centre, with a margin of what drag may do to it
    inside = start - 9.81 * time**2 / 2 < top - 1e-3
    RECORD.at_most("above an open top: solid volume on the mesh while the bead is above, over its own",
                   solid[above].max() / volume, 0)
    per_window = -2500 * volume * 9.81 * case.window
    RECORD.at_most("above an open top: momentum gained in a window there, against the weight's",
                   numpy.abs(numpy.diff(momentum[above])[1:] / per_window - 1).max(), 2e-12)
    RECORD.at_most("above an open top: solid volume on the mesh once it is inside, against its own",
                   numpy.abs(solid[inside] / volume - 1).max(), 6.7e-13)
    RECORD.at_most("above an open top: exchange error", run.number("conservation.exchange"), 2e-14)


def behind_an_outlet():
    """A bead flies out through an outlet: what it has there it keeps."""
    length, edge = 0.04, 0.02
    case = BoxCase(scratch("mesh_edges/outlet"), upper=(length, edge, edge), fine=(8, 4, 4), bulk=(4, 2, 2), end_time=0.06,
                   window=1e-3, dem_step=1e-4, gravity=(0, 0, 0), velocity=(0.2, 0, 0), margin=0.1,
                   history_interval=1e-3)
    case.sides = {side: Slip() for side in case.sides}
    case.sides.update({"x-": Inlet((0.2, 0, 0)), "x+": Outlet()})
    case.particles.append(Particle((0.02, edge / 2, edge / 2), 4e-3, 2500, velocity=(1, 0, 0)))
    run = case.run(DEMVOF)
    momentum = numpy.array(run.history["particle_momentum_x"])
    solid = numpy.array(run.history["solid_volume_mesh"])
    volume = numpy.pi / 6 * 4e-3**3
    gone = numpy.flatnonzero(solid < 1e-10 * volume)
    RECORD.at_most("behind an outlet: solid volume on the mesh two windows later, over the bead's",
                   numpy.abs(solid[gone[2:]]).max() / volume, 9e-14)
    RECORD.at_least("behind an outlet: windows in which the bead is there", len(gone), 20)
    RECORD.at_most("behind an outlet: change of its momentum there, relative",
                   numpy.abs(momentum[gone[1:]] / momentum[gone[1]] - 1).max(), 1e-14)
    RECORD.at_least("behind an outlet: what the water took of it before", 1 - momentum[gone[0]] / momentum[0], 0.11)
    RECORD.at_least("behind an outlet: particles counted as outside at the end", run.results["particles"]["outside_fluid"], 1)
    RECORD.at_most("behind an outlet: exchange error", run.number("conservation.exchange"), 2e-14)


def no_wall():
    """A bead falls through the surface beside a face at which the mesh goes on, and the same without one. Fine cells lie in
    eight bulk cells each, whose faces on that face have no fine cells' centres beside them."""
    middle, end = 0.0185, 0.0385
    runs = {}
    for name, x, periodic, ranks in (("period, beside its end", end, True, 1), ("period, inside", middle, True, 1),
                                     ("2 ranks", middle, False, 2), ("1 rank", middle, False, 1)):
        case = BoxCase(scratch(f"mesh_edges/{name.replace(', ', '_').replace(' ', '_')}"), upper=(0.04, 0.02, 0.04), fine=(4, 2, 4), bulk=(8, 4, 8),
                       end_time=0.02, window=1e-3, dem_step=1e-4, level=0.0189, level_in_cells=True, tolerance=1e-14, relative_tolerance=0,
                       particles=[Particle((x, 0.009, 0.0205), 2e-3, 2500)], coupling={"averaging": {"kernel": "diffusion", "bandwidth": 0.01}})
        case.sides = {side: Slip() for side in case.sides} | {"z+": Open()} | ({"x-": Cyclic(), "x+": Cyclic()} if periodic else {})
        run = case.run(DEMVOF, "--fluid-ranks", str(ranks))
        runs[name] = particle_states(run.folder)["velocity"][0]
        RECORD.at_most(f"no wall, {name}: solid volume error", run.number("conservation.solid_volume"), 4e-13)
        RECORD.at_most(f"no wall, {name}: exchange error", run.number("conservation.exchange"), 1.5e-14)
    for one, other in (("period, beside its end", "period, inside"), ("2 ranks", "1 rank")):
        RECORD.at_most(f"no wall, {one} against {other}: velocity", numpy.abs(runs[one] - runs[other]).max(), 4.5e-14, "m/s")
    RECORD.at_least("no wall: speed to which the bead falls", -runs["1 rank"][2], 0.1, "m/s")


for test in (wall_inside, above_an_open_top, behind_an_outlet, no_wall):
    test()
sys.exit(RECORD.write())
