# SPDX-License-Identifier: GPL-3.0-or-later
"""As refusals_test.py: what a run would go through with, and nobody can have meant. `demvof check` refuses it, or says
beware where somebody may have meant it.

Usage: first_look_test.py DEMVOF FOLDER [NAMES]"""
import sys

from box_case import BoxCase, Inlet, Open, Particle
from refusals_test import FOLDER, PISTON, STL, box, judge, replaced

SCRIPT, SOLUTION, MESH = "particles/in.particles", "fluid/system/fvSolution", "fluid/system/blockMeshDict"
FIELDS = "fluid/0.orig/"
INTEGRATOR = "fix integrate all nve/sphere"
INSERTION = """fix one all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 0.001
fix mix all particledistribution/discrete 15485867 1 one 1.0
region above block 0.01 0.03 0.01 0.03 0.04 0.05 units box
fix rain all insert/pack seed 32452843 distributiontemplate mix vel constant 0 0 0 insert_every 10 overlapcheck yes all_in yes particles_in_region 10 region above
"""


def plane(name, z):
    return f"fix {name} all wall/gran model hooke/stiffness tangential history primitive type 1 zplane {z}\n"


def with_inserted_ghosts():
    case = box("insertion_of_ghost_liquid", script_tail=INSERTION, coupling={"phase_interchange": "volume_adding"})
    case.sides["z+"] = Open()
    return case.write()


def beads(name, places, velocity=(0, 0, 0), **more):
    case = BoxCase(FOLDER / name, upper=(0.04, 0.04, 0.06), fine=(4, 4, 6), bulk=(4, 4, 6), end_time=0.002, window=1e-3,
                   dem_step=1e-4, **more)
    case.particles = [Particle(place, 4e-3, 2500, velocity) for place in places]
    return case


TWO = [(0.01, 0.02, 0.02), (0.03, 0.02, 0.02)]


def edited(name, file, old, new, **more):
    return replaced(box(name, **more).write(), file, old, new)


def uniform(name, value):
    return edited(name, FIELDS + "alpha.water", "internalField uniform 1", f"internalField uniform {value}")


def listed(name, value):
    """One cell of a list has the value."""
    return edited(name, FIELDS + "alpha.water", "96 (1 ", f"96 ({value} ", level=0.03, level_in_cells=True)


def with_side(name, side, entry):
    case = box(name)
    case.sides[side] = entry
    return case.write()


def partly(name, script, tail=""):
    """The script's integrator moves the first bead of two."""
    return replaced(beads(name, TWO, script_tail=tail).write(), SCRIPT, INTEGRATOR, script)


def that_falls(name, **more):
    case = box(name, **more)
    case.end_time = 1
    return case.write()


def sieve():
    case = box("sieve_above_an_inlet", script_tail=plane("sieve", 0.012))
    case.end_time = 1
    case.sides.update({"z-": Inlet((0, 0, 0.1)), "z+": Open(1)})
    return case.write()


def in_half(name, places):
    """The mesh is the lower corner of the bulk grid, half as wide, open above."""
    case = beads(name, places)
    case.sides["z+"] = Open()
    return replaced(case.write(), MESH, "scale 1;", "scale 0.5;")


