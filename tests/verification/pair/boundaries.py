# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundaries of the pair: periodic directions, a slanted wall, outlets, frozen particles, particles of two sizes.

Usage: boundaries.py DEMVOF [NAMES OF TESTS]"""
import sys

import numpy

from box_case import BoxCase, Cyclic, Inlet, Open, Outlet, Particle, Slip, Wall, momentum_of_everything, particle_states, scratch
from box_fields import output_times, vector_field
from record import Record
from reporting.fields import series_output

DEMVOF = sys.argv[1]
RECORD = Record("boundaries", "Boundaries",
                "Particles and fluid meet the same ends of the domain: a particle that crosses a periodic end moves "
                "like one that does not; beads come to rest on a slanted wall that cuts bulk cells; particles of two "
                "types and sizes in one bed; frozen particles in a through-flow; a bed on an inlet of given velocity or flow; "
                "particles that leave with the fluid "
                "are counted as left, not as lost; a second fluid that is nowhere at the start; meshes and scripts that disagree are "
                "refused.",
                "tests/Alltest --verification -- -R pair.boundaries")


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
        RECORD.at_most(f"periodic, {name}: exchange error", run.number("conservation.exchange"), 5e-14)
        RECORD.at_most(f"periodic, {name}: solid volume error", run.number("conservation.solid_volume"), 6e-14)
    # The few iterations of conjugate gradients for the flux of the solid (solid_motion.cpp) make round-off larger.
    RECORD.at_most("periodic: position, across against inside, over the box",
                   numpy.abs(states[0][0] - states[1][0]).max() / length, 4e-10)
    RECORD.at_most("periodic: velocity, across against inside",
                   numpy.abs(states[0][1] - states[1][1]).max(), 1.3e-9, "m/s")
    fallen = 0.03 - states[0][0][:, 2].max()
    RECORD.at_least("periodic: the beads fall by", fallen, 0.01, "m")


def falling_along_a_period():
    """Nothing holds water and beads but the pressure that jumps from end to end: they gain what the beads outweigh."""
    case = BoxCase(scratch("boundaries/falling"), upper=(0.04, 0.04, 0.08), fine=(8, 8, 16), bulk=(4, 4, 8), end_time=0.05,
                   window=1e-3, dem_step=1e-4, sides={side: Slip() for side in ("x-", "x+", "y-", "y+")})
    case.sides.update({"z-": Cyclic(), "z+": Cyclic()})
    for x, z in ((0.011, 0.005), (0.031, 0.047)):
        case.particles.append(Particle((x, 0.02, z), 4e-3, 2500))
    run = case.run(DEMVOF)
    gained = run.history["fluid_momentum_z"] + run.history["particle_momentum_z"] + run.history["pending_momentum_z"]
    expected = -9.81 * 2 * numpy.pi / 6 * 4e-3**3 * (2500 - 1000) * 0.05
    RECORD.at_most("gravity along a period: momentum gained / exact - 1", abs((gained[-1] - gained[0]) / expected - 1), 0.0019)
    RECORD.at_most("gravity along a period: momentum of everything", max(run.results["momentum"]["error"]), 5.8e-14)


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


# ---- a wall across the bulk grid

def facet(a, b, c):
    corners = "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*p) for p in (a, b, c))
    return f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n"


def rectangle(name, a, b, c, d):
    """STL text of a plane rectangle with these corners."""
    return f"solid {name}\n{facet(a, b, c)}{facet(a, c, d)}endsolid {name}\n"


def slanted_floor():
    """Beads fall on a floor that rises along x: blockMesh's slanted block, and an STL plane in LIGGGHTS."""
    length, width, rise, diameter = 0.06, 0.036, 0.012, 5e-3
    case = BoxCase(scratch("boundaries/slanted_floor"), upper=(length, width, 0.06), fine=(10, 6, 10),
                   bulk=(5, 3, 5), end_time=0.3, window=1e-3, dem_step=2e-5, floor_rise=rise, margin=0.01, momentum_judged=False,
                   contacts=True, stiffness=500, pimple="nNonOrthogonalCorrectors 2;")
    case.sides["z+"] = Open(alpha=1)
    slope = rise / length
    for x in (0.003, 0.0083, 0.0136, 0.0189, 0.0242):  # without rolling friction they would roll down to x = 0
        for y in (0.012, 0.024):
            case.particles.append(Particle((x, y, 0.004 + slope * x), diameter, 2500))
    out = 0.005
    case.script_tail = ("fix floor all mesh/surface file floor.stl type 1\n"
                        "fix floor_wall all wall/gran model hooke/stiffness tangential history mesh n_meshes 1 "
                        "meshes floor\n")
    corners = [(x, y, slope * x) for x, y in ((-out, -out), (length + out, -out), (length + out, width + out),
                                              (-out, width + out))]
    case.extra_files["particles/floor.stl"] = rectangle("floor", *corners)
    run = case.run(DEMVOF)
    state = particle_states(run.folder)
    normal = numpy.array([-slope, 0, 1]) / numpy.hypot(slope, 1)
    height = state["position"] @ normal - diameter / 2
    written = series_output(run.folder, "surfaces", case.end_time)
    written = sorted(written.GetPoint(i) for i in range(written.GetNumberOfPoints()))
    given = sorted(corners[i] for i in (0, 1, 2, 0, 2, 3))
    RECORD.at_most("slanted STL floor: corners of its triangles, as the run wrote them", numpy.abs(numpy.subtract(written, given)).max(),
                   1e-16, "m")
    RECORD.at_most("slanted STL floor: particles lost", run.results["particles"]["lost"], 0)
    RECORD.at_most("slanted STL floor: solid volume error, bulk grid and fine mesh",
                   run.number("conservation.solid_volume"), 6e-14)
    RECORD.at_most("slanted STL floor: exchange error", run.number("conservation.exchange"), 5e-14)
    RECORD.at_least("slanted STL floor: lowest bead above the plane", height.min() / diameter, -0.01, "d")
    RECORD.at_most("slanted STL floor: highest bead above the plane", height.max() / diameter, 0.01, "d",
                   loose="the beads press into the plane by 3e-4 d, which the lowest one's bound sees")
    RECORD.at_most("slanted STL floor: fastest bead at the end",
                   numpy.linalg.norm(state["velocity"], axis=1).max(), 6.6e-3, "m/s")
    RECORD.at_most("slanted STL floor: fastest water at the end", run.history["max_speed"][-1], 1.2e-3, "m/s")
    RECORD.curve("Beads on a slanted floor", "time, s", "m/s", "fastest water", run.history["time"],
                 run.history["max_speed"], style="-")


