# SPDX-License-Identifier: GPL-3.0-or-later
"""OpenFOAM's tutorials with a handful of beads in their water and in their air, a case as a user would begin with."""
import json
import math
import random
import re
import shutil

import tutorials
from moving_walls import Walls, are_moved_by_the_flow, let_go_along
from tutorials import Failed

BEADS, SIZE, DENSITY = 8, 0.3, 2500  # diameter over the local width of a cell; kg/m3
STEPS, WINDOWS, DEM_STEPS = 5, 4, 20  # of the tutorial's deltaT in a window, at most; windows; DEM steps in a window
CELLS = 10                            # bulk cells along the longest side
FROM_WALLS = 1.5                      # cells between a bead and the next boundary, at least
BINS = 100                            # of LIGGGHTS's neighbour search along the longest side, at most
FALL = 5                              # diameters that a bead may fall in a run without a floor
COURANT = 0.5
CONTACT = 40                          # DEM steps that a contact would last, which sets the stiffness

SCRIPT = """\
# {count} beads in {name}. SI units.
units           si
atom_style      granular
atom_modify     map array
boundary        {boundary}
newton          off
communicate     single vel yes
region          box block {box} units box
variable        continued index 0
if              "${{continued}} == 1" then "read_restart ${{restart_file}}" else "create_box 1 box"
neighbor        {skin:.6g} bin
neigh_modify    delay 0
{create}
if              "${{continued}} == 0" then "set group all density {density}"
fix             kn     all property/global kn peratomtypepair 1 {stiffness:.6g}
fix             kt     all property/global kt peratomtypepair 1 {stiffness:.6g}
fix             gamman all property/global gamman peratomtypepair 1 0.
fix             gammat all property/global gammat peratomtypepair 1 0.
fix             mu     all property/global coefficientFriction peratomtypepair 1 0.3
pair_style      gran model hooke/stiffness tangential history
pair_coeff      * *
timestep        {step:.12g}
fix             gravity all gravity {weight:.12g} vector {down}
{walls}fix             integrate all nve/sphere
"""
WALL_STEP = 0.25  # of the smallest bead's diameter, that a wall moves in a window, at most
ROOM = 0.02  # of the longest side, between a mesh that moves and the ends of box and bulk grid


def known():
    """name -> folder."""
    return {f"beads/{name}": folder for name, folder in tutorials.tutorials().items()}


def settings():
    """For the page."""
    return {"beads": BEADS, "density": DENSITY, "size": SIZE, "from_walls": FROM_WALLS, "cells": CELLS, "windows": WINDOWS,
            "steps": STEPS, "fall": FALL, "courant": COURANT, "wall_step": WALL_STEP}


def vectors(text):
    return [tuple(map(float, numbers)) for numbers in re.findall(r"\(\s*([^\s()]+)\s+([^\s()]+)\s+([^\s()]+)\s*\)", text)]


def asked(arguments, case, folder, longest):
    """What one of the distribution's utilities says about the case."""
    log = folder / f"{arguments[0]}.log"
    if tutorials.bounded([*arguments, "-case", str(case)], folder, log, tutorials.environment(folder), longest):
        raise Failed(f"{arguments[0]}: {log.read_text(errors='replace')[-200:]}")
    return log.read_text(errors="replace")


def corners(case, folder, longest):
    said = asked(["checkMesh", "-time", "0"], case, folder, longest)
    found = re.search(r"Overall domain bounding box (\([^)]*\)) (\([^)]*\))", said)
    return vectors(found[1])[0], vectors(found[2])[0]


def periodic_axes(ends, lower, upper):
    """Axes at whose two ends lie cyclic patches of the mesh; `ends`: the boundary field of the cells' centres."""
    cyclic = [vectors(patch) for patch in re.findall(r"\{\s*type\s+cyclic\w*;([^{}]*)\}", ends)]
    def at(patch, axis, end):
        return patch and all(abs(face[axis] - end[axis]) < 1e-6 * (upper[axis] - lower[axis]) for face in patch)
    return [axis for axis in range(3) if any(at(p, axis, lower) for p in cyclic) and any(at(p, axis, upper) for p in cyclic)]


def places(case, folder, count, longest):
    """Centre and diameter of each bead, half of them in the liquid, half outside, as far as there is room; and the boundary
    field of the cells' centres."""
    liquid = tutorials.liquid_name(case)
    for function in ("writeCellCentres", "writeCellVolumes", f"mag({liquid})"):
        asked(["postProcess", "-time", "0", "-func", function], case, folder, longest)
    inside, ends = (case / "0" / "C").read_text().split("boundaryField")
    centres, boundary = vectors(inside[inside.index("internalField"):]), vectors(ends)
    volumes, wet = (tutorials.cell_values(case / "0" / name) for name in ("V", f"mag({liquid})"))
    volumes, wet = (values * len(centres) if len(values) == 1 else values for values in (volumes, wet))
    chosen, order = [], random.Random(1).sample(range(len(centres)), len(centres))
    for in_liquid in (True, False):
        wanted = len(chosen) + count // 2
        for cell in order[:4000]:
            if len(chosen) == wanted:
                break
            if (wet[cell] > 0.5) != in_liquid:
                continue
            centre = centres[cell]
            width = min(math.dist(centre, other) for other in centres if other is not centre)
            size = SIZE * min(width, volumes[cell] / width**2)
            if (min((math.dist(centre, end) for end in boundary), default=math.inf) > FROM_WALLS * width
                    and all(math.dist(centre, other) > size + d for other, d in chosen)):
                chosen.append((centre, size))
    if not chosen:
        raise Failed("no place for a bead that keeps off the boundaries")
    return chosen, ends


