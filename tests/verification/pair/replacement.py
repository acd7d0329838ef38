#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One sphere enters water as a drop on the fine mesh: replacement.py DEMVOF [--long | --refined]

Paper, section 7.2, second variant: 4 mm, 2000 kg/m3, at 0.5 m/s just above a surface at rest; bulk cells of 5 mm.
Short: beside another bead; a box of 0.02 x 0.02 x 0.06 m on a mesh of 4 mm that refines itself to 1 mm at the surface and around the sphere,
until the sphere has its place back.
Long: the same in cells of 1 mm everywhere; the paper's box on 108k and 500k cells, crater at 0.03 s, and porous and volume_adding on 108k beside it.
Refined: the same box on 62 500 cells of 2 mm that refine themselves to the 1 mm of the 500k, against its record.
"""
import json
import math
import pathlib
import sys

from box_case import BoxCase, Open, Particle, Wall, SIDES, scratch
from box_fields import cell_field, output_times, sampled, surface_height
from record import Record

DIAMETER, DENSITY, SPEED, WATER = 4e-3, 2000, 0.5, 1000
VOLUME = math.pi / 6 * DIAMETER**3
GAP = 1e-4  # between sphere and surface at the start, m


def level_on(mesh_spacing, level):
    """Cells are filled whole: the level at the start is the face of the mesh next to the one wanted, m."""
    return round(level / mesh_spacing) * mesh_spacing


def enter(folder, demvof, box, level, fine, bulk, end_time, interchange, levels=0):
    """level: of the mesh (level_on). levels: the mesh of cells `fine` is halved so often where it matters."""
    width = box[0]
    case = BoxCase(folder, box, fine, bulk, end_time, window=5e-4, level=level,
                   sides={side: Open() if side == "z+" else Wall() for side in SIDES}, tolerance=1e-9,
                   particles=[Particle((width / 2, width / 2, level + DIAMETER / 2 + GAP), DIAMETER, DENSITY,
                                       velocity=(0, 0, -SPEED))],
                   coupling={"phase_interchange": interchange},
                   sections={"fluid": {"refinement": {"levels": levels, "particles": True}}} if levels else {})
    return case.run(demvof, timeout=20000)


def profile(run, box, fine, refined=False):
    """Height of alpha = 0.5, seen from above, along x through the axis (mean of the two middle rows, m).

    refined: the mesh is another one, seen at the centres of the cells `fine`."""
    last = output_times(run)[-1]
    alpha = sampled(run, last, fine, box[2] / fine[2]) if refined else cell_field(run, last, "alpha.water", fine)
    spacing, j = box[2] / fine[2], fine[1] // 2
    x = [(i + 0.5) * box[0] / fine[0] for i in range(fine[0])]
    return x, [0.5 * (surface_height(alpha[i, j - 1], spacing) + surface_height(alpha[i, j], spacing))
               for i in range(fine[0])]


def crater_depth(heights, level):
    """On the axis: mean of the two columns beside it in each row, below the level at the start, m."""
    middle = len(heights) // 2
    return level - 0.5 * (heights[middle - 1] + heights[middle])


def check_books(record, run, name, back):
    books, conservation = run.results["replacement"], run.results["conservation"]
    record.at_least(f"{name}: spheres that became liquid", books["became_liquid"], 1)
    if back:
        record.at_least(f"{name}: spheres that took their place back", books["took_place_back"], 1)
        balance = abs(books["liquid_in"] - books["liquid_out"] - (books["became_liquid"] - books["took_place_back"]) * VOLUME)
        record.at_most(f"{name}: liquid taken and given back / volume of the sphere", balance / VOLUME, 1e-12)
    record.at_most(f"{name}: worst |change of liquid - volume| / volume", books["volume_error"], 1.7e-14)
    record.at_most(f"{name}: liquid volume, drift", conservation["liquid_volume"], 1e-12)
    record.at_most(f"{name}: solid volume", conservation["solid_volume"], 1.6e-13)
    record.at_most(f"{name}: momentum exchange", conservation["exchange"], 8e-13)
    record.at_most(f"{name}: momentum of the sphere", conservation["momentum"], 7.9e-15)
    record.at_most(f"{name}: booked impulse against the fluid's change", books["impulse_error"], 1e-14)
    record.note(f"{name}: impulse that came with the liquid / (rho V 0.5 m/s)",
                -books["impulse"][2] / (WATER * VOLUME * SPEED))
    own = DENSITY * VOLUME * SPEED
    record.at_most(f"{name}: momentum from outside, with the drop / the sphere's own",
                   max(map(abs, run.results["momentum"]["impulses"]["replacement"])) / own, 1e-14)
    # The drop sticks to the sphere: rho_p/(rho_p + rho) of the speed is left when all of the drop is new liquid.
    row = next(i for i, p in enumerate(run.history["pending_momentum_z"]) if abs(p) > 0.1 * own)
    before, after = (-run.history["particle_momentum_z"][i] / own for i in (row, row + 1))
    record.at_most(f"{name}: velocity of the sphere after its drop has come, over that before", after / before, 0.9)
    record.at_least(f"{name}: the same", after / before, DENSITY / (DENSITY + WATER))
    record.note(f"{name}: fastest fluid", max(run.history["max_speed"]), "m/s")


def beside_another(record, demvof):
    """A bead falls in and another one rises below: what the first displaces no more moves no fluid of the second's. All of the fluid's energy comes from
    the beads', and that from their weights."""
    diameter = 3.5e-3
    case = BoxCase(scratch("replacement") / "beside", (0.02, 0.02, 0.04), (12, 12, 24), (3, 3, 6), 0.06, window=1e-3, level=0.02, dem_step=5e-5,
                   sides={side: Open() if side == "z+" else Wall() for side in SIDES}, tolerance=1e-9,
                   particles=[Particle((0.0103, 0.0097, z), diameter, density) for z, density in ((0.012, 500), (0.028, 2500))],
                   coupling={"phase_interchange": "replacement"}, forces=[{"drag": "schiller_naumann"}, "pressure_gradient", {"added_mass": 0.5}])
    run = case.run(demvof)
    record.at_least("a bead that rises beside: spheres that became liquid", run.results["replacement"]["became_liquid"], 1)
    record.at_most("a bead that rises beside: most energy of the fluid / most of the beads",
                   max(run.history["kinetic_energy"]) / max(run.history["particle_kinetic_energy"]), 0.28)
    record.at_most("a bead that rises beside: fastest fluid", max(run.history["max_speed"]), 0.96, "m/s")
    record.at_most("a bead that rises beside: momentum exchange", run.results["conservation"]["exchange"], 5e-13)


