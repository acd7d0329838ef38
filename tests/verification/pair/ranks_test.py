# SPDX-License-Identifier: GPL-3.0-or-later
"""Any rank counts give the same bulk fields: 20 windows of the dam break on 1+1 to 4+4 ranks, with --long to 16+16. More ranks than
cores share them.

With tight solver tolerances, since the linear solvers' preconditioners depend on the decomposition.
Usage: ranks_test.py DEMVOF FOLDER [--long]"""
import pathlib
import sys

import numpy
from vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPImageDataReader

from pair import Pair, dam_break, replace

SHORT, LONG = ((2, 1), (1, 2), (2, 2), (4, 4)), ((3, 7), (8, 8), (16, 16))
BOUND = 1e-9  # relative to the field's largest value
DEMVOF, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])


def bulk_fields(out):
    """Cell arrays of the last bulk output, by name."""
    whole = max(pathlib.Path(out).glob("bulk/*.pvti"), default=None) or max(pathlib.Path(out).glob("bulk/*.vti"))
    reader = vtkXMLPImageDataReader() if whole.suffix == ".pvti" else vtkXMLImageDataReader()
    reader.SetFileName(str(whole))
    reader.Update()
    cells = reader.GetOutput().GetCellData()
    return {cells.GetArrayName(i): vtk_to_numpy(cells.GetArray(i)) for i in range(cells.GetNumberOfArrays())}


def run(case_file, fluid, particles):
    out = FOLDER / f"run_{fluid}_{particles}"
    pair = Pair(DEMVOF, case_file, out, "--set", "coupling.window=2e-4", "--set", "coupling.end_time=4e-3",
                "--fluid-ranks", str(fluid), "--particle-ranks", str(particles))
    code, text = pair.wait_for_signs(120)
    assert code == 0, text
    results = pair.results()
    assert results["steps"]["windows"] == 20, results["steps"]
    assert results["conservation"]["exchange"] < 1e-12, results["conservation"]
    return bulk_fields(out)


def main():
    case_file = dam_break(FOLDER)
    solution = case_file.parent / "fluid" / "system" / "fvSolution"
    replace(solution, "tolerance       1e-8", "tolerance       1e-14")
    replace(solution, "tolerance       1e-5", "tolerance       1e-14")
    replace(solution, "tolerance       1e-2", "tolerance       1e-14")
    replace(solution, "relTol          0.05", "relTol          0")
    reference = run(case_file, 1, 1)
    failed = False
    for fluid, particles in SHORT + (LONG if "--long" in sys.argv else ()):
        for name, values in run(case_file, fluid, particles).items():
            error = numpy.abs(values - reference[name]).max() / max(numpy.abs(reference[name]).max(), 1e-300)
            failed |= not error <= BOUND
            print(f"{fluid}+{particles} ranks: {name:<20} differs by {error:.2e} (at most {BOUND:g})")
    sys.exit(failed)


main()