def gravity(case):
    file = case / "constant" / "g"
    return vectors(re.search(r"value\s+([^;]+);", file.read_text())[1])[0] if file.exists() else (0, 0, 0)


def as_demvof_asks(case):
    """What `demvof check` says of a case for pairs, done: Euler in place of another time scheme, a mesh that moves once a step,
    and by MULES. Steps as long as their Courant number allows."""
    file = case / "system" / "fvSchemes"
    file.write_text(re.sub(r"(ddtSchemes\s*\{\s*default\s+)[^;]+;", r"\1Euler;", file.read_text()))
    mesh = case / "constant" / "dynamicMeshDict"
    if mesh.exists() and "dynamicRefineFvMesh" not in mesh.read_text():
        file = case / "system" / "fvSolution"
        text = re.sub(r"(moveMeshOuterCorrectors\s+)\w+;", r"\1no;", file.read_text())
        file.write_text(re.sub(r"(isoFaceTol)", r"advectionScheme MULES; cAlpha 1;\n        \1", text))
    file = case / "system" / "controlDict"
    text = re.sub(r"^\s*(adjustTimeStep|maxCo|maxAlphaCo|maxDeltaT)\s[^;]*;", "", file.read_text(), flags=re.M)
    file.write_text(text + f"adjustTimeStep yes;\nmaxCo {COURANT};\nmaxAlphaCo {COURANT};\nmaxDeltaT 1;\n")


def prepare(name, ready, folder, longest, along=()):
    """A case file of the tutorial with beads; its walls that move, if any; the smallest bead's diameter. along: walls that
    `demvof check` has said to go along with the mesh."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ready, folder / "fluid")
    as_demvof_asks(folder / "fluid")
    for patch in along:
        let_go_along(folder / "fluid", patch)
    case, control = folder / "fluid", (ready / "system" / "controlDict").read_text()
    lower, upper = corners(case, folder, longest)
    beads, ends = places(case, folder, BEADS, longest)
    periodic = periodic_axes(ends, lower, upper)
    sides = [b - a for a, b in zip(lower, upper)]
    motion = case / "constant" / "dynamicMeshDict"
    moves = motion.exists() and "staticFvMesh" not in motion.read_text() and not are_moved_by_the_flow(case)
    weight = math.dist(gravity(case), (0, 0, 0))
    fall = math.sqrt(2 * FALL * min(d for _, d in beads) / weight) if weight else math.inf
    window = min(STEPS * float(tutorials.entry(control, "deltaT")), fall / WINDOWS)
    lightest = min(d for _, d in beads) ** 3 * math.pi / 6 * DENSITY
    down = [g / weight for g in gravity(case)] if weight else (0, 0, -1)
    walls = Walls(case, folder, window, WINDOWS, DEM_STEPS, longest, along) if moves else None
    slower = walls.fastest() * window / (WALL_STEP * min(d for _, d in beads)) if walls else 0
    if slower > 1:
        window /= slower
        walls = Walls(case, folder, window, WINDOWS, DEM_STEPS, longest, along)
    step = window / DEM_STEPS
    if walls:
        room = ROOM * max(sides)
        lower, upper = (tuple(x + sign * room for x in corner) for corner, sign in zip(walls.box(), (-1, 1)))
        sides = [b - a for a, b in zip(lower, upper)]
    create = "\n".join(f'if              "${{continued}} == 0" then "create_atoms 1 single {" ".join(f"{x:.12g}" for x in at)} units box" '
                       f'"set atom {n} diameter {d:.9g}"' for n, (at, d) in enumerate(beads, 1))
    (folder / "in.beads").write_text(SCRIPT.format(
        count=len(beads), name=name, boundary=" ".join("p" if axis in periodic else "f" for axis in range(3)), box=" ".join(f"{a:.12g} {b:.12g}" for a, b in zip(lower, upper)),
        skin=max(*(d for _, d in beads), max(sides) / BINS), create=create, density=DENSITY, stiffness=lightest / 2 * (math.pi / (CONTACT * step)) ** 2,
        walls=walls.lines if walls else "", step=step, weight=weight, down=" ".join(f"{x:.12g}" for x in down)))
    for made in ("C", "Cx", "Cy", "Cz", "V", f"mag({tutorials.liquid_name(case)})"):
        (case / "0" / made).unlink(missing_ok=True)
    file = folder / "case.yaml"
    file.write_text(json.dumps({
        "fluid": {"case": "fluid", "prepare": []}, "particles": {"script": "in.beads"},
        "bulk_grid": {"lower": lower, "upper": upper, "cells": [max(1, round(CELLS * s / max(sides))) for s in sides]},
        "coupling": {"window": window, "end_time": WINDOWS * window},
        "forces": [{"drag": "schiller_naumann"}, "pressure_gradient"]}, indent=1))
    return file, walls, min(d for _, d in beads)