def short(record, demvof, uniform):
    box, level, fine = (0.02, 0.02, 0.06), 0.031, (20, 20, 60)
    if uniform:
        run = enter(scratch("replacement") / "short", demvof, box, level, fine, (4, 4, 12), 0.06, "replacement")
        check_books(record, run, "24k cells", back=True)
        x, heights = profile(run, box, fine)
        record.note("24k cells: crater at the end", crater_depth(heights, level), "m")
    run = enter(scratch("replacement") / "short_refined", demvof, box, level, (5, 5, 15), (4, 4, 12), 0.045, "replacement",
                levels=2)
    check_books(record, run, "refined from 375 cells", back=True)
    record.at_least("refined from 375 cells: changes of the mesh", run.results["cells"]["mesh_changes"], 5)
    record.at_most("refined from 375 cells: warnings of a drop in coarse cells",
                   sum("became liquid with" in line for line in run.results["warnings"]), 0)


def long(record, demvof):
    box, bulk = (0.05, 0.05, 0.20), (10, 10, 40)
    depths = {}
    for interchange, fine, name in (("replacement", (30, 30, 120), "108k"), ("replacement", (50, 50, 200), "500k"),
                                    ("porous", (30, 30, 120), "108k"), ("volume_adding", (30, 30, 120), "108k")):
        level = level_on(box[2] / fine[2], 0.051)
        run = enter(scratch("replacement") / f"{interchange}_{name}", demvof, box, level, fine, bulk, 0.03, interchange)
        x, heights = profile(run, box, fine)
        label = f"{interchange}, {name} cells"
        depths[label] = crater_depth(heights, level)
        record.note(f"{label}: crater at 0.03 s", depths[label], "m")
        record.note(f"{label}: level at the start", run.history["mean_level"][0], "m")
        record.note(f"{label}: run time", run.results["wall_seconds"]["total"], "s")
        record.curve("surface at 0.03 s", "x, m", "height of alpha = 0.5 above the level, m", label, x,
                     [h - level for h in heights], style="-")
        if interchange == "replacement":
            check_books(record, run, label, back=False)
    record.at_most("crater at 0.03 s: 108k against 500k, in cells of the 108k mesh",
                   abs(depths["replacement, 108k cells"] - depths["replacement, 500k cells"]) / (box[0] / 30), 1)


