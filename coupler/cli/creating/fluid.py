# SPDX-License-Identifier: GPL-3.0-or-later
"""The interFoam case: a copy of what a run needs, the commands that make its mesh and fields, and what they make."""
import dataclasses
import json
import re
import shutil
import subprocess

from creating.mistake import Mistake

# Commands of an Allrun that make mesh and fields, with what they are given there.
MAKES_THE_CASE = ("blockMesh", "surfaceFeatureExtract", "snappyHexMesh", "extrudeMesh", "refineMesh", "topoSet",
                  "subsetMesh", "createBaffles", "createPatch", "mirrorMesh", "transformPoints", "setFields",
                  "funkySetFields")


@dataclasses.dataclass
class FluidFacts:
    lower: tuple  # of the mesh's box, m
    upper: tuple
    cells: int
    end_time: float  # s, of controlDict
    write_interval: float  # s; 0: not a time
    gravity: float = 9.81  # m/s2, size


def commands_of_allrun(case):
    """In their order; none if there is no script that tells."""
    commands = []
    for name in ("Allrun.pre", "Allmesh", "Allrun"):
        script = case / name
        for line in script.read_text(errors="replace").splitlines() if script.is_file() else []:
            words = line.split("#")[0].split()
            if words[:1] == ["runApplication"]:
                words = words[1:]
            while words[:1] and words[0] in ("-a", "-o", "-overwrite", "-append"):
                words = words[1:]
            if words and words[0] in MAKES_THE_CASE and not any(c in line for c in "$|;&<>"):
                commands.append(" ".join(words))
    return commands


def prepare_commands(case):
    commands = commands_of_allrun(case)
    if commands:
        return commands
    found = []
    if (case / "system" / "blockMeshDict").is_file() or (case / "constant/polyMesh/blockMeshDict").is_file():
        found.append("blockMesh")
    if (case / "system" / "snappyHexMeshDict").is_file():
        found.append("snappyHexMesh -overwrite")
    if not found and not list((case / "constant" / "polyMesh").glob("points*")):
        raise Mistake(f"--fluid: {case}: neither a mesh (constant/polyMesh) nor system/blockMeshDict that makes one")
    if (case / "system" / "setFieldsDict").is_file():
        found.append("setFields")
    return found


def copy_fluid(case, target):
    """constant, system and the fields of the start; returns the commands that make mesh and fields."""
    prepare = prepare_commands(case)
    made = any(command.startswith("blockMesh") for command in prepare)
    leave_out = shutil.ignore_patterns("polyMesh", "extendedFeatureEdgeMesh") if made else None
    shutil.copytree(case / "constant", target / "constant", ignore=leave_out)
    block_mesh = case / "constant" / "polyMesh" / "blockMeshDict"
    if made and block_mesh.is_file():
        (target / "constant" / "polyMesh").mkdir()
        shutil.copy(block_mesh, target / "constant" / "polyMesh")
    shutil.copytree(case / "system", target / "system")
    fields = [case / name for name in ("0.orig", "0") if (case / name).is_dir()]
    if not fields:
        raise Mistake(f"--fluid: {case}: there is neither 0.orig nor 0")
    shutil.copytree(fields[0], target / fields[0].name)
    return prepare


def dictionary_number(text, key):
    found = re.search(rf"(?:^|[;{{}}])\s*{key}\s+([-+.\deE]+)\s*;", text, re.MULTILINE)
    return float(found[1]) if found else 0.0


def fluid_facts(demvof, folder, prepare, scratch):
    """Prepares the case in a scratch folder, and asks checkMesh for its box, to all digits."""
    ask = ["foamDictionary system/controlDict -entry writePrecision -set 12", "checkMesh"]
    case_file = scratch / "case.yaml"
    case_file.write_text(json.dumps({"fluid": {"case": str(folder / "fluid"), "prepare": [*prepare, *ask]},
                                     "coupling": {"end_time": 1.0, "window": 1.0}}), encoding="utf-8")
    done = subprocess.run([demvof, "prepare", case_file, "--out", scratch / "run"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    log = scratch / "run" / "prepare.log"
    said = log.read_text(errors="replace") if log.is_file() else ""
    number = r"([-+.\deE]+)"
    box = re.search(rf"Overall domain bounding box \({number} {number} {number}\) \({number} {number} {number}\)", said)
    cells = re.search(r"^\s+cells:\s+(\d+)", said, re.MULTILINE)
    if done.returncode != 0 or not box or not cells:
        raise Mistake(f"--fluid: {' and '.join(prepare)} did not make a mesh:\n{done.stdout}"
                      f"put it right in {folder / 'fluid'}'s original, or say fluid.prepare yourself")
    corners = [float(text) for text in box.groups()]
    control = (folder / "fluid" / "system" / "controlDict").read_text(errors="replace")
    control = re.sub(r"/\*.*?\*/|//[^\n]*", "", control, flags=re.DOTALL)
    steps = re.search(r"writeControl\s+timeStep", control)
    g = (folder / "fluid" / "constant" / "g")
    found = re.search(r"value\s+\(\s*(\S+)\s+(\S+)\s+(\S+?)\s*\)", g.read_text(errors="replace")) if g.is_file() else None
    size = sum(float(c) ** 2 for c in found.groups()) ** 0.5 if found else 9.81
    return FluidFacts(tuple(corners[:3]), tuple(corners[3:]), int(cells[1]), dictionary_number(control, "endTime"),
                      0.0 if steps else dictionary_number(control, "writeInterval"), size)
