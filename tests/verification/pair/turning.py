# SPDX-License-Identifier: GPL-3.0-or-later
"""Fluid meshes that turn, with neutral beads in liquid that fills a closed vessel.

    square drum that turns as a whole, beads and water with it    they turn as one body
    disc of the mesh that turns in water at rest, cyclicAMI       nothing moves
    both on one rank of the fluid and on two
    plane interface at rest, on a face of the bulk grid            a bead crosses it as if it were not there

Usage: turning.py DEMVOF"""
import math

import numpy
from box_case import SIDES, BoxCase, Particle, command_line, particle_states, patch_name, scratch, vector
from record import Record

EDGE, OMEGA = 0.01, 10.0  # of a bulk cell, m; 1/s
INNER, OUTER, HEIGHT = 0.03, 0.05, 0.03  # of the vessel with a disc that turns, m
FORCES = [{"drag": "di_felice"}, "pressure_gradient", {"added_mass": 0.5}]


def foam_file(kind, text):
    return f"FoamFile {{ version 2.0; format ascii; class {kind}; object of_a_test; }}\n{text}\n"


def motion(text, centre):
    return foam_file("dictionary", "dynamicFvMesh dynamicMotionSolverFvMesh; motionSolverLibs (fvMotionSolvers);\nmotionSolver solidBody; "
                     f"{text} solidBodyMotionFunction rotatingMotion;\nrotatingMotionCoeffs {{ origin {vector(centre)}; axis (0 0 1); omega {OMEGA}; }}")


def fields(U, p_rgh, inside="uniform (0 0 0)"):
    """Files of 0.orig; patch -> type."""
    def boundary(types):
        return "boundaryField { " + " ".join(f"{patch} {{ type {entry}; }}" for patch, entry in types.items()) + " }"
    alpha = {patch: "cyclicAMI" if entry == "cyclicAMI" else "zeroGradient" for patch, entry in U.items()}
    return {"fluid/0.orig/U": foam_file("volVectorField", f"dimensions [0 1 -1 0 0 0 0];\ninternalField {inside};\n{boundary(U)}"),
            "fluid/0.orig/p_rgh": foam_file("volScalarField", f"dimensions [1 -1 -2 0 0 0 0];\ninternalField uniform 0;\n{boundary(p_rgh)}"),
            "fluid/0.orig/alpha.water": foam_file("volScalarField", f"dimensions [0 0 0 0 0 0 0];\ninternalField uniform 1;\n{boundary(alpha)}")}


def drum(demvof, name, window, *options):
    """The run, and the largest velocity of a bead against the drum's, over the rim's."""
    side, counts, end_time = 5 * EDGE, (10, 10, 4), 0.03
    middle = side / 2

    def turned(x, y):
        return (-OMEGA * (y - middle), OMEGA * (x - middle), 0)

    case = BoxCase(scratch(f"turning/{name}"), (side, side, 2 * EDGE), counts, (9, 9, 2), end_time, window, gravity=(0, 0, 0), margin=0.03,
                   tolerance=1e-12, relative_tolerance=0, dem_step=window / 20, forces=FORCES)
    wall = "movingWallVelocity; value uniform (0 0 0)"
    inside = [turned((i + 0.5) * side / 10, (j + 0.5) * side / 10) for _ in range(4) for j in range(10) for i in range(10)]
    patches = [patch_name(at) for at in SIDES]
    case.extra_files = fields(dict.fromkeys(patches, wall), dict.fromkeys(patches, "fixedFluxPressure; value uniform 0"),
                              f"nonuniform List<vector> ({' '.join(vector(u) for u in inside)})")
    case.extra_files["fluid/constant/dynamicMeshDict"] = motion("", (middle, middle, 0))
    case.sections = {"bulk_grid": {"lower": [-2 * EDGE, -2 * EDGE, 0], "upper": [7 * EDGE, 7 * EDGE, 2 * EDGE], "cells": [9, 9, 2]}}
    places = [(0.005 + 0.008 * i, 0.005 + 0.008 * j, 0.004 + 0.006 * k) for i in range(6) for j in range(6) for k in range(3)]
    case.particles = [Particle(at, 3e-3, 1000, velocity=turned(*at[:2]), spin=(0, 0, OMEGA)) for at in places]
    case.extra_files["particles/floor.stl"] = "solid floor\n" + "".join(
        "facet normal 0 0 -1\nouter loop\n" + "".join(f"vertex {x} {y} 0\n" for x, y in corners) + "endloop\nendfacet\n"
        for corners in (((0, 0), (0, side), (side, side)), ((0, 0), (side, side), (side, 0)))) + "endsolid floor\n"
    case.script_tail = ("fix floor all mesh/surface file floor.stl type 1 curvature 1e-5\n"
                        f"fix turn all move/mesh mesh floor rotate origin {middle} {middle} 0. axis 0. 0. 1. period {2 * math.pi / OMEGA:.15g}\n")
    run = case.run(demvof, *options)
    state = particle_states(run.folder)
    against = [v - turned(*at[:2]) for v, at in zip(state["velocity"], state["position"])]
    return run, numpy.abs(against).max() / (OMEGA * middle)


