# SPDX-License-Identifier: GPL-3.0-or-later
"""The output folder of a run, made by hand: a box of 4 x 2 x 4 OpenFOAM cells, liquid where z < 0.5 m, and two particles
or others."""
import json

import numpy

CELLS = (4, 2, 4)  # over a box of 1 x 0.5 x 1 m


def foam_file(path, kind, body):
    path.parent.mkdir(parents=True, exist_ok=True)
    header = f"FoamFile\n{{\n version 2.0;\n format ascii;\n class {kind};\n object {path.name};\n}}\n"
    path.write_text(header + body)


def write_mesh(folder):
    """A box of hexahedra in OpenFOAM's format: faces inside first, in the order of their owners."""
    nx, ny, nz = CELLS

    def point(i, j, k):
        return i + (nx + 1) * (j + (ny + 1) * k)

    def cell(i, j, k):
        return i + nx * (j + ny * k)

    points = [(i / nx, 0.5 * j / ny, k / nz) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    corners = {  # of the face towards lower and upper x, y, z of cell (0, 0, 0), normals outward
        (0, 0): [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)], (0, 1): [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)],
        (1, 0): [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)], (1, 1): [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)],
        (2, 0): [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)], (2, 1): [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]}
    inside, outside = [], []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                for axis in range(3):
                    for end in (0, 1):
                        step = [0, 0, 0]
                        step[axis] = 1 if end else -1
                        other = (i + step[0], j + step[1], k + step[2])
                        face = [point(i + a, j + b, k + c) for a, b, c in corners[axis, end]]
                        if all(0 <= n < size for n, size in zip(other, CELLS)):
                            if end:
                                inside.append((cell(i, j, k), cell(*other), face))
                        else:
                            outside.append((cell(i, j, k), face))
    inside.sort(key=lambda entry: entry[:2])
    faces = [face for _, _, face in inside] + [face for _, face in outside]
    owner = [first for first, _, _ in inside] + [first for first, _ in outside]
    mesh = folder / "constant" / "polyMesh"
    rows = lambda values: f"{len(values)}\n(\n" + "\n".join(values) + "\n)\n"  # noqa: E731
    foam_file(mesh / "points", "vectorField", rows([f"({x} {y} {z})" for x, y, z in points]))
    foam_file(mesh / "faces", "faceList", rows([f"4({' '.join(map(str, face))})" for face in faces]))
    foam_file(mesh / "owner", "labelList", rows([str(n) for n in owner]))
    foam_file(mesh / "neighbour", "labelList", rows([str(second) for _, second, _ in inside]))
    foam_file(mesh / "boundary", "polyBoundaryMesh",
              f"1\n(\n walls {{ type wall; nFaces {len(outside)}; startFace {len(inside)}; }}\n)\n")


def write_fluid(folder):
    write_mesh(folder)
    foam_file(folder / "system" / "controlDict", "dictionary", "startTime 0; endTime 0.2; deltaT 0.1; writeInterval 0.1;\n")
    foam_file(folder / "constant" / "g", "uniformDimensionedVectorField",
              "dimensions [0 1 -2 0 0 0 0];\nvalue (0 0 -9.81);\n")
    per_layer = CELLS[0] * CELLS[1]
    alpha = [1.0 if k < CELLS[2] / 2 else 0.0 for k in range(CELLS[2]) for _ in range(per_layer)]
    for time in ("0", "0.1", "0.2"):
        foam_file(folder / time / "alpha.water", "volScalarField",
                  f"dimensions [0 0 0 0 0 0 0];\ninternalField nonuniform List<scalar>\n{len(alpha)}\n(\n"
                  + "\n".join(map(str, alpha)) + "\n)\n;\nboundaryField { walls { type zeroGradient; } }\n")


TWO_PARTICLES = {time: [(1, (0.25, 0.26, 0.125), 0.02, (3, 0, 4)), (2, (0.75, 0.4, 0.5), 0.03, (time, 0, 0))]
                 for time in (0, 0.1, 0.2)}


def write_particles(folder, at=None):
    """at: time -> [(id, position, radius, velocity)]; else two particles, one on the mid-plane y = 0.25 m and one far
    from it."""
    folder.mkdir()
    entries = ""
    for i, (time, particles) in enumerate((at or TWO_PARTICLES).items()):
        name = f"particles_{i:06d}.vtp"
        entries += f'<DataSet timestep="{time}" file="{name}"/>'
        columns = [" ".join(str(x) for row in column for x in numpy.atleast_1d(row)) for column in zip(*particles)]
        array = lambda name, kind, size, text: (  # noqa: E731
            f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{size}" format="ascii">{text}</DataArray>')
        (folder / name).write_text(
            f'<VTKFile type="PolyData" version="0.1"><PolyData><Piece NumberOfPoints="{len(particles)}" NumberOfVerts="0" '
            'NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0"><PointData>' + array("id", "Int64", 1, columns[0])
            + array("radius", "Float64", 1, columns[2]) + array("velocity", "Float64", 3, columns[3])
            + "</PointData><Points>" + array("Points", "Float64", 3, columns[1]) + "</Points></Piece></PolyData></VTKFile>")
    (folder / "particles.pvd").write_text(f'<VTKFile type="Collection" version="0.1"><Collection>{entries}'
                                          "</Collection></VTKFile>")


RESULTS = {"status": "completed", "version": "1.2.3", "configuration_hash": "abc", "command": "foam_side case.yaml",
           "configuration": {"coupling": {"end_time": 0.2, "window": 1e-3}, "bulk_grid": {"lower": [0, 0, 0]},
                             "output": {"pictures": [0, 0.2]}},
           "machine": {"cpu": "a processor", "cores": 2}, "ranks": {"fluid": 1, "particles": 1},
           "wall_seconds": {"total": 200, "fluid": 150, "particles": 30, "exchange": 2, "waiting": 180},
           "peak_memory_bytes": {"fluid": 2e8, "particles": 1e8}, "steps": {"windows": 200, "fluid": 200, "particles": 2000},
           "cells": {"fine_min": 32, "fine_max": 32, "bulk": 4, "bulk_active_max": 2},
           "particles": {"initial": 2, "inserted": 0, "left": 0, "lost": 0, "final": 2},
           "conservation": {"exchange": 1e-16, "momentum": None, "solid_volume": 0, "liquid_volume": 2e-9},
           "scene": [{"decision": "surface tension", "on": False, "reason": "There is <none>."}],
           "quantities": {"liquid_front": 0.5}, "warnings": []}


def write_run(folder, particles=None, **changes):
    """particles: as write_particles takes them; changes: of RESULTS."""
    folder.mkdir(parents=True)
    write_fluid(folder / "fluid")
    write_particles(folder / "particles", particles)
    (folder / "history.csv").write_text("time,liquid_front,liquid_volume\n# s,m,m3\n0,0.1,0.25\n0.1,0.3,0.25\n0.2,0.5,0.25\n")
    (folder / "results.json").write_text(json.dumps({**RESULTS, **changes}))
    return folder
