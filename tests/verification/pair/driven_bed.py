# SPDX-License-Identifier: GPL-3.0-or-later
"""Flow that a pressure difference drives through held spheres: nothing but the exchange of momentum holds it back.

    rho du/dt = dp/L - G(eps u)    G(U) = 150 mu (1 - eps)^2 U/(eps^3 d^2) + 1.75 rho (1 - eps) U^2/(eps^3 d)

u: velocity between the spheres, m/s. Ergun, Chem. Eng. Prog. 48 (1952) 89. Started 10 % off the velocity of the end, with
windows of 0.1 to 100 times eps rho/K; and from rest, through a bed between clear fluid:

    w = w_end (1 - exp(-t/tau)),    tau = rho (L_free + L_bed/eps)/(C L_bed/eps^2)

w: superficial velocity, m/s; C: drag per volume and velocity, kg/m3/s.

Usage: driven_bed.py DEMVOF [--long]"""
import concurrent.futures
import itertools
import math

import numpy
from box_case import BoxCase, Outlet, Particle, Slip, command_line, momentum_of_everything, scratch
from record import Record

DIAMETER, DENSITY, EPS = 1e-3, 1000.0, 0.48
SPACING = DIAMETER * (math.pi / (6 * (1 - EPS)))**(1 / 3)  # of a cubic lattice: the spheres just touch
CELLS, PER_CELL = 4, 2  # bulk cells along the bed, particles per cell and direction
VELOCITY = 0.05  # superficial, at the end, m/s
WINDOWS = {"staggered": 12, "concurrent": 24}
JUDGED = {"staggered": 2, "concurrent": 10}  # windows after which it has to be there


class Ergun:
    """Pressure gradient G(U) = a U + b U^2 of the bed at a particle Reynolds number rho U d/mu of the end."""

    def __init__(self, reynolds):
        self.viscosity = DENSITY * VELOCITY * DIAMETER / reynolds
        self.a = 150 * self.viscosity * (1 - EPS)**2 / (EPS**3 * DIAMETER**2)
        self.b = 1.75 * DENSITY * (1 - EPS) / (EPS**3 * DIAMETER)

    def __call__(self, superficial):
        return self.a * superficial + self.b * superficial * abs(superficial)

    def exact(self, start, times):
        """Superficial velocity: dU/dt = -(eps b/rho) (U - U_1)(U - U_2), whose ratio decays exponentially."""
        other = -VELOCITY - self.a / self.b  # the other root of G(U) = G(VELOCITY)
        rate = EPS * self.b / DENSITY * (VELOCITY - other)
        ratio = (start - VELOCITY) / (start - other) * numpy.exp(-rate * numpy.asarray(times))
        return (VELOCITY - other * ratio) / (1 - ratio)


def Driving(pressure):
    """The fluid comes in under this pressure, Pa."""
    return {"type": "patch", "U": "pressureInletOutletVelocity; value uniform (0 0 0)",
            "p_rgh": f"fixedValue; value uniform {pressure:.17g}", "alpha.water": "inletOutlet; inletValue uniform 1; "
            "value uniform 1"}


def sides(pressure):
    return {**{side: Slip() for side in ("x-", "x+", "y-", "y+")}, "z-": Driving(pressure), "z+": Outlet()}


def simulate(demvof, reynolds, stiffness, schedule):
    """Superficial velocity over that of the end, its exact value and the error of the exchange, per window."""
    edge, length = PER_CELL * SPACING, CELLS * PER_CELL * SPACING
    ergun = Ergun(reynolds)
    drag = ergun(VELOCITY) * EPS**2 / VELOCITY  # K: grad p = K u / eps, u = U / eps
    window = float(f"{stiffness * DENSITY * EPS / drag:.6g}")
    start = 0.9 * VELOCITY
    case = BoxCase(scratch(f"driven_bed/{reynolds:g}_{stiffness:g}_{schedule}"), (edge, edge, length),
                   (1, 1, 2 * CELLS), (1, 1, CELLS), WINDOWS[schedule] * window, window,
                   sides=sides(ergun(VELOCITY) * length), gravity=(0, 0, 0),
                   liquid=(DENSITY, ergun.viscosity / DENSITY), velocity=(0, 0, start / EPS),
                   forces=[{"drag": "gidaspow"}, "pressure_gradient"], first_step=window / 20, longest_step=window / 20,
                   coupling={"schedule": schedule, "averaging": {"kernel": "centre"}})
    across, along = range(PER_CELL), range(CELLS * PER_CELL)
    for place in itertools.product(across, across, along):
        case.particles.append(Particle([(i + 0.5) * SPACING for i in place], DIAMETER, 2500, held=True))
    run = case.run(demvof)
    velocity = run.history["fluid_momentum_z"] / (DENSITY * edge * edge * length)
    return {"reynolds": reynolds, "stiffness": stiffness, "schedule": schedule, "velocity": velocity / VELOCITY,
            "exact": ergun.exact(start, run.times) / VELOCITY, "exchange": run.results["conservation"]["exchange"]}


