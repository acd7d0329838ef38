#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing is lost when the mesh changes, on one and on two fluid ranks: refinement.py DEMVOF [--long]

Water sloshes in a closed box in a slanted field of gravity, twelve beads fall through its surface, and a mesh of 5 mm refines itself
to 1.25 mm at the surface, around the beads and where the void fraction jumps. The cut between the two ranks goes
through the moving surface; without the last two criteria cells are put together beside it, too.
"""
import subprocess
import sys

from box_case import BoxCase, Particle, command_line, scratch
from histories import differences
from record import Record
from reporting.run import Run


OF_THE_CASE = """FoamFile { version 2.0; format ascii; class dictionary; object dynamicMeshDict; }
dynamicFvMesh dynamicRefineFvMesh;
refineInterval 1; field alpha.water; lowerRefineLevel 0.001; upperRefineLevel 0.999; unrefineLevel 10; nBufferLayers 1;
maxRefinement 1; maxCells 20000; correctFluxes ((phi none) (rhoPhi none)); dumpLevel true;
"""


def by_the_case(record, demvof, case):
    """constant/dynamicMeshDict of the case's own is the section fluid.refinement: the same run, continued too."""
    case.sections = {"fluid": {"refinement": {"levels": 1, "buffer": 1, "max_cells": 20000}}}
    case.end_time, case.output_interval = 0.018, 9e-3
    of_section = case.run(demvof)
    case.sections, case.extra_files = {}, {"fluid/constant/dynamicMeshDict": OF_THE_CASE}
    case.run(demvof, "--set", "coupling.end_time=0.009")
    done = subprocess.run([demvof, "run", str(case.folder / "case.yaml"), "--out", str(case.folder / "run"), "--continue"], capture_output=True,
                          text=True, check=False)
    record.at_most("refined by the case's own dictionary: exit code where it goes on", done.returncode, 0)
    of_case = Run(case.folder / "run")
    worst = differences(of_case, of_section)
    record.at_most("refined by the case's own dictionary: difference from the section, of a quantity's largest value", max(worst.values()), 1e-8)
    record.at_least("refined by the case's own dictionary: changes of the mesh", of_section.results["cells"]["mesh_changes"], 2)
    record.at_most("refined by the case's own dictionary: sentences that say it",
                   abs(sum("dynamicMeshDict: the mesh refines itself as with" in line for line in of_case.results["warnings"]) - 1), 0)


def main():
    options = command_line()
    end = 0.12 if options.long else 0.03
    record = Record("refinement", "Conservation while the mesh refines itself",
                    "Sloshing water and falling beads on a mesh of 5 mm that refines itself to 1.25 mm at the surface, "
                    f"around the beads and at jumps of the void fraction, in a closed box, {end} s. Largest error over all windows.",
                    "tests/Alltest --verification -- -R pair.refinement_long" if options.long else "tests/Alltest -- -R 'pair.refinement$'")
    beads = [Particle((0.01 + 0.02 * (i % 2), 0.006 + 0.008 * (i // 2 % 2), 0.024 + 0.004 * (i // 4)), 2e-3, 2500,
                      velocity=(0, 0, -0.3)) for i in range(12)]
    nested = (0.04, 0.02, 0.04), (8, 4, 8), (8, 4, 8)  # size, fine cells, bulk cells
    # Three steps in a window: the mesh changes within it, too.
    # Longer than the beads' reach, and bulk cells that cut through fine ones: some with beads on one side only.
    across = (0.1, 0.02, 0.04), (20, 4, 8), (19, 3, 7)
    for ranks, box in ((1, nested), (2, nested), (1, across), (2, across)) if options.long else ((2, across),):
        criteria = {"particles": True, "porosity_jump": 0.05} if box is nested else {}
        case = BoxCase(scratch("refinement") / f"{ranks}_{box[1][0]}", *box, end, window=3e-3,
                       level=0.0174, gravity=(5, 0, -8.4), contacts=True, dem_step=1e-5, particles=beads, longest_step=1e-3,
                       sections={"fluid": {"refinement": {"levels": 2, **criteria}}})
        run = case.run(options.demvof, "--fluid-ranks", str(ranks))
        name = f"{ranks} fluid rank" + ("s" if ranks > 1 else "") + ("" if box is nested else ", bulk grid across the mesh")
        cells, conservation = run.results["cells"], run.results["conservation"]
        record.at_least(f"{name}: changes of the mesh", cells["mesh_changes"], 10 if options.long else 4)
        record.at_most(f"{name}: liquid volume", conservation["liquid_volume"], 1e-12)
        record.at_most(f"{name}: solid volume", conservation["solid_volume"], 2e-13 if options.long else 1.1e-13)
        record.at_most(f"{name}: momentum exchange", conservation["exchange"], 4e-13 if options.long else 8e-14)
        record.note(f"{name}: most fine cells", cells["fine_max"])
        record.note(f"{name}: most cells on a rank over the mean", cells["imbalance"])
    by_the_case(record, options.demvof, BoxCase(scratch("refinement") / "by_the_case", *nested, end, window=3e-3, level=0.0174, gravity=(5, 0, -8.4),
                                                contacts=True, dem_step=1e-5, particles=beads, longest_step=1e-3, momentum_judged=False))
    return record.write()


if __name__ == "__main__":
    sys.exit(main())