# ---- two sizes and types

def two_sizes():
    """A bed of two types of beads in a closed box, put in layers that touch the floor and settle."""
    case = BoxCase(scratch("boundaries/two_sizes"), upper=(0.048, 0.048, 0.06), fine=(8, 8, 10), bulk=(4, 4, 5),
                   end_time=0.25, window=1e-3, dem_step=2e-5, contacts=True, stiffness=500, margin=0.002)
    # No longer: the small beads stand on the large ones, and fall over some time.
    kinds = {1: (6e-3, 2500), 2: (4e-3, 1800)}
    for layer, kind in enumerate((1, 2)):
        diameter, density = kinds[kind]
        for i in range(6):
            for j in range(6):
                x, y = 0.005 + i * 0.0075, 0.005 + j * 0.0075
                case.particles.append(Particle((x, y, 0.0032 + 0.0065 * layer), diameter, density, type=kind))
    run = case.run(DEMVOF)
    state = particle_states(run.folder)
    small = state["radius"] < 2.5e-3
    RECORD.at_most("two sizes: particles lost", run.results["particles"]["lost"], 0)
    RECORD.at_most("two sizes: beads of each type, against the script",
                   abs(int(small.sum()) - 36) + abs(int((~small).sum()) - 36), 0)
    volume = numpy.pi / 6 * (2 * state["radius"]) ** 3
    mass = volume * numpy.where(small, 1800, 2500)
    potential = 9.81 * float((mass * state["position"][:, 2]).sum())
    RECORD.at_most("two sizes: sum of m g z of the run, against diameters and densities of the script",
                   abs(run.history["particle_potential_energy"][-1] / potential - 1), 2e-15)
    RECORD.at_most("two sizes: solid volume error", run.number("conservation.solid_volume"), 6e-14)
    RECORD.at_most("two sizes: solid volume on the mesh, against the script",
                   abs(run.history["solid_volume_mesh"][-1] / volume.sum() - 1), 6.6e-15)
    RECORD.at_most("two sizes: mean speed of the beads at the end",
                   numpy.linalg.norm(state["velocity"], axis=1).mean(), 1.2e-3, "m/s")
    RECORD.at_most("two sizes: fastest water at the end", run.history["max_speed"][-1], 3.2e-4, "m/s")


