# SPDX-License-Identifier: GPL-3.0-or-later
"""A box in two halves that meet in a plane, at patches of type cyclicAMI or cyclicACMI.

    uniform stream past beads along a periodic box                      it stays uniform, as if it were one mesh
    cyclicACMI, one half shifted: the rest of either side is a wall     the books close
    cyclicACMI, one half of the mesh moves                              refused by demvof check, which names the patch
    cyclicACMI, a bead beside it, fine cells larger than bulk cells     it moves as one beside the end of the period, which has no wall either

Usage: overlapping_patches.py DEMVOF"""
import subprocess

import numpy
from box_case import BoxCase, Particle, command_line, momentum_of_everything, particle_states, scratch, vector
from moving_walls import foam_file, mesh_motion
from record import Record

EDGE, WINDOW, STREAM = 0.01, 1e-3, (0.1, 0, 0)  # of a bulk cell, m; s; m/s
FIELDS = {"U": ("volVectorField", "[0 1 -1 0 0 0 0]", vector(STREAM)), "p_rgh": ("volScalarField", "[1 -1 -2 0 0 0 0]", "0"),
          "alpha.water": ("volScalarField", "[0 0 0 0 0 0 0]", "1")}
SIDES = {"U": "slip", "p_rgh": "zeroGradient", "alpha.water": "zeroGradient"}
INLET = {"U": f"fixedValue; value uniform {vector(STREAM)}", "p_rgh": "fixedFluxPressure; value uniform 0", "alpha.water": "fixedValue; value uniform 1"}
OUTLET = {"U": "inletOutlet; inletValue uniform (0 0 0); value uniform (0 0 0)", "p_rgh": "fixedValue; value uniform 0", "alpha.water": "zeroGradient"}


def blocks(shift, periodic, cells):
    """blockMeshDict of the two halves along x; shift: of the second along y; cells: of each."""
    points = " ".join(vector((x, y + dy, z)) for x, dy in ((0, 0), (0.03, 0), (0.03, shift), (0.06, shift)) for z in (0, 0.04) for y in (0, 0.04))
    def block(a, zone):
        b = a + 4
        return f"hex ({a} {b} {b + 1} {a + 1} {a + 2} {b + 2} {b + 3} {a + 3}) {zone} {vector(cells)} simpleGrading (1 1 1)"
    def end(a):
        return f"({a} {a + 1} {a + 3} {a + 2})"
    sides = " ".join(f"({a} {b} {b + 1} {a + 1}) ({a + 2} {b + 2} {b + 3} {a + 3}) ({a} {b} {b + 2} {a + 2}) ({a + 1} {b + 1} {b + 3} {a + 3})"
                     for a, b in ((0, 4), (8, 12)))
    ends = ("cyclic; neighbourPatch out", "cyclic; neighbourPatch in") if periodic else ("patch", "patch")
    return foam_file("dictionary", f"scale 1;\nvertices ({points});\nblocks ({block(0, 'left')} {block(8, 'right')});\nedges ();\nboundary\n"
                     f"( in {{ type {ends[0]}; faces ({end(0)}); }} out {{ type {ends[1]}; faces ({end(12)}); }} sides {{ type patch; faces ({sides}); }}\n"
                     f"  a {{ type patch; faces ({end(4)}); }} b {{ type patch; faces ({end(8)}); }} );\nmergePatchPairs ();")


def baffles(kind):
    """createBafflesDict that makes the two patches, each with the wall that is left where nothing is opposite."""
    partial = kind == "cyclicACMI"
    def side(name, other):
        wall = f"name {name}_blockage; type wall;"
        return (f"{name} {{ type faceZone; zoneName {name}; patches {{ master {{ name {name}_couple; type {kind}; neighbourPatch {other}_couple; "
                f"transform noOrdering; matchTolerance 1e-4; {f'nonOverlapPatch {name}_blockage;' if partial else ''} }} "
                f"slave {{ name {name}_couple; type patch; }} {f'master2 {{ {wall} }} slave2 {{ {wall} }}' if partial else ''} }} }}")
    return foam_file("dictionary", f"internalFacesOnly false; baffles {{ {side('a', 'b')} {side('b', 'a')} }}")


