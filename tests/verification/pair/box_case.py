# SPDX-License-Identifier: GPL-3.0-or-later
"""Small pairs for verification: a box of fluid, a list of particles and a case file, written and run.

    case = BoxCase(folder, upper=(0.1, 0.1, 0.2), fine=(10, 10, 20), bulk=(5, 5, 10), end_time=0.1, window=1e-3)
    case.sides["z+"] = Open()
    case.particles.append(Particle((0.05, 0.05, 0.1), diameter=2e-3, density=2500))
    run = case.run(demvof)                   # Run of coupler/cli/reporting/run.py: results, history, quantities
    state = particle_states(run.folder)       # of the last output, rows by particle id

SI units. Whatever is not set keeps the defaults below; `settings` and `coupling` go into the case file as they are.
"""
import argparse
import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "coupler" / "cli"), str(ROOT / "tests" / "support")]

from reporting.run import Run  # noqa: E402


# What a side of the box is: entries for U, p_rgh, alpha.water, and the patch type.

def Wall():
    return {"type": "wall", "U": "noSlip", "p_rgh": "fixedFluxPressure; value uniform 0",
            "alpha.water": "zeroGradient"}


def Slip():
    return {"type": "patch", "U": "slip", "p_rgh": "fixedFluxPressure; value uniform 0", "alpha.water": "zeroGradient"}


def Cyclic():
    """Both sides of a direction; the particles' box is periodic there too."""
    return {"type": "cyclic", "U": "cyclic", "p_rgh": "cyclic", "alpha.water": "cyclic"}


def Inlet(velocity, alpha=1):
    """velocity: (x, y, z), m/s, or the text of an OpenFOAM boundary entry."""
    entry = velocity if isinstance(velocity, str) else f"fixedValue; value uniform {vector(velocity)}"
    return {"type": "patch", "U": entry, "p_rgh": "fixedFluxPressure; value uniform 0",
            "alpha.water": f"fixedValue; value uniform {alpha}"}


def Outlet(alpha=1):
    """Pressure 0 where the fluid leaves; what comes back has the given alpha."""
    return {"type": "patch", "U": "inletOutlet; inletValue uniform (0 0 0); value uniform (0 0 0)",
            "p_rgh": "fixedValue; value uniform 0",
            "alpha.water": f"inletOutlet; inletValue uniform {alpha}; value uniform {alpha}"}


def Open(alpha=0):
    """Open to a fluid at rest outside."""
    return {"type": "patch", "U": "pressureInletOutletVelocity; value uniform (0 0 0)",
            "p_rgh": "totalPressure; p0 uniform 0; value uniform 0",
            "alpha.water": f"inletOutlet; inletValue uniform {alpha}; value uniform {alpha}"}


SIDES = {"x-": "0 4 7 3", "x+": "1 2 6 5", "y-": "0 1 5 4", "y+": "3 7 6 2", "z-": "0 3 2 1", "z+": "4 5 6 7"}
OPPOSITE = {"-": "+", "+": "-"}


def patch_name(side):
    return side[0] + ("low" if side[1] == "-" else "high")


def vector(values):
    return "({:.17g} {:.17g} {:.17g})".format(*values)


@dataclasses.dataclass
class Particle:
    position: tuple
    diameter: float
    density: float
    velocity: tuple = (0, 0, 0)
    held: bool = False  # frozen in place
    spin: tuple = (0, 0, 0)
    type: int = 1       # 1 or 2: for contact properties of its own, in script_tail


def kind(particle):
    return 3 if particle.held else particle.type


