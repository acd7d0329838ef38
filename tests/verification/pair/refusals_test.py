# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pair cannot do is refused by `demvof check`, with the reason and what to do: exit code 2, before anything
starts. And what only looks as if it could not be done is accepted.

Usage: refusals_test.py DEMVOF FOLDER [NAMES]"""
import pathlib
import shutil
import subprocess
import sys

from box_case import BoxCase, Cyclic, Open, Particle, Wall
from clumps import with_clumps

DEMVOF, FOLDER, NAMES = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]

HEADER = "FoamFile {{ version 2.0; format ascii; class dictionary; object {}; }}\n"
STL = ("solid p\nfacet normal 0 0 1\nouter loop\nvertex 0.01 0.01 0.03\nvertex 0.02 0.01 0.03\nvertex 0.01 0.02 0.03\n"
       "endloop\nendfacet\nendsolid p\n")
PISTON = "fix piston all mesh/surface file p.stl type 1\nfix push all move/mesh mesh piston linear 0.5 0 0\n"
BELT = "fix belt all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0.0 shear x 0.1\n"
SHAKEN = HEADER.format("dynamicMeshDict") + """dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (fvMotionSolvers);
solver solidBody;
solidBodyMotionFunction oscillatingLinearMotion;
oscillatingLinearMotionCoeffs { amplitude (0.01 0 0); omega 10; }
"""
BODY = HEADER.format("dynamicMeshDict") + """dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (sixDoFRigidBodyMotion);
motionSolver sixDoFRigidBodyMotion;
sixDoFRigidBodyMotionCoeffs { patches (xlow); innerDistance 0.005; outerDistance 0.01; mass 1; centreOfMass (0 0 0); momentOfInertia (1 1 1);
    accelerationRelaxation 1; solver { type Newmark; } }
"""
DISPLACEMENT = HEADER.format("pointDisplacement").replace("dictionary", "pointVectorField") + """dimensions [0 1 0 0 0 0 0];
internalField uniform (0 0 0);
boundaryField { ".*" { type calculated; } }
"""
REFINES = HEADER.format("dynamicMeshDict") + """dynamicFvMesh dynamicRefineFvMesh;
refineInterval 1; field magU; lowerRefineLevel 0.1; upperRefineLevel 0.9; unrefineLevel 10; nBufferLayers 1;
maxRefinement 1; maxCells 10000; correctFluxes ((phi none)); dumpLevel false;
"""
ROTATING = HEADER.format("MRFProperties") + "zone { cellZone z; active yes; origin (0 0 0); axis (0 0 1); omega 1; }\n"


def box(name, **more):
    return BoxCase(FOLDER / name, upper=(0.04, 0.04, 0.06), fine=(4, 4, 6), bulk=(4, 4, 6), end_time=0.002, window=1e-3,
                   dem_step=1e-4, particles=[Particle((0.02, 0.02, 0.02), 4e-3, 2500)], **more)


def replaced(case_file, name, old, new):
    path = case_file.parent / name
    text = path.read_text()
    assert old in text, f"{old!r} is not in {path}"
    path.write_text(text.replace(old, new, 1))
    return case_file


def with_processors():
    return replaced(box("ranks").write(), "particles/in.particles", "newton off", "newton off\nprocessors 2 2 1")


def with_style(name, old, new):
    return replaced(box(name).write(), "particles/in.particles", old, new)


def without_pimple():
    case = box("no_pimple")
    case.sides["z+"] = Open()
    return replaced(case.write(), SOLUTION, "PIMPLE", "PIMPL")


def with_time_scheme():
    return replaced(box("time_scheme").write(), "fluid/system/fvSchemes", "Euler", "CrankNicolson 0.9")


def with_zone():
    case_file = box("rotating_zone", extra_files={"fluid/constant/MRFProperties": ROTATING}).write()
    return replaced(case_file, "fluid/system/blockMeshDict", "hex (0 1 2 3 4 5 6 7)", "hex (0 1 2 3 4 5 6 7) z")


def with_slope():
    case = box("slope", gravity=(1, 0, -9.81))
    case.sides.update({"x-": Cyclic(), "x+": Cyclic()})
    return case.write()


def pushed(name, unseen):
    return box(name, script_tail=PISTON, extra_files={"particles/p.stl": STL}, sections={"particles": {"unseen_surfaces": unseen}}).write()


def with_drum(omega):
    """The velocity of a wall is what its condition gives, at the start or later, not the 'value' beside it."""
    case = box(f"drum_{omega[0]}", script_tail=PISTON, extra_files={"particles/p.stl": STL})
    case.sides["x-"] = {**Wall(), "U": "rotatingWallVelocity; origin (0 0 0); axis (1 0 0); "
                              f"omega {omega}; value uniform (0 0 0)"}
    return case.write()


def with_baffle(x):
    """A wall across the box."""
    dictionary = HEADER.format("createBafflesDict") + f"""internalFacesOnly true;