TRIALS = {
    "fraction_of_two": (lambda: uniform("fraction_of_two", 2), 2,
                        ["0.orig/alpha.water: internalField: 2 is not allowed", "from 0 to 1"]),
    "fraction_below_nothing": (lambda: uniform("fraction_below_nothing", -0.5), 2, ["internalField: -0.5 is not allowed"]),
    "fraction_rounded": (lambda: uniform("fraction_rounded", 1.0000001), 0, ["not: begins beyond"]),
    "fraction_above_one": (lambda: uniform("fraction_above_one", 1.005), 2, ["internalField: 1.005 is not allowed"]),
    "fraction_in_a_list": (lambda: listed("fraction_in_a_list", 1.5), 2, ["internalField: 1.5 is not allowed"]),
    "fraction_that_a_run_left": (lambda: listed("fraction_that_a_run_left", 1.003), 0,
                                 ["beware: alpha.water begins beyond [0, 1] by up to 0.003"]),
    "fraction_at_an_opening": (lambda: with_side("fraction_at_an_opening", "z+", Open(2)), 2,
                               ["boundaryField: zhigh: inletValue: 2 is not allowed"]),
    "fraction_at_an_inlet": (lambda: with_side("fraction_at_an_inlet", "z+", Inlet((0, 0, -0.1), -1)), 2,
                             ["boundaryField: zhigh: value: -1 is not allowed"]),
    "fraction_in_a_table": (lambda: with_side("fraction_in_a_table", "z+", {
        **Inlet((0, 0, -0.1)), "alpha.water": "uniformFixedValue; uniformValue table ((0 1) (5 1.5))"}), 2,
                            ["boundaryField: zhigh: uniformValue: 1.5 is not allowed"]),
    "no_liquid": (lambda: edited("no_liquid", "fluid/system/setFieldsDict", "box (-1 -1 -1)", "box (5 5 5)", level=0.03), 0,
                  ["beware: alpha.water is 0 everywhere", "there is no water in this run", "setFieldsDict"]),
    "bead_that_nothing_moves": (lambda: partly("bead_that_nothing_moves", "group some id 1\nfix integrate some nve/sphere"), 2,
                                ["nothing moves a sphere (id 2), which would hang in the fluid", "'fix hold GROUP freeze'"]),
    "bead_that_is_held": (lambda: partly("bead_that_is_held", "group some id 1\nfix integrate some nve/sphere\ngroup rest id 2\n"
                                         "fix hold rest freeze"), 0, []),
    "insertion_that_nothing_moves": (lambda: partly("insertion_that_nothing_moves", "group some id 1 2\n"
                                                    "fix integrate some nve/sphere", INSERTION), 2,
                                     ["nothing moves the spheres that fix rain insert/pack puts in"]),
    "insertion_that_is_moved": (lambda: box("insertion_that_is_moved", script_tail=INSERTION).write(), 2,
                                ["the fluid's box is closed"]),  # and no more
    "insertion_of_ghost_liquid": (with_inserted_ghosts, 2,
                                  ["puts particles in during the run, and coupling.phase_interchange is volume_adding"]),
    "waves_in_long_steps": (lambda: box("waves_in_long_steps", level=0.03, sigma=150).write(), 0,
                            ["beware: surface tension is explicit", "longer than 0.00073 s, and a step may have 0.001 s"]),
    "waves_in_short_steps": (lambda: box("waves_in_short_steps", level=0.03, sigma=75).write(), 0, ["not: surface tension is explicit"]),
    "bead_moved_twice": (lambda: box("bead_moved_twice", script_tail="fix again all nve/sphere\n").write(), 2,
                         ["fix integrate nve/sphere and fix again nve/sphere both move a sphere (id 1)"]),
    "bead_moved_and_carried": (lambda: box("bead_moved_and_carried", script_tail="fix carry all move linear 0 0 0.1\n").write(), 2,
                               ["fix integrate nve/sphere and fix carry move both move"]),
    "box_that_deforms": (lambda: box("box_that_deforms", script_tail="fix wide all deform 1 x vel 0.01\n").write(), 2,
                         ["fix wide deform: it changes the particles' box"]),
    "step_of_nothing": (lambda: edited("step_of_nothing", SCRIPT, "timestep 0.0001", "timestep 0"), 2,
                        ["timestep: 0 is not allowed", "not: nan"]),
    "plane_of_particles": (lambda: edited("plane_of_particles", SCRIPT, "units si", "units si\ndimension 2"), 2,
                           ["in.particles:2: 'dimension 2'", "spheres in space", "not: SIGSEGV"]),
    "beads_that_overlap": (lambda: beads("beads_that_overlap", [(0.02, 0.02, 0.02), (0.022, 0.02, 0.02)]).write(), 2,
                           ["particles 1 and 2 overlap by 0.002 m, 1 of the smaller one's radius"]),
    "beads_that_touch": (lambda: beads("beads_that_touch", [(0.02, 0.02, 0.02), (0.0235, 0.02, 0.02)]).write(), 0, []),
    "mesh_in_millimetres": (lambda: edited("mesh_in_millimetres", MESH, "scale 1;", "scale 0.001;"), 2,
                            ["no particle is in the fluid", "'scale' of blockMeshDict"]),
    "beads_beside_the_mesh": (lambda: in_half("beads_beside_the_mesh", [(0.01, 0.01, 0.01), (0.03, 0.03, 0.02), (0.03, 0.01, 0.02)]), 0,
                              ["beware: 67 % of the particles are beside the fluid's mesh"]),
    "beads_above_the_mesh": (lambda: in_half("beads_above_the_mesh", [(0.01, 0.01, 0.05)]), 0, ["not: beside the fluid's mesh"]),
    "forces_of_nothing": (lambda: box("forces_of_nothing", forces=[]).write(), 0, ["beware: forces names nothing"]),
    "bead_like_a_bullet": (lambda: beads("bead_like_a_bullet", [(0.02, 0.02, 0.02)], (500, 0, 0)).write(), 0,
                           ["beware: particle 1 has 500 m/s at the start, and crosses 50 bulk cells"]),
    "wall_of_the_script_inside": (lambda: box("wall_of_the_script_inside", script_tail=plane("shelf", 0.03)).write(), 0,
                                  ["beware: the script's wall shelf (zplane 0.03) stands inside"]),
    "floor_that_is_not_there": (lambda: that_falls("floor_that_is_not_there"), 0, ["fall out of the fluid", "no wall there"]),
    "sieve_above_an_inlet": (sieve, 0, ["not: stands inside", "not: fall out"]),
    "floor_that_is_too_low": (lambda: that_falls("floor_that_is_too_low", script_tail=plane("cellar", -0.02)), 0,
                              ["cellar, is at -0.02 m"]),
    "floor": (lambda: that_falls("floor", contacts=True), 0, ["not: fall out", "not: stands inside"]),
    "floor_not_reached": (lambda: box("floor_not_reached").write(), 0, ["not: fall out"]),
    "floor_of_triangles": (lambda: that_falls("floor_of_triangles", contacts=False, script_tail=PISTON.split("\n", maxsplit=1)[0]
                           + "\nfix table all wall/gran model hooke/stiffness tangential history mesh n_meshes 1 meshes piston\n",
                                              extra_files={"particles/p.stl": STL}), 0, ["not: fall out"]),
    "dimensions_of_U": (lambda: edited("dimensions_of_U", FIELDS + "U", "[0 1 -1 0 0 0 0]", "[0 1 -2 0 0 0 0]"), 2,
                        ["0.orig/U: dimensions [0 1 -2 0 0 0 0] are not those of U; give [0 1 -1 0 0 0 0]"]),
    "dimensions_of_U_beside_binary_fields": (lambda: edited("binary", FIELDS + "U", "[0 1 -1 0 0 0 0]", "[0 1 -2 0 0 0 0]", level=0.03), 2,
                                             ["0.orig/U: dimensions [0 1 -2 0 0 0 0] are not those of U"]),
    "dimensions_of_p_rgh": (lambda: edited("dimensions_of_p_rgh", FIELDS + "p_rgh", "[1 -1 -2 0 0 0 0]", "[0 2 -2 0 0 0 0]"), 2,
                            ["0.orig/p_rgh: dimensions [0 2 -2 0 0 0 0] are not those"]),
    "dimensions_of_alpha": (lambda: edited("dimensions_of_alpha", FIELDS + "alpha.water", "[0 0 0 0 0 0 0]", "[0 1 0 0 0 0 0]"), 2,
                            ["0.orig/alpha.water: dimensions [0 1 0 0 0 0 0] are not those"]),
    "dimensions_of_g": (lambda: edited("dimensions_of_g", "fluid/constant/g", "[0 1 -2 0 0 0 0]", "[0 1 -1 0 0 0 0]"), 2,
                        ["constant/g: dimensions [0 1 -1 0 0 0 0] are not those of g"]),
    "preconditioner": (lambda: edited("preconditioner", SOLUTION, "preconditioner DIC", "preconditioner DILU"), 2,
                       ["system/fvSolution:", "solvers: p_rgh: preconditioner: DILU is not known for symmetric matrices", "DIC"]),
    "smoother": (lambda: edited("smoother", SOLUTION, "smoother symGaussSeidel", "smoother smooth", pimple="momentumPredictor yes;"), 2,
                 ["system/fvSolution", "smoother", "GaussSeidel", "not: line -1"]),
    "solver": (lambda: edited("solver", SOLUTION, "solver PCG", "solver PCGG"), 2, ["system/fvSolution.solvers.pcorr.*, line 5", "PCGG", "not: line -1"]),
    "one_phase": (lambda: edited("one_phase", "fluid/constant/transportProperties", "(water air)", "(water)"), 2,
                  ["transportProperties:", "phases: 1 of them; give two"]),
}

if __name__ == "__main__":
    sys.exit(judge(TRIALS))