def refined(demvof):
    box, level, fine = (0.05, 0.05, 0.20), 0.051, (50, 50, 200)
    text = (pathlib.Path(__file__).parents[3] / "docs/verification/records/replacement.json").read_text()
    uniform = {check["name"]: check["value"] for check in json.loads(text)["values"]}
    record = Record("replacement_refined", "Phase interchange by replacement on a mesh that refines itself",
                    "The sphere of the record `replacement` enters water on 62 500 cells of 2 mm that refine themselves to "
                    "1 mm at the surface and around the sphere, against 1 mm everywhere (500k). Run times: both "
                    "on a machine that was busy with other work.",
                    "tests/Alltest --verification -- -R pair.replacement_refined")
    run = enter(scratch("replacement") / "refined", demvof, box, level, (25, 25, 100), (10, 10, 40), 0.03, "replacement",
                levels=1)
    check_books(record, run, "refined", back=False)
    x, heights = profile(run, box, fine, refined=True)
    depth, other = crater_depth(heights, level), uniform["replacement, 500k cells: crater at 0.03 s"]
    record.note("refined: most fine cells", run.results["cells"]["fine_max"])
    record.note("refined: crater at 0.03 s", depth, "m")
    record.at_most("crater at 0.03 s: refined against 500k, in cells of 1 mm", abs(depth - other) / 1e-3, 1)
    seconds = run.results["wall_seconds"]["total"]
    record.note("refined: run time", seconds, "s")
    record.note("run time of the 500k / refined", uniform["replacement, 500k cells: run time"] / seconds)
    record.curve("surface at 0.03 s", "x, m", "height of alpha = 0.5 above the level, m", "refined", x,
                 [h - level for h in heights], style="-")
    return record.write()


def main():
    if "--refined" in sys.argv:
        return refined(sys.argv[1])
    is_long = "--long" in sys.argv
    record = Record("replacement", "Phase interchange by replacement: a sphere enters water",
                    "A sphere of 4 mm (2000 kg/m3) at 0.5 m/s just above a water surface is replaced by a drop of its "
                    "volume and velocity on the fine mesh, and takes its place back under water. Liquid taken and "
                    "given back equals its volume to round-off; its momentum comes out of the sphere's. Crater: depth, below the level "
                    "at the start, of alpha = 0.5 as seen from above on the axis through the impact (mean of the four "
                    "columns of cells around it) at 0.03 s; the paper's claim (7.2) is that 108k and 500k cells agree.",
                    f"tests/Alltest {'--verification ' if is_long else ''}-- -R pair.replacement{'_long' if is_long else ''}")
    beside_another(record, sys.argv[1])
    short(record, sys.argv[1], uniform=is_long)
    if is_long:
        long(record, sys.argv[1])
    return record.write()


if __name__ == "__main__":
    sys.exit(main())