baffles {{ wall {{ type searchableSurface; surface searchablePlate; origin ({x} 0 0); span (0 0.04 0.06);
patches {{ master {{ type wall; name xlow; patchFields {{}} }} slave {{ $master; }} }} }} }}
"""
    case = box(f"baffle_{x}", prepare=["blockMesh", "createBaffles -overwrite"],
               extra_files={"fluid/system/createBafflesDict": dictionary})
    case.fine = (8, 8, 12)
    return case.write()


def with_clumps_on_two_ranks():
    return with_clumps(box("clumps", sections={"particles": {"ranks": 2}}), 2500, [(0.02, 0.02, 0.03)], 1e-5).write()


def with_held_clump():
    case = with_clumps(box("held_clump"), 2500, [(0.02, 0.02, 0.03)], 1e-5)
    return replaced(case.write(), "particles/in.particles", "fix floor", "fix hold all freeze\nfix floor")


def with_library():
    return replaced(box("library").write(), "fluid/system/controlDict", "startTime 0", 'libs ("libfieldFunctionObjects.so"); startTime 0')


def with_sources(name, options):
    return box(name, extra_files={"fluid/constant/fvOptions": HEADER.format("fvOptions") + options}).write()


def source(kind, entries, extra="selectionMode all;"):
    return f"s {{ type {kind}; {extra} {entries} }}\n"


def that_refines(name, **more):
    return box(name, sections={"fluid": {"refinement": {"levels": 1}, **more.pop("fluid", {})}}, **more)


def with_source_at_points():
    options = HEADER.format("fvOptions") + source("vectorSemiImplicitSource", RATES + " { U ((1 0 0) 0); }",
                                                  "selectionMode points; points ((0.02 0.02 0.02));")
    return that_refines("points", extra_files={"fluid/constant/fvOptions": options}).write()


def with_cyclic_ends(axis):
    """Two ranks that refine, cut along x."""
    case = that_refines(f"cyclic_{axis}", fluid={"ranks": 2})
    case.sides.update({axis + "-": Cyclic(), axis + "+": Cyclic()})
    return case.write()


def with_gradient_of_each_cell():
    """What it keeps is its own. It divides by the speed at its faces, so that the fluid flows at the start."""
    zone = HEADER.format("topoSetDict") + """actions (
    { name f; type faceSet; action new; source boxToFace; box (0.019 0 0) (0.021 1 1); }
    { name f; type faceZoneSet; action new; source setToFaceZone; faceSet f; }
    { name c; type cellZoneSet; action new; source boxToCell; box (0.02 0 0) (0.03 1 1); } );