def halves(name, kind, held, shift=0.0, cells=(6, 8, 8), bulk=(6, 4, 4)):
    """cells: of the fluid in each half. bulk: cells of the grid, in all; the shift is whole ones."""
    periodic = shift == 0
    case = BoxCase(scratch(f"overlapping_patches/{name}"), (6 * EDGE, 4 * EDGE + shift, 4 * EDGE), (2 * cells[0], *cells[1:]),
                   (bulk[0], bulk[1] + round(shift / EDGE), bulk[2]), 0.02,
                   WINDOW, gravity=(0, 0, 0), velocity=STREAM, tolerance=1e-13, relative_tolerance=0, history_interval=WINDOW, dem_step=WINDOW / 10,
                   first_step=WINDOW / 4, longest_step=WINDOW / 4, forces=[] if held else [{"drag": "di_felice"}, "pressure_gradient"],
                   periodic=[periodic, False, False], prepare=["cp -r 0 fields", "blockMesh", "topoSet", "createBaffles -overwrite",
                                                               "cp fields/U fields/p_rgh fields/alpha.water 0"])
    case.extra_files = {"fluid/system/blockMeshDict": blocks(shift, periodic, cells), "fluid/system/createBafflesDict": baffles(kind)}
    case.extra_files["fluid/system/topoSetDict"] = foam_file("dictionary", "actions (" + " ".join(
        f"{{ name {n}; type faceSet; action new; source patchToFace; patch {n}; }} {{ name {n}; type faceZoneSet; action new; source setToFaceZone; faceSet {n}; }}"
        for n in "ab") + ");")
    for field, (cls, dimensions, value) in FIELDS.items():
        entries = {f"{n}_blockage": SIDES[field] for n in "ab"} if kind == "cyclicACMI" else {}
        entries.update({"a_couple": kind, "b_couple": kind, "sides": SIDES[field], "in": "cyclic" if periodic else INLET[field],
                        "out": "cyclic" if periodic else OUTLET[field], '"[ab]"': f"calculated; value uniform {value}"})
        boundary = " ".join(f"{patch} {{ type {entry}; }}" for patch, entry in entries.items())
        case.extra_files[f"fluid/0.orig/{field}"] = foam_file(cls, f"dimensions {dimensions};\ninternalField uniform {value};\nboundaryField {{ {boundary} }}")
    case.particles = [Particle(((i + .3) * EDGE, (j + .4) * EDGE, (k + .5) * EDGE), 5e-3, 1000, held=held, velocity=(0, 0, 0) if held else STREAM)
                      for i in range(6) for j in range(1 if shift else 0, 4) for k in range(4)]
    return case


def refused(demvof):
    """Whether check says of halves that slide what is wrong."""
    case = halves("slides", "cyclicACMI", False)
    case.extra_files["fluid/constant/dynamicMeshDict"] = mesh_motion(
        "motionSolver solidBody; cellZone right; solidBodyMotionFunction linearMotion; linearMotionCoeffs { velocity (0 0.2 0); }")
    done = subprocess.run([demvof, "check", str(case.write())], capture_output=True, text=True, check=False)
    return done.returncode == 2 and "patch a_couple of type cyclicACMI" in done.stdout + done.stderr


def velocity_beside(demvof, end):
    """Of a bead that the stream takes along, beside the plane (end 0.03 m) or the end of the period (0.06 m)."""
    case = halves(f"beside_{round(end / EDGE)}", "cyclicACMI", False, cells=(3, 4, 4), bulk=(12, 8, 8))
    case.forces = [{"drag": "di_felice"}, "pressure_gradient"]
    case.particles = [Particle((end - 1.5e-3, 0.018, 0.018), 5e-3, 1000)]
    return particle_states(case.run(demvof).folder)["velocity"][0]


def main():
    options = command_line()
    record = Record("overlapping_patches", "Meshes in two halves that meet at patches",
                    "A periodic box whose mesh is in two halves, joined by patches of type cyclicAMI or cyclicACMI, with beads in a uniform stream; and "
                    "halves that overlap in part, with the rest a wall.", "tests/Alltest -- -R 'pair.overlapping_patches$'")
    runs = []
    for kind, bound in (("cyclicAMI", 2e-12), ("cyclicACMI", 1e-10)):
        for held in (True, False):
            runs.append(halves(f"{kind}_{held}", kind, held).run(options.demvof))
            energy, fastest = (runs[-1].history[name] for name in ("kinetic_energy", "max_speed"))
            record.at_most(f"{kind}, beads {'held' if held else 'in the stream'}: error of the stream's speed",
                           max(max(abs(fastest / STREAM[0] - 1)), max(abs(numpy.sqrt(energy / energy[0]) - 1))), bound)
    runs.append(halves("shifted", "cyclicACMI", False, EDGE).run(options.demvof))
    record.at_least("one half shifted by a quarter: largest speed over the stream's, which has to pass by what overlaps",
                    runs[-1].history["max_speed"][-1] / STREAM[0], 1.2)
    for quantity, bound in (("exchange", 1.5e-13), ("liquid_volume", 1.5e-12), ("solid_volume", 1e-13)):
        record.at_most(f"all runs: {quantity.replace('_', ' ')}", max(run.results["conservation"][quantity] for run in runs), bound)
    plane, period = (velocity_beside(options.demvof, end) for end in (3 * EDGE, 6 * EDGE))
    record.at_most("cyclicACMI, a bead beside it, in fine cells of eight bulk cells, against one beside the end of the period: velocity over the stream's",
                   max(abs(plane - period)) / STREAM[0], 1.6e-10)
    record.at_least("cyclicACMI, a bead beside it: velocity over the stream's", plane[0] / STREAM[0], 0.1)
    record.at_most("halves that slide, cyclicACMI: not refused by name", int(not refused(options.demvof)), 0)
    momentum_of_everything(record, 8e-12)
    raise SystemExit(record.write())


main()
