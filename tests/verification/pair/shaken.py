# SPDX-License-Identifier: GPL-3.0-or-later
"""Gravity of a table: both sides follow it, window by window.

  neutral     beads as heavy as the water, in a closed tank full of it: nothing moves against the tank
  falling     a bead that feels no fluid:          v = integral of g
  sinking     a bead that feels its buoyancy only: v = (1 - rho/rho_p) integral of g
  alone       water without particles, in the same tank: p = rho g.x
  tilted      a constant table against the same constants in constant/g and fix gravity

LIGGGHTS's velocity at the end of a window has half a DEM step of the window's own gravity in place of the first one's:
dt/2 (g_1 - g_n) beside the integral. Usage: shaken.py DEMVOF [--long]"""
import subprocess

import numpy
from box_case import BoxCase, Open, Particle, Run, SIDES, Wall, command_line, momentum_of_everything, particle_states, scratch
from record import Record

WATER, WINDOW, WINDOWS, STEPS = 1000.0, 1e-3, 30, 20
# Knots inside windows, more than one in some; the last one before the end.
TABLE = [[-0.001, 0, 0, -9.81], [0.0021, 3, -1, -9.81], [0.0043, -6, 2, -5], [0.0046, 4, 0, -14], [0.0207, 5, 1, -2],
         [0.0263, -2, 0, -9.81]]
SLANT = (2.0, 0.5, -9.0)
BOX, CELLS = (0.04, 0.02, 0.04), (8, 4, 8)


def means(window, windows):
    """Of the table over each window: trapezia between its knots and the windows' ends."""
    table, ends = numpy.array(TABLE), window * numpy.arange(windows + 1)
    places = numpy.union1d(ends, table[:, 0][(table[:, 0] > 0) & (table[:, 0] < ends[-1])])
    found = []
    for axis in (1, 2, 3):
        values = numpy.interp(places, table[:, 0], table[:, axis])
        pieces = numpy.concatenate([[0], numpy.cumsum(numpy.diff(places) * 0.5 * (values[1:] + values[:-1]))])
        found.append(numpy.diff(pieces[numpy.searchsorted(places, ends - 1e-12)]) / window)
    return numpy.array(found).T


def closed_tank(name, beads, table=None, **keys):
    keys = {"contacts": True, **keys}
    sections = {**keys.pop("sections", {}), "gravity": {"table": table or TABLE}}
    return BoxCase(scratch(f"shaken/{name}"), BOX, CELLS, CELLS, WINDOWS * WINDOW, WINDOW, particles=beads, dem_step=WINDOW / STEPS,
                   sections=sections, output_interval=10 * WINDOW, **keys)


def neutral(demvof, name, coupling=None, halves=False):
    """Largest speed of beads or water. halves: the run is stopped and continued."""
    beads = [Particle((0.006 + 0.004 * i, 0.006 + 0.004 * j, 0.014 + 0.006 * k), 3e-3, WATER)
             for i in range(5) for j in range(3) for k in range(3)]
    forces = [{"drag": "gidaspow"}, "pressure_gradient", {"added_mass": 0.5}]
    case = closed_tank(f"neutral_{name}", beads, forces=forces, coupling=coupling or {})
    run = case.run(demvof, *(["--set", f"coupling.end_time={WINDOWS // 2 * WINDOW}"] if halves else []))
    if halves:
        subprocess.run([demvof, "run", case.folder / "case.yaml", "--out", run.folder, "--continue"], stdout=subprocess.DEVNULL, check=True)
        run = Run(run.folder)
    if run.results["relaxation"]["smallest"] == 1 and not coupling:
        raise RuntimeError("nothing of what the beads are told is relaxed, as it was meant to be")
    state = particle_states(run.folder)
    return max(numpy.abs(state["velocity"]).max(), run.history["max_speed"].max())


def lone(demvof, name, density, forces, factor):
    """Error of the bead's velocity in the end, over the largest on its way."""
    bead = Particle((0.02, 0.01, 0.02), 2e-3, density)
    run = closed_tank(name, [bead], forces=forces, sections={"scene": {"porosity": "off"}}).run(demvof)
    g = factor * means(WINDOW, WINDOWS)
    integral = WINDOW * numpy.cumsum(g, axis=0)
    exact = integral[-1] + 0.5 * WINDOW / STEPS * (g[0] - g[-1])
    error = numpy.abs(particle_states(run.folder)["velocity"][0] - exact).max() / numpy.abs(integral).max()
    return error, run.history["max_speed"].max()


def alone(demvof):
    """Water alone, in a closed tank full of it, is at rest: p = rho g.(x - x_1), x_1 of the cell with p = 0. Error of
    the integral of p^2 over the largest, worst step."""
    case = closed_tank("alone", [], longest_step=WINDOW)
    run = case.run(demvof)
    edges = [(numpy.arange(n) * length / n) for n, length in zip(CELLS, BOX)]
    along = numpy.array([x.ravel() for x in numpy.meshgrid(*edges, indexing="ij")])  # x - x_1
    exact = (WATER * means(WINDOW, WINDOWS) @ along)**2 @ numpy.full(along.shape[1], numpy.prod(BOX) / along.shape[1])
    return numpy.abs(run.history["pressure_squared_integral"][1:] - exact).max() / exact.max()