def disc_in_cylinder():
    """blockMeshDict of a cylinder whose inner part is a mesh of its own, zone rotor; both have 24 cells around."""
    points, blocks, edges, patches = [], [], [], {name: [] for name in ("inside", "outside", "rim", "floor", "lid")}
    place = {}
    for level, z in enumerate((0, HEIGHT)):
        for ring, radius in (("core", 0.54 * INNER), ("inside", INNER), ("outside", INNER), ("rim", OUTER)):
            for quarter in range(4):
                angle = (2 * quarter + 1) * math.pi / 4
                place[ring, quarter, level] = len(points)
                points.append((radius * math.cos(angle), radius * math.sin(angle), z))
                if ring != "core":
                    edges.append((ring, quarter, level, (radius * math.cos(angle + math.pi / 4), radius * math.sin(angle + math.pi / 4), z)))

    def block(zone, cells, corners):
        floor, lid = ([place[ring, quarter % 4, level] for ring, quarter in corners] for level in (0, 1))
        blocks.append(f"hex ({' '.join(map(str, floor + lid))}) {zone} ({' '.join(map(str, cells))}) simpleGrading (1 1 1)")
        patches["floor"].append(floor)
        patches["lid"].append(lid)

    block("rotor", (6, 6, 6), [("core", quarter) for quarter in (2, 3, 0, 1)])
    for q in range(4):
        block("rotor", (3, 6, 6), [("core", q), ("inside", q), ("inside", q + 1), ("core", q + 1)])
        block("stator", (5, 6, 6), [("outside", q), ("rim", q), ("rim", q + 1), ("outside", q + 1)])
        for ring in ("inside", "outside", "rim"):
            patches[ring].append([place[ring, (q + a) % 4, level] for a, level in ((0, 0), (1, 0), (1, 1), (0, 1))])
    arcs = " ".join(f"arc {place[ring, q, level]} {place[ring, (q + 1) % 4, level]} {vector(middle)}" for ring, q, level, middle in edges)
    kinds = {name: "wall" if name == "rim" else "patch" for name in patches}
    for one, other in (("inside", "outside"), ("outside", "inside")):
        kinds[one] = f"cyclicAMI; neighbourPatch {other}; transform noOrdering; matchTolerance 1e-4"
    boundary = "\n".join(f"{name} {{ type {kinds[name]}; faces ({' '.join('(' + ' '.join(map(str, f)) + ')' for f in faces)}); }}"
                         for name, faces in patches.items())
    text = (f"scale 1;\nvertices ({' '.join(vector(p) for p in points)});\nblocks ({' '.join(blocks)});\nedges ({arcs});\n"
            f"boundary ({boundary});\nmergePatchPairs ();")
    return foam_file("dictionary", text)


def disc(demvof, name, *options):
    """Largest speed of the water, and of a bead, over that of the disc's edge."""
    window = 1e-3
    case = BoxCase(scratch(f"turning/{name}"), (OUTER, OUTER, HEIGHT), (1, 1, 1), (10, 10, 3), 0.03, window, lower=(-OUTER, -OUTER, 0),
                   gravity=(0, 0, 0), tolerance=1e-12, relative_tolerance=0, dem_step=window / 20, forces=FORCES, momentum_judged=False)
    slides = {"inside": "cyclicAMI", "outside": "cyclicAMI"}
    others = ("rim", "floor", "lid")
    case.extra_files = fields({**slides, **dict.fromkeys(others, "slip")},
                              {**slides, **dict.fromkeys(others, "fixedFluxPressure; value uniform 0")})
    case.extra_files["fluid/constant/dynamicMeshDict"] = motion("cellZone rotor;", (0, 0, 0))
    case.extra_files["fluid/system/blockMeshDict"] = disc_in_cylinder()
    case.particles = [Particle((r * math.cos(2 * math.pi * a / around), r * math.sin(2 * math.pi * a / around), 0.006 + 0.008 * k), 3e-3, 1000)
                      for r, around in ((0, 1), (0.01, 5), (0.018, 9), (0.0275, 14), (0.036, 18), (0.0455, 22)) for a in range(around)
                      for k in range(3)]
    run = case.run(demvof, *options)
    speed = OMEGA * INNER
    return run, run.history["max_speed"].max() / speed, numpy.abs(particle_states(run.folder)["velocity"]).max() / speed