@dataclasses.dataclass
class BoxCase:
    folder: pathlib.Path
    upper: tuple
    fine: tuple  # cells of the fluid mesh
    bulk: tuple  # cells of the bulk grid
    end_time: float
    window: float
    lower: tuple = (0, 0, 0)
    sides: dict = dataclasses.field(default_factory=lambda: {side: Wall() for side in SIDES})
    gravity: tuple = (0, 0, -9.81)
    liquid: tuple = (1000, 1e-6)  # density, kinematic viscosity
    gas: tuple = (1, 1e-5)
    sigma: float = 0
    level: float = None        # liquid below this z; None: liquid everywhere
    level_in_cells: bool = False  # a fine cell that the level cuts holds its part of liquid; else all or nothing, as setFields does
    velocity: tuple = (0, 0, 0)  # of the fluid at the start
    particles: list = dataclasses.field(default_factory=list)
    contacts: bool = False     # walls for the particles (wall/gran at Wall and Slip sides)
    stiffness: float = 1000    # of contacts, N/m
    dem_step: float = None     # default: the window
    forces: list = dataclasses.field(default_factory=lambda: [{"drag": "schiller_naumann"}, "pressure_gradient"])
    coupling: dict = dataclasses.field(default_factory=dict)  # further keys of the section coupling
    sections: dict = dataclasses.field(default_factory=dict)  # further sections of the case file
    courant: float = 0.5
    longest_step: float = 1e9  # of the fluid
    first_step: float = None   # default: the window
    tolerance: float = 1e-10   # of the pressure solver
    relative_tolerance: float = 0.01  # of all but the last correction
    velocity_solver: str = "solver smoothSolver; smoother symGaussSeidel; tolerance 1e-12; relTol 0;"
    pimple: str = ""           # further entries of PIMPLE
    alpha_controls: str = "nAlphaCorr 1; nAlphaSubCycles 1; cAlpha 1; MULESCorr no;"
    output_interval: float = 0
    history_interval: float = 0
    script_tail: str = ""      # further lines of the LIGGGHTS script
    floor_rise: float = 0      # height of the floor's edge at x+ above that at x-: a slanted floor
    momentum_judged: bool = True  # by momentum_of_everything(); not on meshes of other cells than equal hexahedra
    margin: float = 0          # of the particles' box around the fluid's, where it is not periodic
    periodic: list = None      # of the particles' box, per direction; default: where the sides are cyclic
    watched: dict = dataclasses.field(default_factory=dict)  # side -> field: its mean at every fluid step
    extra_files: dict = dataclasses.field(default_factory=dict)  # name in the folder: text
    prepare: list = None

    def write(self):
        """Case file and both cases in the folder; returns the case file."""
        self.folder = pathlib.Path(self.folder)
        shutil.rmtree(self.folder, ignore_errors=True)
        self._write_fluid()
        if self.particles:
            self._write_particles()
        for name, text in self.extra_files.items():
            (self.folder / name).write_text(text)
        prepare = self.prepare or ["blockMesh"] + (["setFields"] if self.level is not None and not self.level_in_cells else [])
        content = {"fluid": {"case": "fluid", "prepare": prepare},
                   "coupling": {"end_time": self.end_time, "window": self.window, **self.coupling},
                   "output": {"interval": self.output_interval, "history_interval": self.history_interval}}
        if self.particles:
            content["particles"] = {"script": "particles/in.particles"}
            content["bulk_grid"] = {"lower": list(self.lower), "upper": list(self.upper), "cells": list(self.bulk)}
            content["forces"] = self.forces
        for section, keys in self.sections.items():
            content.setdefault(section, {}).update(keys)
        case_file = self.folder / "case.yaml"
        case_file.write_text(json.dumps(content, indent=2) + "\n")  # JSON is YAML
        return case_file

    def run(self, demvof, *options, out="run", timeout=3600):
        """Writes and runs the case; returns its Run. Raises RuntimeError with the printed text when it fails."""
        case_file = self.write()
        out = self.folder / out
        done = subprocess.run([str(demvof), "run", str(case_file), "--out", str(out), "--force", *options],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=timeout,
                              check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{case_file}: exit code {done.returncode}\n{done.stdout[-3000:]}")
        run = Run(out)
        judged = run.results.get("momentum", {}).get("error")  # None where particles came or went in every window
        if self.momentum_judged and judged and "refinement" not in self.sections.get("fluid", {}):
            MOMENTUM_ERRORS.append(max(judged))
        return run

    # ---- fluid

    def _write_fluid(self):
        write = self._foam_file
        patches = {patch_name(side): entry for side, entry in self.sides.items()}

        def field(name, dimensions, value):
            boundary = "\n".join(f"    {p} {{ type {entry[name]}; }}" for p, entry in patches.items())
            inside = value if str(value).startswith("nonuniform") else f"uniform {value}"
            return f"dimensions {dimensions};\ninternalField {inside};\nboundaryField\n{{\n{boundary}\n}}\n"

        write("0.orig/U", "volVectorField", field("U", "[0 1 -1 0 0 0 0]", vector(self.velocity)))
        write("0.orig/p_rgh", "volScalarField", field("p_rgh", "[1 -1 -2 0 0 0 0]", 0))
        write("0.orig/alpha.water", "volScalarField",
              field("alpha.water", "[0 0 0 0 0 0 0]", self._layers() if self.level_in_cells else 1 if self.level is None else 0))
        write("constant/g", "uniformDimensionedVectorField",
              f"dimensions [0 1 -2 0 0 0 0];\nvalue {vector(self.gravity)};\n")
        (rho1, nu1), (rho2, nu2) = self.liquid, self.gas
        write("constant/transportProperties", "dictionary",
              f"phases (water air);\nwater {{ transportModel Newtonian; nu {nu1:.17g}; rho {rho1:.17g}; }}\n"
              f"air {{ transportModel Newtonian; nu {nu2:.17g}; rho {rho2:.17g}; }}\nsigma {self.sigma:.17g};\n")
        write("constant/turbulenceProperties", "dictionary", "simulationType laminar;\n")
        write("system/blockMeshDict", "dictionary", self._block_mesh())
        write("system/controlDict", "dictionary",
              f"application interFoam; startFrom startTime; startTime 0; stopAt endTime; endTime {self.end_time};\n"
              f"deltaT {self.first_step or self.window}; writeControl adjustableRunTime; writeInterval 1e9;\n"
              "writeFormat binary; writePrecision 12; timePrecision 12; runTimeModifiable no;\n"
              f"adjustTimeStep yes; maxCo {self.courant}; maxAlphaCo {self.courant}; maxDeltaT {self.longest_step};\n"
              f"functions {{ {' '.join(self._watch(side, name) for side, name in self.watched.items())} }}\n")
        write("system/decomposeParDict", "dictionary",
              "numberOfSubdomains 2; method simple; coeffs { n (2 1 1); }\n")
        write("system/fvSchemes", "dictionary",
              "ddtSchemes { default Euler; }\ngradSchemes { default Gauss linear; }\n"
              "divSchemes\n{\n    div(rhoPhi,U) Gauss limitedLinearV 1; div(phi,alpha) Gauss vanLeer;\n"
              "    div(phirb,alpha) Gauss linear; div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear;\n}\n"
              "laplacianSchemes { default Gauss linear corrected; }\ninterpolationSchemes { default linear; }\n"
              "snGradSchemes { default corrected; }\n")
        write("system/fvSolution", "dictionary",
              f"solvers\n{{\n    \"alpha.water.*\" {{ {self.alpha_controls} }}\n"
              f"    p_rgh {{ solver PCG; preconditioner DIC; tolerance {self.tolerance}; "
              f"relTol {self.relative_tolerance}; }}\n"
              "    p_rghFinal { $p_rgh; relTol 0; }\n    \"pcorr.*\" { $p_rgh; relTol 0; }\n"
              f"    \"U.*\" {{ {self.velocity_solver} }}\n}}\n"
              "PIMPLE { momentumPredictor no; nOuterCorrectors 1; nCorrectors 3; nNonOrthogonalCorrectors 0; "
              f"pRefCell 0; pRefValue 0; {self.pimple} }}\n")
        if self.level is not None and not self.level_in_cells:
            low, high = [c - 1 for c in self.lower], [c + 1 for c in self.upper[:2]] + [self.level]
            write("system/setFieldsDict", "dictionary",
                  "defaultFieldValues ( volScalarFieldValue alpha.water 0 );\nregions ( boxToCell "
                  f"{{ box {vector(low)} {vector(high)}; fieldValues ( volScalarFieldValue alpha.water 1 ); }} );\n")

    def _layers(self):
        """alpha.water of a level that lies anywhere in a fine cell."""
        height = (self.upper[2] - self.lower[2]) / self.fine[2]
        layers = (min(max((self.level - self.lower[2]) / height - k, 0), 1) for k in range(self.fine[2]))
        each = self.fine[0] * self.fine[1]
        return (f"nonuniform List<scalar> {each * self.fine[2]} "
                f"({' '.join(f'{alpha:.17g}' for alpha in layers for _ in range(each))})")

    @staticmethod
    def _watch(side, name):
        return (f"{patch_name(side)}_{name} {{ type surfaceFieldValue; libs (fieldFunctionObjects); writeFields no; "
                f"regionType patch; name {patch_name(side)}; operation areaAverage; fields ({name}); log no; }}")

    def _foam_file(self, name, kind, body):
        path = self.folder / "fluid" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"FoamFile {{ version 2.0; format ascii; class {kind}; object {path.name}; }}\n{body}")

    def _block_mesh(self):
        (x0, y0, z0), (x1, y1, z1) = self.lower, self.upper
        corners = " ".join(vector((x, y, z + (self.floor_rise if (x, z) == (x1, z0) else 0))) for z in (z0, z1)
                           for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)))
        patches = ""
        for side, entry in self.sides.items():
            neighbour = ""
            if entry["type"] == "cyclic":
                neighbour = f"neighbourPatch {patch_name(side[0] + OPPOSITE[side[1]])};"
            patches += f"    {patch_name(side)} {{ type {entry['type']}; {neighbour} faces (({SIDES[side]})); }}\n"
        return (f"scale 1;\nvertices ( {corners} );\n"
                f"blocks ( hex (0 1 2 3 4 5 6 7) ({' '.join(map(str, self.fine))}) simpleGrading (1 1 1) );\n"
                f"edges ();\nboundary\n(\n{patches});\nmergePatchPairs ();\n")

    # ---- particles

    def _write_particles(self):
        folder = self.folder / "particles"
        folder.mkdir(parents=True)
        periodic = self.periodic or [self.sides[axis + "-"]["type"] == "cyclic" for axis in "xyz"]
        margin = [0 if p else self.margin for p in periodic]
        kinds = sorted({kind(p) for p in self.particles})  # LIGGGHTS wants types without a gap
        lines = [f"\n{len(self.particles)} atoms\n{len(kinds)} atom types\n"]
        lines += [f"{self.lower[a] - margin[a]:.17g} {self.upper[a] + margin[a]:.17g} {n}lo {n}hi"
                  for a, n in enumerate("xyz")]
        lines.append("\nAtoms\n")
        for i, p in enumerate(self.particles, 1):
            x, y, z = p.position
            lines.append(f"{i} {kinds.index(kind(p)) + 1} {p.diameter:.17g} {p.density:.17g} "
                         f"{x:.17g} {y:.17g} {z:.17g}")
        lines.append("\nVelocities\n")
        for i, p in enumerate(self.particles, 1):
            lines.append("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}".format(i, *p.velocity, *p.spin))
        (folder / "particles.data").write_text("\n".join(lines) + "\n")

        largest = max(p.diameter for p in self.particles)

        def same(name, value):  # for all pairs of types
            return (f"fix {name} all property/global {name} peratomtypepair {len(kinds)} "
                    + " ".join(len(kinds) ** 2 * [f"{value:.17g}"]) + "\n")

        k = self.stiffness
        script = f"""units si
atom_style granular
atom_modify map array
boundary {' '.join('p' if p else 'f' for p in periodic)}
newton off
communicate single vel yes
variable continued index 0
if "${{continued}} == 1" then "read_restart ${{restart_file}}" else "read_data particles.data"
neighbor {0.2 * largest:.17g} bin
neigh_modify delay 0
""" + (same("kn", k) + same("kt", 0.2857 * k) + same("gamman", 500) + same("gammat", 250)
       + same("coefficientFriction", 0.3)) + f"""pair_style gran model hooke/stiffness tangential history
pair_coeff * *
timestep {self.dem_step or self.window:.17g}
fix integrate all nve/sphere
"""
        size = sum(c * c for c in self.gravity) ** 0.5
        if size > 0:
            script += "fix gravity all gravity {:.17g} vector {:.17g} {:.17g} {:.17g}\n".format(size, *self.gravity)
        if any(p.held for p in self.particles):
            script += f"group held type {len(kinds)}\nfix hold held freeze\n"
        if self.contacts:
            for side, entry in self.sides.items():
                if entry["U"] in ("noSlip", "slip"):
                    at = (self.lower if side[1] == "-" else self.upper)["xyz".index(side[0])]
                    script += (f"fix {patch_name(side)} all wall/gran model hooke/stiffness tangential history "
                               f"primitive type 1 {side[0]}plane {at:.17g}\n")
        (folder / "in.particles").write_text(script + "thermo 100000\n" + self.script_tail)