# ---- inlets and outlets

def channel(name, **changes):
    case = BoxCase(scratch(f"boundaries/{name}"), upper=(0.08, 0.02, 0.02), fine=(16, 4, 4), bulk=(8, 2, 2),
                   gravity=(0, 0, 0), end_time=0.2, window=1e-3, dem_step=1e-4, velocity=(0.2, 0, 0), **changes)
    case.sides.update({side: Slip() for side in ("y-", "y+", "z-", "z+")})
    case.sides.update({"x-": Inlet((0.2, 0, 0)), "x+": Outlet()})
    return case


def frozen_in_a_stream():
    case = channel("frozen", pimple="nOuterCorrectors 2;")
    for i in range(3):
        for j in range(3):
            for k in range(3):
                case.particles.append(Particle((0.03 + 6e-3 * i, 4e-3 + 6e-3 * j, 4e-3 + 6e-3 * k), 4e-3, 2500,
                                               held=True))
    run = case.run(DEMVOF)
    state = particle_states(run.folder)
    start = numpy.array([p.position for p in case.particles])
    RECORD.at_most("frozen: displacement", numpy.abs(state["position"] - start).max(), 0, "m")
    RECORD.at_most("frozen: exchange error", run.number("conservation.exchange"), 5e-14)
    RECORD.at_most("frozen: solid volume error", run.number("conservation.solid_volume"), 6e-14)
    RECORD.at_most("frozen: liquid volume error", run.number("conservation.liquid_volume"), 4e-14)
    # What the stream loses in pressure the particles hold: dp A = drag + pressure force. The water upstream has
    # the pressure dp, that downstream none.
    force = float((state["drag_force"] + state["pressure_force"])[:, 0].sum())
    RECORD.at_least("frozen: force on the particles", force, 2e-3, "N")
    pressure_drop = pressure_upstream(run)
    RECORD.at_most("frozen: pressure drop times area against the force on the particles",
                   abs(pressure_drop * 0.02 ** 2 / force - 1), 8.4e-4)


def pressure_upstream(run):
    """p in the first cells of the last field output, Pa."""
    times = [d for d in (run.folder / "fluid").iterdir() if d.name.replace(".", "").replace("e-", "").isdigit()]
    content = (max(times, key=lambda d: float(d.name)) / "p").read_bytes()
    start = content.index(b"nonuniform List<scalar>")
    head = content.index(b"(", start)
    count = int(content[start + len(b"nonuniform List<scalar>"):head])
    values = numpy.frombuffer(content[head + 1:head + 1 + 8 * count])
    return float(values.reshape(4, 4, 16)[:, :, 0].mean())


