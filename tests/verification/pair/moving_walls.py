# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls that move, on both sides of a pair: fluid meshes that go with them, surfaces in the particles' script."""
from box_case import Wall


def moving_wall():
    return {**Wall(), "U": "movingWallVelocity; value uniform (0 0 0)"}


def foam_file(kind, text):
    return f"FoamFile {{ version 2.0; format ascii; class {kind}; object of_a_test; }}\n{text}\n"


def mesh_motion(solver):
    return foam_file("dictionary", "dynamicFvMesh dynamicMotionSolverFvMesh; motionSolverLibs (fvMotionSolvers);\n" + solver)


def box_surface(lower, upper):
    """STL of a box."""
    points = [(x, y, z) for z in (lower[2], upper[2]) for y in (lower[1], upper[1]) for x in (lower[0], upper[0])]
    text = "solid box\n"
    for a, b, c, d in ((0, 1, 3, 2), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5), (4, 5, 7, 6)):
        for corners in ((a, b, c), (a, c, d)):
            vertices = "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*points[i]) for i in corners)
            text += f"facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n"
    return text + "endsolid box\n"


def walls_of_the_script(case, lower, upper, motion):
    """The same walls for the particles. motion: of LIGGGHTS's fix move/mesh; empty: they stand still."""
    case.extra_files["particles/box.stl"] = box_surface(lower, upper)
    case.script_tail = ("fix box all mesh/surface file box.stl type 1 curvature 1e-5\n"
                        "fix walls all wall/gran model hooke/stiffness tangential history mesh n_meshes 1 meshes box\n"
                        + (f"fix motion all move/mesh mesh box {motion}\n" if motion else ""))