def error(run, windows):
    return abs(run["velocity"][windows] - run["exact"][windows])


def growth(run):
    """Largest distance from the end velocity, over that of the start."""
    return max(abs(run["velocity"][1:] - 1)) / abs(run["velocity"][0] - 1)


def impulsive_start(demvof, window, schedule):
    """Response time over the exact one: half a box of spheres, so large and slow that their drag is linear."""
    eps, coefficient, cells, end = 0.45, 1e5, 20, 2e-4
    diameter, edge = 0.01, 0.01 * (math.pi / (6 * 0.55))**(1 / 3)
    viscosity = coefficient * diameter**2 * eps / (150 * (1 - eps)**2)  # C = 150 mu (1 - eps)^2/(eps d^2): Ergun's
    bed, free = cells / 2 * edge, cells / 2 * edge
    tau = DENSITY * (free + bed / eps) / (coefficient * bed / eps**2)
    case = BoxCase(scratch(f"driven_bed/start_{window:g}_{schedule}"), (edge, edge, cells * edge), (1, 1, 2 * cells),
                   (1, 1, cells), round(2 * tau / window) * window, window,
                   sides=sides(coefficient / eps**2 * bed * end), gravity=(0, 0, 0),
                   liquid=(DENSITY, viscosity / DENSITY), forces=[{"drag": "gidaspow"}, "pressure_gradient"],
                   first_step=window / 10, longest_step=window / 10, courant=10,
                   coupling={"schedule": schedule, "averaging": {"kernel": "centre"}})
    for k in range(cells // 4, 3 * cells // 4):
        case.particles.append(Particle([edge / 2, edge / 2, (k + 0.5) * edge], diameter, 2500, held=True))
    run = case.run(demvof)
    velocity = run.history["fluid_momentum_z"] / (DENSITY * edge * edge * cells * edge * end)
    inside = (velocity > 0.3) & (velocity < 0.8)
    return run.times, velocity, -1 / numpy.polyfit(run.times[inside], numpy.log(1 - velocity[inside]), 1)[0] / tau, tau


def main():
    options = command_line()
    record = Record(
        "driven_bed", "Bed driven by pressure",
        f"Flow through {PER_CELL**3 * CELLS} spheres held on a cubic lattice, void fraction {EPS}, driven by a pressure difference and "
        "started 10 % slower than it ends, from viscous to inertial flow and from drag that the window resolves to drag a "
        "hundred times stiffer; against the exact solution with Ergun's equation. And the start from rest through a bed between "
        "clear fluid, whose pores hold fluid of 1/eps times the inertia.",
        "tests/Alltest --verification -- -R pair.driven_bed_long" if options.long else "tests/Alltest -- -R 'pair.driven_bed$'")
    cases = [(1, 100), (1000, 10)]
    if options.long:
        cases = list(itertools.product([1, 10, 100, 1000], [0.1, 1, 10, 100]))
    cases = [(*case, schedule) for case in cases for schedule in ("staggered", "concurrent")]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda case: simulate(options.demvof, *case), cases))
    for schedule, windows in JUDGED.items():
        some = [run for run in runs if run["schedule"] == schedule]
        record.at_most(f"{schedule}: error of the velocity after {windows} windows, worst",
                       max(error(r, windows) for r in some), 1e-3)
        record.at_most(f"{schedule}: largest distance from the end velocity over the first, worst",
                       max(growth(r) for r in some), 1 if options.long else 0.17)
        record.at_most(f"{schedule}: error at the end, worst", max(error(r, -1) for r in some), 1e-3)
        record.at_most(f"{schedule}: exchange of momentum open", max(r["exchange"] for r in some), 1.9e-14)
        for r in some:
            record.curve(f"Velocity, Re {r['reynolds']:g}, {schedule}", "window", "U / U_end", f"K dt/(rho eps) = {r['stiffness']:g}",
                         range(len(r["velocity"])), r["velocity"])
    starts = [(5e-4, "staggered")] + ([(5e-4, "concurrent"), (2.5e-4, "staggered"), (2.5e-4, "concurrent")] if options.long else [])
    for window, schedule in starts:
        times, velocity, ratio, tau = impulsive_start(options.demvof, window, schedule)
        record.at_most(f"start from rest, {schedule}, window {window * 1e3:g} ms: response time off by", abs(ratio - 1), 0.01)
        record.curve("Start from rest", "t / tau", "w / w_end", f"{schedule}, {window * 1e3:g} ms", times / tau, velocity)
    momentum_of_everything(record, 1e-8 if options.long else 1.7e-13)
    raise SystemExit(record.write())


main()