def in_two_halves(demvof, split):
    """Speed of a sinking bead that crosses the middle of a box, whose halves meet at a cyclicAMI or are one mesh, m/s."""
    side, cells = 4 * EDGE, 8
    case = BoxCase(scratch(f"turning/halves_{split}"), (side, side, side), 3 * (cells,), (4, 4, 4), 0.01, 1e-3, tolerance=1e-12,
                   relative_tolerance=0, dem_step=5e-5, forces=FORCES)
    case.particles = [Particle((0.021, 0.019, side / 2 + 0.002), 4e-3, 2500, velocity=(0, 0, -0.2))]
    if split:
        levels = (0, side / 2, side / 2, side)
        points = " ".join(vector((x, y, z)) for z in levels for x, y in ((0, 0), (side, 0), (side, side), (0, side)))
        blocks = " ".join(f"hex ({' '.join(str(first + i) for i in range(8))}) ({cells} {cells} {cells // 2}) simpleGrading (1 1 1)"
                          for first in (0, 8))
        walls = "(0 3 2 1) (12 13 14 15) " + " ".join(f"({a} {b} {b + 4} {a + 4})" for first in (0, 8)
                                                       for a, b in ((first + i, first + (i + 1) % 4) for i in range(4)))
        slides = "type cyclicAMI; transform noOrdering; neighbourPatch"
        case.extra_files = fields({"walls": "noSlip", "below": "cyclicAMI", "above": "cyclicAMI"},
                                  {"walls": "fixedFluxPressure; value uniform 0", "below": "cyclicAMI", "above": "cyclicAMI"})
        case.extra_files["fluid/system/blockMeshDict"] = foam_file(
            "dictionary", f"scale 1;\nvertices ({points});\nblocks ({blocks});\nedges ();\nboundary (walls {{ type wall; faces ({walls}); }}\n"
            f"below {{ {slides} above; faces ((4 5 6 7)); }} above {{ {slides} below; faces ((8 9 10 11)); }});\nmergePatchPairs ();")
    return numpy.linalg.norm(particle_states(case.run(demvof).folder)["velocity"][0])


def main():
    options = command_line()
    record = Record("turning", "Meshes that turn",
                    "Closed vessels full of water and neutral beads: a square drum whose mesh turns as a whole, everything in it as one "
                    "body; and a disc of the mesh that turns inside the rest (cyclicAMI) where water and beads are at rest.",
                    "tests/Alltest -- -R 'pair.turning$'")
    runs = []
    for ranks in (1, 2):
        run, against = drum(options.demvof, f"drum_{ranks}", 1e-3, "--fluid-ranks", str(ranks))
        runs.append(run)
        record.at_most(f"drum, fluid ranks {ranks}: fastest bead against the drum", against, 0.1)
        energy = run.history["kinetic_energy"]
        record.at_most(f"drum, fluid ranks {ranks}: kinetic energy of the water, lost", 1 - energy[-1] / energy[0], 0.006)
    for ranks in (1, 2):
        run, water, bead = disc(options.demvof, f"disc_{ranks}", "--fluid-ranks", str(ranks))
        runs.append(run)
        record.at_most(f"disc, fluid ranks {ranks}: fastest water, over the disc's edge", water, 8e-4)
        record.at_most(f"disc, fluid ranks {ranks}: fastest bead, over the disc's edge", bead, 2.5e-4)
    whole, halves = (in_two_halves(options.demvof, split) for split in (False, True))
    record.at_most("bead that crosses a plane interface on a face of the bulk grid: against a mesh without it", abs(halves / whole - 1), 1.2e-5)
    record.at_most("drum: momentum of the particles", max(run.results["conservation"]["momentum"] for run in runs[:2]), 3e-15)
    record.at_most("drum: liquid volume", max(run.results["conservation"]["liquid_volume"] for run in runs[:2]), 5e-14)
    record.at_most("disc: liquid volume, which a sliding interface keeps but nearly",
                   max(run.results["conservation"]["liquid_volume"] for run in runs[2:]), 1e-7)
    raise SystemExit(record.write())


main()
