# SPDX-License-Identifier: GPL-3.0-or-later
"""LIGGGHTS's public tutorials as the package liggghts-doc ships them, their runs shortened, in a box of water."""
import json
import pathlib
import re
import shutil

PUBLIC = pathlib.Path("/usr/share/doc/liggghts/examples/LIGGGHTS/Tutorials_public")
WINDOWS, DEM_STEPS = 5, 20  # of the coupled run; DEM steps in a window
SETTLING = 200              # DEM steps that remain of each `run` before it
CELLS = 8                   # bulk cells along the longest side

HEADER = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"


def tutorials():
    """name -> script. Other programs' (ParScale) are not LIGGGHTS's alone."""
    scripts = sorted(path for path in PUBLIC.glob("*/in.*"))
    return {f"LIGGGHTS/{path.parent.name}/{path.name}": path for path in scripts}


def commands(text):
    return [line.split() for line in text.splitlines() if line.split() and not line.lstrip().startswith("#")]


def box_of(text, folder):
    """Corners of the simulation box."""
    lines = commands(text)
    made = next((words for words in lines if words[0] == "create_box"), None)
    if made:
        region = next(words for words in lines if words[:2] == ["region", made[2]])
        numbers = [float(word) for word in region[3:9]]
        return numbers[0::2], numbers[1::2]
    data = next(words[1] for words in lines if words[0] == "read_data")
    ends = [re.search(rf"^\s*(\S+)\s+(\S+)\s+{axis}lo\s+{axis}hi", (folder / data).read_text(), re.M) for axis in "xyz"]
    return [float(end[1]) for end in ends], [float(end[2]) for end in ends]


def time_step(text):
    value = next(words[1] for words in commands(text) if words[0] == "timestep")
    named = re.fullmatch(r"\$\{?(\w+)\}?", value)
    if named:
        value = next(words[3] for words in commands(text) if words[:2] == ["variable", named[1]])
    return float(value)


def gravity(text):
    words = next((w for w in commands(text) if w[0] == "fix" and w[3] == "gravity"), None)
    if not words:
        return [0.0, 0.0, 0.0]
    direction = [float(word) for word in words[6:9]]
    length = sum(d * d for d in direction) ** 0.5
    return [float(words[4]) * d / length for d in direction]


def shorten(text):
    """The runs before the last one short; the last, which was the simulation, is the coupled run's."""
    lines = text.splitlines()
    runs = [n for n, line in enumerate(lines) if re.match(r"\s*run\s", line)]
    for n in runs[:-1]:
        lines[n] = f"run {SETTLING}" if lines[n].split()[1] not in ("0", "1") else lines[n]
    return "\n".join(lines[:runs[-1]] if runs else lines) + "\n"


