# SPDX-License-Identifier: GPL-3.0-or-later
"""Turbulence models on a mesh that refines itself: water that falls over in a closed box, k-omega SST with wall functions (a distance from
walls that the model holds, and one at walls that they hold), on one rank, on three, and on three that send each other cells.

Usage: turbulent_ranks_test.py DEMVOF FOLDER"""
import pathlib
import sys

import numpy
from box_case import SIDES, BoxCase, patch_name

DEMVOF, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
BOUNDS = {"kinetic_energy": 5.5e-6, "max_speed": 5.5e-4, "liquid_front": 3e-6}  # of the largest value; the largest speed is that of the air
FILE = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"
FIELDS = {"k": ("[0 2 -2 0 0 0 0]", 0.01, "kqRWallFunction"), "omega": ("[0 0 -1 0 0 0 0]", 100, "omegaWallFunction"),
          "nut": ("[0 2 -1 0 0 0 0]", 0, "nutkWallFunction")}
COLUMN = """defaultFieldValues ( volScalarFieldValue alpha.water 0 );
regions ( boxToCell { box (-1 -1 -1) (0.03 1 0.03); fieldValues ( volScalarFieldValue alpha.water 1 ); } );
"""


def replaced(file, changes):
    text = file.read_text()
    for old, new in changes.items():
        assert old in text, f"{old!r} is not in {file}"
        text = text.replace(old, new, 1)
    file.write_text(text)


class Turbulent(BoxCase):
    def write(self):
        case_file = super().write()
        system = case_file.parent / "fluid" / "system"
        replaced(system / "fvSchemes", {"divSchemes\n{": "wallDist { method meshWave; }\ndivSchemes\n{ div(phi,k) Gauss upwind; div(phi,omega) Gauss upwind;"})
        replaced(system / "fvSolution", {"\"U.*\"": "\"(k|omega).*\" { solver PBiCGStab; preconditioner DILU; tolerance 1e-12; relTol 0; }\n    \"U.*\""})
        (system / "setFieldsDict").write_text(FILE.format("dictionary", "setFieldsDict") + COLUMN)
        return case_file


def run(name, ranks, max_imbalance):
    fields = {f"fluid/0.orig/{field}": FILE.format("volScalarField", field) + f"dimensions {dimensions};\ninternalField uniform {value};\nboundaryField\n{{\n"
              + "".join(f"{patch_name(side)} {{ type {wall}; value uniform {value}; }}\n" for side in SIDES) + "}\n"
              for field, (dimensions, value, wall) in FIELDS.items()}
    properties = FILE.format("dictionary", "turbulenceProperties") + "simulationType RAS;\nRAS { RASModel kOmegaSST; turbulence on; printCoeffs no; }\n"
    case = Turbulent(FOLDER / name, (0.1, 0.02, 0.04), (20, 4, 8), (10, 2, 4), 0.03, 1e-3, level=0.03, tolerance=1e-12, relative_tolerance=0,
                     sections={"fluid": {"refinement": {"levels": 2, "max_imbalance": max_imbalance}}},
                     extra_files={**fields, "fluid/constant/turbulenceProperties": properties})
    return case.run(DEMVOF, "--fluid-ranks", str(ranks))


def main():
    alone, kept, moved = run("alone", 1, 1.03), run("kept", 3, 1e9), run("moved", 3, 1.03)
    failed = not (moved.results["cells"]["rank_changes"] > 0 == kept.results["cells"]["rank_changes"])
    print(f"cells were sent {moved.results['cells']['rank_changes']} times (at least once)")
    for name, other in (("kept", kept), ("moved", moved)):
        for cells in ("fine_min", "fine_max", "mesh_changes"):
            failed |= other.results["cells"][cells] != alone.results["cells"][cells]
            print(f"{name} on 3 ranks: {cells} {other.results['cells'][cells]}, on one {alone.results['cells'][cells]}")
        for quantity, bound in BOUNDS.items():
            error = numpy.abs(other.history[quantity] - alone.history[quantity]).max() / numpy.abs(alone.history[quantity]).max()
            failed |= not error <= bound
            print(f"{name} on 3 ranks: {quantity:<15} differs by {error:.2e} from one rank (at most {bound:g})")
    sys.exit(failed)


main()