"""
    options = source("directionalPressureGradientExplicitSource",
                     "model constant; pressureDrop 1; flowDir (1 0 0); faceZone f; fields (U);",
                     "selectionMode cellZone; cellZone c;")
    return box("gradients", velocity=(0.01, 0, 0), prepare=["blockMesh", "topoSet"],
               extra_files={"fluid/system/topoSetDict": zone, "fluid/constant/fvOptions": HEADER.format("fvOptions") + options}).write()


RATES = "volumeMode specific; injectionRateSuSp"
SOLUTION, CONTROL, TRANSPORT = "fluid/system/fvSolution", "fluid/system/controlDict", "fluid/constant/transportProperties"
SCHEMES = "fluid/system/fvSchemes"
# name: (file, what stands there, what in its place, what has to be said): numbers that check once called ready
NUMBERS = {
    "outer_correctors": (SOLUTION, "nOuterCorrectors 1", "nOuterCorrectors -1", ["fvSolution:", "PIMPLE: nOuterCorrectors: -1", "of 1 or more"]),
    "correctors": (SOLUTION, "nCorrectors 3", "nCorrectors 0", ["PIMPLE: nCorrectors: 0 is not allowed"]),
    "given_flow": (SOLUTION, "nCorrectors 3; nNonOrthogonalCorrectors 0", "nCorrectors -1; nNonOrthogonalCorrectors -1",
                   ["PIMPLE: nCorrectors: -1", "a flow that is given"]),
    "relaxed_to_nothing": (SOLUTION, "PIMPLE", "relaxationFactors { equations { U 0; } }\nPIMPLE",
                           ["relaxationFactors: equations: U: 0 is not allowed", "above 0 and at most 1"]),
    "relaxed_beyond": (SOLUTION, "PIMPLE", "relaxationFactors { fields { \".*\" 1.5; } }\nPIMPLE", ["relaxationFactors: fields: .*: 1.5"]),
    "alpha_correctors": (SOLUTION, "nAlphaCorr 1", "nAlphaCorr 0", ["alpha.water: nAlphaCorr: 0 is not allowed"]),
    "alpha_steps": (SOLUTION, "nAlphaSubCycles 1", "nAlphaSubCycles 0", ["alpha.water: nAlphaSubCycles: 0"]),
    "compression": (SOLUTION, "cAlpha 1", "cAlpha -1", ["alpha.water: cAlpha: -1", "of 0 or more"]),
    "no_p_rghFinal": (SOLUTION, "p_rghFinal", "p_other", ["solvers: p_rghFinal is missing", "$p_rgh"]),
    "no_pcorr": (SOLUTION, "\"pcorr.*\"", "pcorrFinal", ["solvers: pcorr is missing"]),
    "no_pcorrFinal": (SOLUTION, "\"pcorr.*\"", "pcorr", ["pcorrFinal"]),
    "no_UFinal": (SOLUTION, "\"U.*\"", "U", []),  # nor needed
    "no_convection_scheme": (SCHEMES, "div(rhoPhi,U)", "div(phi,U)", ["fvSchemes.divSchemes, line", "div(rhoPhi,U)"]),
    "unknown_scheme": (SCHEMES, "default Gauss linear; }", "default Gauss linaer; }", ["fvSchemes.gradSchemes", "linaer"]),
    "predicted_without_UFinal": (SOLUTION, "\"U.*\"", "U", ["solvers: UFinal is missing", "momentumPredictor is on"]),
    "courant": (CONTROL, "maxCo 0.5", "maxCo 0", ["controlDict:", "maxCo: 0 is not allowed", "above 0"]),
    "courant_of_surface": (CONTROL, "maxAlphaCo 0.5", "maxAlphaCo -1", ["maxAlphaCo: -1"]),
    "longest_step": (CONTROL, "maxDeltaT 1000000000.0", "maxDeltaT 0", ["maxDeltaT: 0"]),
    "step": (CONTROL, "deltaT 0.001", "deltaT 0", ["controlDict:", "deltaT: 0 is not allowed", "(s)"]),
    "viscosity": (TRANSPORT, "nu 9.9999999999999995e-07", "nu -1", ["transportProperties:", "nu: -1 is not allowed"]),
    "density": (TRANSPORT, "rho 1000", "rho -1000", ["rho: -1000 is not allowed"]),
    "tension": (TRANSPORT, "sigma 0", "sigma -0.07", ["sigma: -0.07 is not allowed"]),
}


def with_number(name):
    file, old, new, _ = NUMBERS[name]
    pimple = "momentumPredictor yes;" if name.startswith("predicted") else ""
    return replaced(box(name, pimple=pimple).write(), file, old, new)


# name: (how the case is made, exit code, what has to be said, or not)
def shaken(name, motion=None, displacement=False, **keys):
    """A mesh that moves, with walls that know it."""
    case = box(name, **keys)
    case.extra_files["fluid/constant/dynamicMeshDict"] = motion or SHAKEN
    if displacement:
        case.extra_files.update({"particles/p.stl": STL, "fluid/0.orig/pointDisplacement": DISPLACEMENT})
    for side in case.sides.values():
        if side["type"] == "wall":
            side["U"] = "movingWallVelocity; value uniform (0 0 0)"
    return case.write()


TRIALS = {
    "ranks_of_the_script": (with_processors, 2,
                            ["in.particles:", "'processors 2 2 1'", "particles.ranks"]),
    "name_of_another_coupling": (lambda: box("dragforce", script_tail="compute d all reduce sum f_dragforce[1]\n").write(), 2,
                                 ["in.particles:", "f_dragforce[1]", "CFDEMcoupling", "'forces'"]),
    "pair_style_of_an_older_version": (lambda: with_style("pair_style", "gran model hooke/stiffness tangential history",
                                                          "gran/hertz/history 1e5 NULL 500 NULL 0.5 1"), 2,
                                       ["in.particles:", "has no pair_style 'gran/hertz/history'",
                                        "'pair_style gran model hertz tangential history'"]),
    "atom_style_that_is_not_built": (lambda: with_style("atom_style", "atom_style granular", "atom_style superquadric"), 2,
                                     ["in.particles:2: 'atom_style superquadric'", "shape is left out", "'atom_style granular'"]),
    "clumps_on_two_ranks": (with_clumps_on_two_ranks, 2, ["fix move multisphere", "one rank only", "particles.ranks: 1"]),
    "clump_that_is_held": (with_held_clump, 2, ["fix hold freeze", "LIGGGHTS moves clumps as if it were not there"]),
    "wall_that_moves_on_one_side": (lambda: box("piston", script_tail=PISTON, extra_files={"particles/p.stl": STL}).write(), 2,
                                    ["fix push (move/mesh)", "no wall of the fluid moves", "rotatingWallVelocity"]),
    "wall_that_shears_on_one_side": (lambda: box("shearing", contacts=True, script_tail=BELT).write(), 2,
                                     ["fix belt (wall/gran", "no wall of the fluid moves"]),
    "surface_that_the_fluid_does_not_see": (lambda: pushed("sieve", ["push"]), 0, ["The fluid does not see what fix push moves"]),
    "surface_that_does_not_move": (lambda: pushed("floor", ["floor"]), 2, ["unseen_surfaces: floor: no fix of this name", "it has push"]),
    "wall_that_moves_on_both": (lambda: with_drum("1"), 0, []),
    "wall_that_moves_later": (lambda: with_drum("table ((0 0) (1 1))"), 0, []),
    "mesh_that_moves": (lambda: box("mesh", extra_files={"fluid/constant/dynamicMeshDict": SHAKEN}).write(), 2,
                        ["wall xlow moves with the mesh", "movingWallVelocity does"]),
    "mesh_that_moves_on_one_side": (lambda: shaken("mesh_alone"), 2, ["walls of the fluid's mesh move", "fix move/mesh"]),
    "mesh_that_moves_on_both": (lambda: shaken("mesh_and_script", script_tail=PISTON, extra_files={"particles/p.stl": STL}), 0, []),
    "body_that_the_flow_moves": (lambda: shaken("body", motion=BODY, script_tail=PISTON, displacement=True), 2,
                                 ["constant/dynamicMeshDict", "no surface of the script can follow them"]),
    "mesh_that_moves_in_each_corrector": (lambda: shaken("correctors", pimple="moveMeshOuterCorrectors yes;"), 2,
                                          ["moveMeshOuterCorrectors", "once a step"]),
    "flow_that_is_given": (lambda: box("given", pimple="nCorrectors -1; nNonOrthogonalCorrectors -1; frozenFlow yes;").write(), 2,
                           ["a flow that is given takes no momentum from particles"]),
    "mesh_that_refines_itself": (lambda: box("refines", extra_files={"fluid/constant/dynamicMeshDict": REFINES}).write(), 2,
                                 ["dynamicRefineFvMesh refines by magU", "fluid.refinement"]),
    "zone_that_rotates": (with_zone, 2, ["MRFProperties", "remove the file"]),
    "time_scheme": (with_time_scheme, 2, ["ddtSchemes", "with particles Euler only"]),
    "slope_along_a_periodic_direction": (with_slope, 0, ["along x, where the mesh is periodic", "meanVelocityForce"]),
    "wall_inside_bulk_cells": (lambda: with_baffle(0.015), 0, ["24 bulk cells have fluid on both sides"]),
    "wall_between_bulk_cells": (lambda: with_baffle(0.02), 0, ["not: both sides"]),
    "library_in_controlDict": (with_library, 0, []),
    "source_of_a_field_nobody_solves": (lambda: with_sources("nobody", source("vectorSemiImplicitSource", RATES + " { V ((1 0 0) 0); }")), 2,
                                        ["constant/fvOptions:", "s (vectorSemiImplicitSource)", "would do nothing to V", "act on U alone"]),
    "source_of_alpha": (lambda: with_sources("alpha", source("scalarSemiImplicitSource", RATES + " { alpha.water (1 0); }")), 2,
                        ["s (scalarSemiImplicitSource)", "would do nothing to alpha.water"]),
    "source_of_another_kind": (lambda: with_sources("kind", source("scalarSemiImplicitSource", RATES + " { U (1 0); }")), 2,
                               ["would do nothing to U", "of its kind"]),
    "source_that_is_not_active": (lambda: with_sources("inactive", source("vectorSemiImplicitSource", "active no; " + RATES + " { V ((1 0 0) 0); }")),
                                  0, []),
    "source_whose_cells_change": (with_source_at_points, 2, ["s (vectorSemiImplicitSource)", "all or cellZone"]),
    "refinement_of_cyclic_ends_on_two_ranks": (lambda: with_cyclic_ends("x"), 2, ["xlow and xhigh lie on different ranks", "preservePatches"]),
    "refinement_beside_cyclic_ends": (lambda: with_cyclic_ends("y"), 0, ["cells stay on their ranks"]),
    "source_that_cannot_be_continued": (with_gradient_of_each_cell, 0, ["beware: constant/fvOptions:", "the run cannot be continued"]),
    "no_pimple": (without_pimple, 0, ["fvSolution has no PIMPLE", "nCorrectors 1"]),
    **{name: (lambda name=name: with_number(name), 2 if words else 0, [*words, "not: demvof-check"]) for name, (*_, words) in NUMBERS.items()},
}


def judge(trials):
    wrong = 0
    for name, (make, code, words) in trials.items():
        if NAMES and name not in NAMES:
            continue
        check = subprocess.run([DEMVOF, "check", make()], capture_output=True, text=True, timeout=120, check=False)
        said = " ".join((check.stdout + check.stderr).split())
        missing = [word for word in words if (word.removeprefix("not: ") in said) == word.startswith("not: ")]
        good = check.returncode == code and not missing
        wrong += not good
        print(f"{name}: {'as it should be' if good else f'code {check.returncode}, not {code}; not said: {missing}; said: {said[-600:]}'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(judge(TRIALS))