def bed_on_the_inlet():
    """What the user gives at a patch is the flow there, though a bed of held beads stands on it."""
    edge, speed = 0.012, 0.02  # superficial velocity, m/s
    for name, inlet in (("velocity", (0, 0, speed)),
                        ("flow rate", f"flowRateInletVelocity; volumetricFlowRate {speed * edge**2:.17g}; "
                                      f"value uniform (0 0 {speed})")):
        case = BoxCase(scratch(f"boundaries/bed_on_the_inlet_{name.split()[0]}"), upper=(edge, edge, 0.036),
                       fine=(2, 2, 12), bulk=(2, 2, 6), end_time=0.04, window=2e-3, gravity=(0, 0, 0), tolerance=1e-12,
                       forces=[{"drag": "gidaspow"}, "pressure_gradient"])
        case.sides = {side: Slip() for side in case.sides}
        case.sides.update({"z-": Inlet(inlet), "z+": Outlet()})
        for i in range(5):
            for j in range(5):
                for k in range(7):
                    case.particles.append(Particle([2.4e-3 * (n + 0.5) for n in (i, j, k)], 2e-3, 2500, held=True))
        run = case.run(DEMVOF)
        out = vector_field(run, output_times(run)[-1], "U", case.fine)[:, :, -1, 2].mean()  # clear water there
        RECORD.at_most(f"bed on the inlet, given {name}: outflow against what is given", abs(out / speed - 1), 5e-6)


def out_with_the_stream():
    """Beads drift out of the channel: through a counting and deleting outlet, and without one."""
    for name, outlet in (("left", True), ("lost", False)):
        case = channel(f"out_{name}", margin=0.01)
        for i in range(4):
            case.particles.append(Particle((0.03 + 0.012 * i, 0.008 + 0.001 * i, 0.01), 3e-3, 1000, (0.2, 0, 0)))
        case.end_time = 0.15
        case.sections["limits"] = {"lost_particles": 1}
        if outlet:
            case.script_tail = ("fix outlet_mesh all mesh/surface file outlet.stl type 1\n"
                                "fix outlet all massflow/mesh mesh outlet_mesh vec_side 1 0 0 count once "
                                "delete_atoms yes\n")
            case.extra_files["particles/outlet.stl"] = rectangle(
                "outlet", (0.0799, -0.005, -0.005), (0.0799, 0.025, -0.005), (0.0799, 0.025, 0.025),
                (0.0799, -0.005, 0.025))
        run = case.run(DEMVOF)
        count = run.results["particles"]
        expected = {True: (2, 0), False: (0, 1)}[outlet]
        RECORD.note(f"out with the stream, {name}: left", count["left"])
        RECORD.note(f"out with the stream, {name}: lost", count["lost"])
        RECORD.at_most(f"out with the stream, {name}: against what the positions say",
                       abs(count["left"] - expected[0]) + abs(count["lost"] - expected[1]), 0)
        RECORD.at_most(f"out with the stream, {name}: exchange error", run.number("conservation.exchange"), 5e-14)
        RECORD.at_most(f"out with the stream, {name}: solid volume error",
                       run.number("conservation.solid_volume"), 6e-14)


# ---- from a face