def tilted(demvof, name, *options, inputs=(0, 0, -9.81), table=None, windows=WINDOWS, **keys):
    """The same tank, half full and open, by a table and by constants: largest difference of any row of history.csv.

    inputs: what constant/g and fix gravity say beside the table."""
    beads = [Particle((0.01 + 0.005 * i, 0.007 + 0.006 * (i % 2), 0.012 + 0.004 * (i % 3)), 3e-3, 1500) for i in range(5)]
    sections = keys.pop("sections", {})
    h_ref = ("FoamFile { version 2.0; format ascii; class uniformDimensionedScalarField; object hRef; }\n"
             "dimensions [0 1 0 0 0 0 0];\nvalue 0.02;\n")
    runs = []
    for way in ("table", "constants"):
        more = {"gravity": {"table": table or [[0, *SLANT]]}} if way == "table" else {}
        case = BoxCase(scratch(f"shaken/tilted_{name}_{way}"), BOX, CELLS, CELLS, windows * WINDOW, WINDOW, particles=beads, level=0.02,
                       contacts=True, dem_step=WINDOW / STEPS, gravity=inputs if way == "table" else SLANT,
                       sides={side: Open() if side == "z+" else Wall() for side in SIDES}, sections={**sections, **more},
                       extra_files={"fluid/constant/hRef": h_ref}, **keys)
        runs.append(case.run(demvof, *options))
    by_table, by_constants = (run.history for run in runs)
    worst = 0
    for quantity, values in by_constants.items():
        if quantity.startswith("max_speed_"):
            continue  # a place may change from one cell to another of the same speed
        family = [other for other in by_constants if quantity[-2:] in ("_x", "_y", "_z") and other[:-2] == quantity[:-2]]
        scale = max(numpy.abs(by_constants[other]).max() for other in family or [quantity]) or 1
        # The first row's forces are those of the script.
        worst = max(worst, numpy.abs(by_table[quantity][1:] - values[1:]).max() / scale)
    return worst


def main():
    options = command_line()
    demvof = options.demvof
    record = Record("shaken", "A tank that is shaken",
                    f"Gravity of a table that turns and changes by up to 10 m/s2 within {WINDOWS} windows, its knots inside them; "
                    "closed tanks full of water, and a half-full one whose table is constant.",
                    "tests/Alltest --verification -- -R pair.shaken_long" if options.long else "tests/Alltest -- -R 'pair.shaken$'")
    adaptive = {"window": {"tolerance": 1e-2, "shortest": 2e-4, "longest": 2e-3}}
    what = "neutral beads in a tank full of water: speed of water or beads, m/s"
    record.at_most(what, neutral(demvof, "staggered"), 3e-15)
    for way, coupling in (("concurrent", {"schedule": "concurrent"}), ("windows of their own lengths", adaptive),
                          ("order 2 in the window", {"order": 2})):
        record.at_most(f"the same, {way}", neutral(demvof, way.split()[0], coupling=coupling), 3e-15)
    record.at_most("the same, stopped and continued", neutral(demvof, "continued", halves=True), 3e-15)
    error, _ = lone(demvof, "falling", 2500, [], 1)
    record.at_most("a bead that feels no fluid: velocity off the integral of gravity", error, 8e-14)
    error, speed = lone(demvof, "sinking", 2500, ["pressure_gradient"], 1 - WATER / 2500)
    record.at_most("a bead that feels its buoyancy alone: velocity off its share of that", error, 7e-14)
    record.at_most("the same: speed of the water, m/s", speed, 6e-16)
    record.at_most("the same tank without particles: integral of p^2 in any step", alone(demvof), 1e-13)
    record.at_most("constant table against constants: any quantity in any row", tilted(demvof, "pair"), 6e-12)
    record.at_most("the same, two ranks on each side", tilted(demvof, "ranks", "--fluid-ranks", "2", "--particle-ranks", "2"), 7e-12)
    record.at_most("the same, without particles", tilted(demvof, "alone", "--set", "scene.particles=off"), 0)
    rises = [[0, *(0.5 * g for g in SLANT)], [WINDOW, *(1.5 * g for g in SLANT)]]
    record.at_most("first window of a table that rises against that of its mean", tilted(demvof, "rises", table=rises, windows=1), 6e-13)
    # With another gravity in constant/g the pressure of the start would be balanced once more, with the beads in it. The
    # solver of the pressure stops at 1e-10, somewhere else in each step.
    trembles = [[WINDOW * (1 + n / 3), *(g * (1 + (n > 0) * (-1)**n * 1e-13) for g in SLANT)] for n in range(3 * WINDOWS)]
    record.at_most("the same, mesh that refines itself, a table that trembles by 1e-13",
                   tilted(demvof, "refined", inputs=SLANT, table=trembles, sections={"fluid": {"refinement": {"levels": 1}}}), 1.2e-6)
    momentum_of_everything(record, 3.1e-14)
    raise SystemExit(record.write())


main()
