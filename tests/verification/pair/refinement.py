#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing is lost when the mesh changes, on one and on two fluid ranks: refinement.py DEMVOF [--long]

Water sloshes in a closed box in a slanted field of gravity, twelve beads fall through its surface, and a mesh of 5 mm refines itself
to 1.25 mm at the surface, around the beads and where the void fraction jumps. The cut between the two ranks goes
through the moving surface; without the last two criteria cells are put together beside it, too.
"""
import sys

from box_case import BoxCase, Particle, command_line, scratch
from record import Record


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
    return record.write()


if __name__ == "__main__":
    sys.exit(main())
