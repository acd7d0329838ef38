# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls that move, of a tutorial whose mesh moves as prescribed: surfaces for LIGGGHTS, and fix move/mesh that follows them.

moveDynamicMesh of the distribution says where the mesh is after each window. What is rigid there (a patch, or the part of one
that belongs to a paddle of a wave maker) becomes a surface, whose motion from window to window is a velocity and an angular velocity
about a point that goes along: linear/variable and three rotate/variable.
"""
import gzip
import math
import re
import shutil

import tutorials
from tutorials import Failed

LOOKED_AT = 200  # corners of a surface, at most

SURFACE = """\
fix             mesh{n} all mesh/surface file wall{n}.stl type 1 heal auto_remove_duplicates curvature 1e-5 curvature_tolerant yes
fix             move{n} all move/mesh mesh mesh{n} linear/variable v_wall{n}x v_wall{n}y v_wall{n}z
{turns}"""
TURN = "fix             turn{n}{axis} all move/mesh mesh mesh{n} rotate/variable origin {origin} axis {way} omega v_turn{n}{axis}\n"


def text_of(folder, name):
    packed = folder / f"{name}.gz"
    return gzip.decompress(packed.read_bytes()).decode() if packed.exists() else (folder / name).read_text()


def vectors(text):
    return [tuple(map(float, numbers)) for numbers in re.findall(r"\(([-+.\deE]+) ([-+.\deE]+) ([-+.\deE]+)\)", text)]


def faces_of(mesh):
    """Name of each patch and the groups that it is in -> its faces, as numbers of points."""
    faces = [list(map(int, numbers.split())) for numbers in re.findall(r"\d+\(([\d ]+)\)", text_of(mesh, "faces").split("object", 1)[1])]
    boundary = text_of(mesh, "boundary")
    found = {}
    for name, entry in re.findall(r"(\w+)\s*\{([^{}]*)\}", boundary.split("object", 1)[1]):
        start, count = (int(tutorials.entry(entry, key)) for key in ("startFace", "nFaces"))
        groups = re.findall(r"\w+", tutorials.entry(entry, "inGroups", "").partition("(")[2])
        found[name, tutorials.entry(entry, "type"), *groups] = faces[start:start + count]
    return found


def entries_of(field):
    """name of each patch -> what stands in its braces, as foamDictionary has worked it out."""
    return dict(re.findall(r"^    (\S+)\n    \{(.*?)^    \}", field, re.M | re.S))


def said_by(command, case, folder, longest):
    """What a program of the distribution says about the case."""
    log = folder / f"{command[0]}.log"
    if tutorials.bounded([*command, "-case", str(case)], folder, log, tutorials.environment(folder), longest):
        raise Failed(f"{command[0]}: {log.read_text(errors='replace')[-300:]}")
    return log.read_text(errors="replace")


def walls_that_move(case, faces, folder, longest):
    """Names of the patches whose velocity in U is that of the mesh."""
    kinds = [(name.strip('"'), entry) for name, entry in
             entries_of(said_by(["foamDictionary", str(case / "0" / "U")], case, folder, longest)).items()]
    moving = []
    for patch in faces:  # an entry of its name counts, then the last of a group, then the last pattern
        entry = (dict(kinds).get(patch[0]) or next((entry for name, entry in reversed(kinds) if name in patch[1:]), None)
                 or next((entry for name, entry in reversed(kinds) if re.fullmatch(name, patch[0])), ""))
        if re.search(r"type\s+movingWallVelocity;", entry):
            moving.append(patch)
    return moving


def let_go_along(case, patch):
    """The velocity that a wall needs where it moves with the mesh."""
    file = case / "0" / "U"
    text, count = re.subn(r"(boundaryField\s*\{)", rf"\1\n{patch} {{ type movingWallVelocity; value uniform (0 0 0); }}", file.read_text())
    if count != 1:
        raise Failed(f"0/U has {count} boundary fields")
    file.write_text(text)


def are_moved_by_the_flow(case):
    """Where the walls of a mesh that moves go, nobody knows beforehand."""
    return bool(re.search(r"^\s*motionSolver\s+(rigidBodyMotion|sixDoFRigidBodyMotion)", (case / "constant" / "dynamicMeshDict").read_text(), re.M))


def points_in_time(case, folder, window, windows, longest):
    """Faces of each patch, and points of the mesh at the start and after each window."""
    moved = folder / "moved"
    shutil.rmtree(moved, ignore_errors=True)
    shutil.copytree(case, moved)
    file = moved / "system" / "controlDict"
    text = file.read_text()
    text = text[:text.index("functions")] if "functions" in text else text
    lines = {"startFrom": "startTime", "startTime": 0, "stopAt": "endTime", "endTime": f"{windows * window:.15g}", "deltaT": f"{window:.15g}",
             "adjustTimeStep": "no", "writeControl": "timeStep", "writeInterval": 1, "purgeWrite": 0, "writeFormat": "ascii",
             "writePrecision": 16, "timePrecision": 12, "writeCompression": "off", "libs": "(waveModels fvMotionSolvers)"}
    for key in lines:
        text = re.sub(rf"^\s*{key}\s[^;]*;", "", text, flags=re.M)
    file.write_text(text + "".join(f"{key} {value};\n" for key, value in lines.items()))
    said_by(["foamFormatConvert", "-constant", "-noFunctionObjects"], moved, folder, longest)  # a mesh may be binary
    said_by(["moveDynamicMesh", "-noFunctionObjects"], moved, folder, longest)
    times = sorted((t for t in moved.iterdir() if re.fullmatch(r"[0-9.e+-]+", t.name) and (t / "polyMesh").is_dir()), key=lambda t: float(t.name))
    found = [vectors(text_of(moved / "constant" / "polyMesh", "points"))]
    found += [vectors(text_of(t / "polyMesh", "points")) for t in times if float(t.name) > 0]
    if len(found) != windows + 1:
        raise Failed(f"moveDynamicMesh: points of {len(found)} times, not {windows + 1}")
    return faces_of(moved / "constant" / "polyMesh"), found


def paddles(case, name, faces, points):
    """Groups of the patch's faces that move as one: all, or those of each paddle."""
    file = case / "0" / "pointDisplacement"
    entry = entries_of(file.read_text()).get(name, "") if file.exists() else ""
    count = int(tutorials.entry(entry, "nPaddle", "1"))
    y = [sum(points[p][1] for p in face) / len(face) for face in faces]
    low, high = min(points[p][1] for face in faces for p in face), max(points[p][1] for face in faces for p in face)
    groups = [[] for _ in range(count)]
    for face, at in zip(faces, y):
        groups[min(count - 1, int((at - low) / (high - low) * count)) if count > 1 else 0].append(face)
    return [group for group in groups if group]


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def mean(points):
    return tuple(sum(p[i] for p in points) / len(points) for i in range(3))