def particle_states(folder, output=-1):
    """Of the last output, or another one: dict of arrays by name, rows sorted by particle id."""
    import numpy
    from vtk import vtkXMLPolyDataReader
    from vtk.util.numpy_support import vtk_to_numpy
    files = sorted((pathlib.Path(folder) / "particles").glob("*.vtp"), key=lambda f: f.stat().st_mtime)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(files[output]))
    reader.Update()
    data = reader.GetOutput()
    arrays = {data.GetPointData().GetArrayName(i): vtk_to_numpy(data.GetPointData().GetArray(i))
              for i in range(data.GetPointData().GetNumberOfArrays())}
    arrays["position"] = vtk_to_numpy(data.GetPoints().GetData())
    order = numpy.argsort(arrays["id"])
    return {name: values[order] for name, values in arrays.items()}


def side_means(folder, side, field):
    """Of a field watched on a side: times and means."""
    import numpy
    [file] = (pathlib.Path(folder) / "fluid" / "postProcessing" / f"{patch_name(side)}_{field}").glob("*/*.dat")
    return numpy.loadtxt(file, ndmin=2).T[:2]


def command_line():
    """Of a test that makes a record: demvof, the program to run, and long, whether the sweep is the long one."""
    parser = argparse.ArgumentParser()
    parser.add_argument("demvof")
    parser.add_argument("--long", action="store_true")
    return parser.parse_args()


MOMENTUM_ERRORS = []  # of the runs so far, largest of each


def momentum_of_everything(record, bound=1e-8):
    """Of fluid, particles and what is owed between them, less the impulses from outside: enters the worst of all runs so far."""
    record.at_most("momentum of everything, any component, worst run", max(MOMENTUM_ERRORS), bound)


def scratch(name):
    """Folder of a test's runs, below the working directory."""
    return pathlib.Path(os.environ.get("DEMVOF_SCRATCH", "scratch")).resolve() / name
