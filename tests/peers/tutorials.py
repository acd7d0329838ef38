# SPDX-License-Identifier: GPL-3.0-or-later
"""OpenFOAM's two-phase tutorials as the package openfoam-examples ships them: copies made ready for 20 equal steps."""
import gzip
import os
import pathlib
import re
import shutil
import signal
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = pathlib.Path("/usr/share/doc/openfoam-examples/examples")
SOLVERS = ("interFoam", "interIsoFoam")
STEPS = 20

# Meshes that take a machine of two cores too long: blockMesh with so many times fewer cells each way.
COARSER = {
    "interFoam/RAS/DTCHull": 2, "interFoam/RAS/DTCHullMoving": 2, "interFoam/RAS/motorBike": 2,
    "interFoam/RAS/mixerVesselAMI": 2, "interFoam/LES/nozzleFlow2D": 2,
    "interFoam/laminar/vofToLagrangian/eulerianInjection": 4, "interFoam/laminar/waves/irregularMultiDirection": 2,
    "interFoam/laminar/waves/mangroveInteraction": 4, "interFoam/laminar/waves/solitary": 2,
    "interFoam/laminar/waves/solitaryGrimshaw": 4, "interFoam/laminar/waves/solitaryMcCowan": 4,
    "interFoam/laminar/waves/waveMakerFlap": 2, "interFoam/laminar/waves/waveMakerMultiPaddleFlap": 4,
    "interFoam/laminar/waves/waveMakerMultiPaddlePiston": 4, "interFoam/laminar/waves/waveMakerPiston": 2,
    "interIsoFoam/waveExampleStreamFunction": 4,
}


class Failed(Exception):
    """A tutorial that could not be made ready, or a program that did not do what was asked."""


def bounded(command, folder, log, environment, longest):
    """Exit code of a program, which gets `longest` seconds; it and what it started end then."""
    with open(log, "w", encoding="utf-8") as out:
        process = subprocess.Popen(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT, env=environment, start_new_session=True)
        try:
            return process.wait(longest)
        except subprocess.TimeoutExpired:
            raise Failed(f"{pathlib.Path(command[0]).name} takes more than {longest} s") from None
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGTERM)  # not SIGKILL: demvof ends what its mpirun started
                process.wait()


def tutorials():
    """name -> folder of every tutorial of the two solvers; those that Allrun makes from another one included."""
    found = {}
    for solver in SOLVERS:
        for allrun in sorted((EXAMPLES / "multiphase" / solver).rglob("Allrun")):
            folder = allrun.parent
            name = str(folder.relative_to(EXAMPLES / "multiphase"))
            control = folder / "system" / "controlDict"
            if control.is_file():
                if re.search(r"^\s*application\s+(\w+)", control.read_text(), re.M)[1] in SOLVERS:
                    found[name] = folder
            elif "damBreakFine" in allrun.read_text():
                found[name + "/damBreakFine"] = folder
    return found


def environment(folder):
    """For the commands of an Allrun: the packages' OpenFOAM, with the helper functions that no package holds."""
    project = folder / "project"
    (project / "bin" / "tools").mkdir(parents=True, exist_ok=True)
    if not (project / "etc").exists():
        (project / "etc").symlink_to("/usr/share/openfoam/etc")
    shutil.copy(HERE / "RunFunctions", project / "bin" / "tools" / "RunFunctions")
    return {**os.environ, "WM_PROJECT_DIR": str(project), "FOAM_TUTORIALS": str(EXAMPLES)}


def copy(source, target):
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(source, target)
    for packed in target.rglob("*.gz"):  # Debian packs what is large in /usr/share/doc
        packed.with_suffix("").write_bytes(gzip.decompress(packed.read_bytes()))
        packed.unlink()


def coarsen(folder, factor):
    """Fewer cells in each direction of each block."""
    file = folder / "system" / "blockMeshDict"
    def fewer(found):
        counts = [max(1, int(n) // factor) for n in found[2].split()]
        return f"{found[1]}({' '.join(map(str, counts))})"
    file.write_text(re.sub(r"(hex\s*\([^)]*\)\s*(?:\w+\s*)?)\(\s*(\d+\s+\d+\s+\d+)\s*\)", fewer, file.read_text()))


def prepare(name, source, folder, longest):
    """The tutorial as its own Allrun makes it ready, on one rank; returns its case folder."""
    target = folder / "prepared"
    copy(source, target)
    if name in COARSER:
        coarsen(target, COARSER[name])
    log = folder / "Allrun.log"
    if bounded(["./Allrun"], target, log, environment(folder), longest) != 0:
        said = [line for line in log.read_text(errors="replace").splitlines() if " failed in " in line or "error" in line.lower()]
        raise Failed("its Allrun: " + (said or ["exit code"])[0])
    case = target / "damBreakFine" if name.endswith("/damBreakFine") else target
    if not list((case / "constant" / "polyMesh").glob("faces*")):
        raise Failed("its Allrun makes no mesh")
    shutil.rmtree(case / "0.orig", ignore_errors=True)  # of no use any more; `demvof prepare` would begin with it
    return case


def entry(dictionary, key, otherwise=None):
    found = re.search(rf"^\s*{key}\s+([^;]+);", dictionary, re.M)
    return found[1].strip() if found else otherwise


def twenty_steps(case, step=None, steps=STEPS):
    """Equal steps, 20 where nothing else is said, of the tutorial's deltaT where no other is given, fields written once with all digits."""
    file = case / "system" / "controlDict"
    text = file.read_text()
    step, begin = step or float(entry(text, "deltaT")), 0.0
    lines = {"startFrom": "startTime", "startTime": begin, "stopAt": "endTime", "endTime": begin + steps * step, "deltaT": step,
             "adjustTimeStep": "no", "writeControl": "timeStep", "writeInterval": steps, "purgeWrite": 0,
             "writeFormat": "ascii", "writePrecision": 16, "timePrecision": 12, "writeCompression": "off"}
    for key in lines:
        text = re.sub(rf"^\s*{key}\s[^;]*;", "", text, flags=re.M)
    file.write_text(text + "".join(f"{key} {value};\n" for key, value in lines.items()))


def liquid_name(case):
    text = (case / "constant" / "transportProperties").read_text()
    return "alpha." + re.search(r"^\s*phases\s*\(\s*(\w+)", text, re.M)[1]


def cell_values(file):
    """The internal field of a scalar field written in ascii."""
    text = file.read_text()
    uniform = re.search(r"internalField\s+uniform\s+(\S+);", text)
    if uniform:
        return [float(uniform[1])]
    begin = text.index("(", text.index("internalField"))
    return [float(word) for word in text[begin + 1:text.index(")", begin)].split()]


def difference(one, other):
    """Largest difference of two fields; None when they have not as many cells."""
    if len(one) == 1:
        one = one * len(other)
    if len(other) == 1:
        other = other * len(one)
    return max(abs(a - b) for a, b in zip(one, other)) if len(one) == len(other) else None