def solved(matrix, right):
    """Of three equations."""
    def volume(columns):
        return sum(x * y for x, y in zip(columns[0], cross(columns[1], columns[2])))
    columns = list(zip(*matrix))
    whole = volume(columns)
    return tuple(volume([right if i == j else column for j, column in enumerate(columns)]) / whole for i in range(3))


def rigid(before, after):
    """Way of the middle and turn (axis times angle) that bring the points from one place to the other, and the largest distance that is
    left. Of a motion that is not rigid the one with the least squares. With the turn w = 2 tan(angle/2): after - before = w x (before +
    after)/2, about the middle."""
    middle, moved = mean(before), mean(after)
    pairs = [(minus(a, middle), minus(b, moved)) for a, b in zip(before, after)]
    matrix, right = [[0.0] * 3 for _ in range(3)], [0.0] * 3
    for a, b in pairs:
        arm = tuple((x + y) / 2 for x, y in zip(a, b))
        square = sum(x * x for x in arm)
        for i, of_turn in enumerate(cross(arm, minus(b, a))):
            right[i] += of_turn
            for j in range(3):
                matrix[i][j] += (square if i == j else 0) - arm[i] * arm[j]
    w = solved(matrix, right)
    size = math.hypot(*w)
    turn = tuple(x * (2 * math.atan(size / 2) / size if size else 0) for x in w)
    left = max(math.dist(minus(b, a), cross(w, tuple((x + y) / 2 for x, y in zip(a, b)))) for a, b in pairs)
    return minus(moved, middle), turn, left


def triangles(face):
    return [(face[0], face[i], face[i + 1]) for i in range(1, len(face) - 1)]


def surface(faces, points):
    """STL of faces."""
    lines = ["solid wall"]
    for face in faces:
        for corners in triangles(face):
            lines += ["facet normal 0 0 0", "outer loop", *("vertex {:.12g} {:.12g} {:.12g}".format(*points[p]) for p in corners), "endloop", "endfacet"]
    return "\n".join(lines + ["endsolid wall", ""])