def stream_from_a_face():
    """LIGGGHTS's fix insert/stream moves its beads at one velocity until they have left the face's volume; fluid and weight
    act from then on. They are put in before the coupled run, so that every window is judged."""
    edge, speed = 0.03, 1.0
    case = BoxCase(scratch("boundaries/stream"), upper=(edge, edge, 2 * edge), fine=(4, 4, 8), bulk=(4, 4, 8), end_time=0.03,
                   window=1e-3, dem_step=1e-4)
    case.sides["z+"] = Open(alpha=1)
    case.particles.append(Particle((edge / 2, edge / 2, 5e-3), 2e-3, 1000))
    case.extra_files["particles/face.stl"] = rectangle("face", (0.01, 0.01, 0.04), (0.02, 0.01, 0.04), (0.02, 0.02, 0.04),
                                                       (0.01, 0.02, 0.04))
    case.script_tail = ("fix template all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 5e-4\n"
                        "fix mix all particledistribution/discrete 32452843 1 template 1.0\n"
                        "fix face all mesh/surface file face.stl type 1\n"
                        "fix stream all insert/stream seed 32452867 distributiontemplate mix nparticles 10 particlerate 1000 "
                        f"vel constant 0 0 -{speed} overlapcheck yes insertion_face face extrude_length 0.01\nrun 1\n")
    run = case.run(DEMVOF)
    velocity = particle_states(run.folder)["velocity"][1:, 2]
    RECORD.at_least("stream from a face: beads that were let go, and slowed down", int((velocity > -0.9 * speed).sum()), 5)
    RECORD.at_most("stream from a face: exchange error", run.number("conservation.exchange"), 1.4e-14)
    RECORD.at_most("stream from a face: momentum of everything", run.number("conservation.momentum"), 7e-15)


# ---- no room

def no_room_for_the_fluid():
    """A sphere larger than its bulk cell, whose kernel puts all that fits there: the fine cell keeps 0.05 of fluid."""
    spacing, diameter = 2e-3, 3e-3
    case = BoxCase(scratch("boundaries/no_room"), (6 * spacing,) * 3, (6, 6, 6), (6, 6, 6), 5e-3, 1e-3,
                   particles=[Particle((2.5 * spacing,) * 3, diameter, 2500, held=True)],
                   coupling={"averaging": {"kernel": "centre", "maximum_solid_fraction": 1.0}})
    case.sides["z+"] = Open()
    run = case.run(DEMVOF)
    RECORD.at_least("no room for the fluid: warnings that say so",
                    sum("kept a void fraction of 0.05" in line and " 5 times" in line for line in run.results["warnings"]), 1)
    left_out = 0.05 * spacing**3 / (numpy.pi / 6 * diameter**3)
    RECORD.at_most("no room for the fluid: what the books say is not displaced, against 0.05 of a cell",
                   abs(run.number("conservation.solid_volume") / left_out - 1), 5e-13)
    RECORD.at_most("no room for the fluid: exchange error", run.number("conservation.exchange"), 1.8e-15)


# ---- one fluid only

def the_other_fluid_is_nowhere():
    """A box with air outside that begins full of water, or dry with water that comes in; a kernel that reaches everywhere."""
    for name, sides, wet in (("full of water", {"z+": Open()}, 1), ("dry", {"x-": Inlet((0.1, 0, 0)), "z+": Outlet(0)}, 0)):
        case = BoxCase(scratch(f"boundaries/{name.replace(' ', '_')}"), upper=(0.04, 0.04, 0.06), fine=(4, 4, 6), bulk=(4, 4, 6), end_time=5e-3,
                       window=1e-3, dem_step=1e-4, level=None if wet else -1.0, coupling={"averaging": {"kernel": "diffusion"}},
                       particles=[Particle((0.02, 0.02, 0.03), 2e-3, 2500)])
        case.sides = {side: Slip() for side in case.sides} | sides
        run = case.run(DEMVOF)
        RECORD.at_most(f"the other fluid is nowhere, {name}: exchange error", run.number("conservation.exchange"), 1e-14)
        RECORD.at_most(f"the other fluid is nowhere, {name}: solid volume error", run.number("conservation.solid_volume"), 5e-13)


TESTS = [periodic, falling_along_a_period, refusals, slanted_floor, two_sizes, frozen_in_a_stream, bed_on_the_inlet, out_with_the_stream,
         stream_from_a_face, no_room_for_the_fluid, the_other_fluid_is_nowhere]
for test in TESTS:
    if len(sys.argv) < 3 or test.__name__ in sys.argv[2:]:
        test()
momentum_of_everything(RECORD)
sys.exit(RECORD.write())