def block_mesh(lower, upper, cells):
    x, y, z = zip(lower, upper)
    corners = [(x[i], y[j], z[k]) for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    points = " ".join(f"({a} {b} {c})" for a, b, c in corners)
    return (HEADER.format("dictionary", "blockMeshDict") + f"scale 1;\nvertices ({points});\n"
            f"blocks (hex (0 1 2 3 4 5 6 7) ({cells[0]} {cells[1]} {cells[2]}) simpleGrading (1 1 1));\nedges ();\n"
            "boundary\n(\n    walls { type wall; faces ((0 3 2 1) (0 1 5 4) (1 2 6 5) (2 3 7 6) (3 0 4 7)); }\n"
            "    top { type patch; faces ((4 5 6 7)); }\n);\nmergePatchPairs ();\n")


def field(name, kind, dimensions, inside, walls, top):
    return (HEADER.format(kind, name) + f"dimensions {dimensions};\ninternalField uniform {inside};\n"
            f"boundaryField {{ walls {{ {walls} }} top {{ {top} }} }}\n")


def write_water(folder, lower, upper, cells, weight):
    """An interFoam case: the box full of water, open at the top."""
    for part in ("0", "constant", "system"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    zero = "(0 0 0)"
    files = {
        "0/U": field("U", "volVectorField", "[0 1 -1 0 0 0 0]", zero, "type noSlip;",
                     f"type pressureInletOutletVelocity; value uniform {zero};"),
        "0/p_rgh": field("p_rgh", "volScalarField", "[1 -1 -2 0 0 0 0]", 0, "type fixedFluxPressure; value uniform 0;",
                         "type totalPressure; p0 uniform 0; value uniform 0;"),
        "0/alpha.water": field("alpha.water", "volScalarField", "[0 0 0 0 0 0 0]", 1, "type zeroGradient;",
                               "type inletOutlet; inletValue uniform 1; value uniform 1;"),
        "constant/g": HEADER.format("uniformDimensionedVectorField", "g") + "dimensions [0 1 -2 0 0 0 0];\n"
                      f"value ({' '.join(map(str, weight))});\n",
        "constant/turbulenceProperties": HEADER.format("dictionary", "turbulenceProperties") + "simulationType laminar;\n",
        "constant/transportProperties": HEADER.format("dictionary", "transportProperties") + "phases (water air);\n"
            "water { transportModel Newtonian; nu 1e-6; rho 1000; }\nair { transportModel Newtonian; nu 1.5e-5; rho 1.2; }\n"
            "sigma 0.07;\n",
        "system/blockMeshDict": block_mesh(lower, upper, cells),
        "system/controlDict": HEADER.format("dictionary", "controlDict") + "application interFoam; startFrom startTime; "
            "startTime 0; stopAt endTime; endTime 1; deltaT 1e-4; writeControl timeStep; writeInterval 1000;\n"
            "adjustTimeStep yes; maxCo 0.3; maxAlphaCo 0.3; maxDeltaT 1;\n",
        "system/fvSchemes": HEADER.format("dictionary", "fvSchemes") + "ddtSchemes { default Euler; }\n"
            "gradSchemes { default Gauss linear; }\nlaplacianSchemes { default Gauss linear corrected; }\n"
            "divSchemes { div(rhoPhi,U) Gauss upwind; div(phi,alpha) Gauss vanLeer; div(phirb,alpha) Gauss linear; "
            "div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear; }\ninterpolationSchemes { default linear; }\n"
            "snGradSchemes { default corrected; }\n",
        "system/fvSolution": HEADER.format("dictionary", "fvSolution") + 'solvers { "alpha.water.*" { nAlphaCorr 1; '
            'nAlphaSubCycles 1; cAlpha 1; }\n"(p_rgh|pcorr).*" { solver PCG; preconditioner DIC; tolerance 1e-9; relTol 0; }\n'
            '"U.*" { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-8; relTol 0; } }\n'
            "PIMPLE { momentumPredictor no; nCorrectors 2; nNonOrthogonalCorrectors 0; }\n",
    }
    for name, text in files.items():
        (folder / name).write_text(text)


def prepare(script, folder, unseen=()):
    """A case file of the tutorial in water. unseen: fixes that move surfaces, which the water's box does not have."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(script.parent, folder / "particles")
    (folder / "particles" / "post").mkdir(exist_ok=True)
    text = script.read_text()
    lower, upper = box_of(text, script.parent)
    sides = [b - a for a, b in zip(lower, upper)]
    cells = [max(1, round(CELLS * side / max(sides))) for side in sides]
    write_water(folder / "fluid", lower, upper, cells, gravity(text))
    (folder / "particles" / script.name).write_text(shorten(text))
    window = DEM_STEPS * time_step(text)
    file = folder / "case.yaml"
    file.write_text(json.dumps({
        "fluid": {"case": "fluid", "prepare": ["blockMesh"]}, "particles": {"script": f"particles/{script.name}", "unseen_surfaces": list(unseen)},
        "bulk_grid": {"lower": lower, "upper": upper, "cells": cells},
        "coupling": {"window": window, "end_time": WINDOWS * window},
        "forces": [{"drag": "schiller_naumann"}, "pressure_gradient"]}))
    return file