def of_step(name, values, steps):
    """A variable of the script that has one value in each window."""
    parts = [f"(step>{n * steps + 0.5})*(step<{(n + 1) * steps + 0.5})*({value:.15g})" for n, value in enumerate(values)]
    return f"variable        {name} equal {'+'.join(parts)}\n"


class Walls:
    """Those of a case that move: files for its folder, lines for its script, and where the mesh is in the course of the run."""

    def __init__(self, case, folder, window, windows, steps, longest, along=()):
        """along: patches of which a part goes along, although the tutorial's U does not say so."""
        self.lines, self.left, self.folder, self.window = "", 0.0, folder, window
        faces, self.points = points_in_time(case, folder, window, windows, longest)
        for patch in faces:
            if patch[0] in along:
                faces[patch] = [face for face in faces[patch] if all(self.points[0][p] != self.points[-1][p] for p in face)]
        names = walls_that_move(case, faces, folder, longest)
        if not names:
            raise Failed("its mesh moves without a wall")
        self.parts = [part for name in names for part in paddles(case, name[0], faces[name], self.points[0])]
        for n, part in enumerate(self.parts):
            (folder / f"wall{n}.stl").write_text(surface(part, self.points[0]))
            self.lines += self.motion(n, sorted({p for face in part for p in face}), window, steps)
        meshes = " ".join(f"mesh{n}" for n in range(len(self.parts)))
        self.lines += (f"fix             walls all wall/gran model hooke/stiffness tangential history mesh n_meshes {len(self.parts)} meshes {meshes}\n")
        self.lines += "".join(f"dump            end{n} all mesh/stl {windows * steps} end{n}_*.stl mesh{n}\n" for n in range(len(self.parts)))

    def motion(self, n, points, window, steps):
        ways, turns = [], []
        for before, after in zip(self.points, self.points[1:]):
            way, turn, left = rigid([before[p] for p in points], [after[p] for p in points])
            ways.append(way)
            turns.append(turn)
            self.left = max(self.left, left)
        origin = " ".join(f"{x:.15g}" for x in mean([self.points[0][p] for p in points]))
        turning = [axis for axis in range(3) if max(abs(turn[axis]) for turn in turns) > 1e-12]
        text = "".join(of_step(f"wall{n}{'xyz'[axis]}", [way[axis] / window for way in ways], steps) for axis in range(3))
        text += "".join(of_step(f"turn{n}{'xyz'[axis]}", [turn[axis] / window for turn in turns], steps) for axis in turning)
        text += SURFACE.format(n=n, turns="".join(
            TURN.format(n=n, axis="xyz"[axis], origin=origin, way=" ".join("1." if a == axis else "0." for a in range(3))) for axis in turning))
        return text

    def fastest(self):
        """Of the walls' points, mean of a window, m/s."""
        corners = {p for part in self.parts for face in part for p in face}
        return max(math.dist(before[p], after[p]) for before, after in zip(self.points, self.points[1:]) for p in corners) / self.window

    def box(self):
        """Of all points at all times."""
        return (tuple(min(p[axis] for points in self.points for p in points) for axis in range(3)),
                tuple(max(p[axis] for points in self.points for p in points) for axis in range(3)))

    def apart(self, run):
        """Largest distance, m, of a corner of the surfaces at the end of a run, as LIGGGHTS wrote them, from where the fluid's mesh has one."""
        times = [t for t in (run / "fluid").iterdir() if re.fullmatch(r"[0-9.e+-]+", t.name) and (t / "polyMesh").is_dir()]
        points, worst = vectors(text_of(max(times, key=lambda t: float(t.name)) / "polyMesh", "points")), 0.0
        for n, part in enumerate(self.parts):
            places = [points[p] for p in {p for face in part for p in face}]
            file = max(self.folder.glob(f"end{n}_*.stl"), key=lambda f: int(f.stem.split("_")[1]))
            corners = sorted(set(re.findall(r"vertex\s+(\S+)\s+(\S+)\s+(\S+)", file.read_text())))
            for corner in corners[::max(1, len(corners) // LOOKED_AT)]:
                worst = max(worst, min(math.dist(tuple(map(float, corner)), place) for place in places))
        return worst
