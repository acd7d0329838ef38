# SPDX-License-Identifier: GPL-3.0-or-later
"""A suspension that starts to sink, or to rise, in a closed column: particles and fluid push each other about.

Everything that goes down makes the fluid go up, eps u + eps_s v = 0, and with Stokes drag, away from the ends,

    v(t) = v_s (1 - exp(-t/T)),   v_s = (rho_p - rho) g eps_s eps^2 / K,   T = (rho_p + rho s) eps_s eps^2 / K
    s = eps_s / eps,  K = n beta

Density ratio, solid fraction and stiffness x = beta window/m are varied over many decades; nothing moves far, so that
the problem stays linear. Usage: moving_beds.py DEMVOF [--long]"""
import concurrent.futures
import itertools
import math

import numpy
from box_case import BoxCase, Cyclic, Particle, SIDES, Slip, command_line, momentum_of_everything, particle_states, scratch
from record import Record

DIAMETER, DENSITY, VISCOSITY = 2e-3, 1000.0, 1.0  # m, kg/m3, Pa s
BETA = 3 * math.pi * VISCOSITY * DIAMETER
VOLUME = math.pi / 6 * DIAMETER**3
ACROSS, LAYERS = 4, 24  # particles
WINDOWS = 40


class Bed:
    """What is exact of one suspension. density: rho_p/rho; x: beta window/m."""

    def __init__(self, density, solid, x, touching=False):
        """touching: side by side, pressed together by 1e-7 of a diameter across (more, and the layers buckle); solid then
        is 0.499."""
        self.width, self.height = ((1 - 1e-7) * DIAMETER, 1.05 * DIAMETER) if touching else 2 * ((VOLUME / solid) ** (1 / 3),)
        solid = VOLUME / (self.width**2 * self.height)
        self.density, self.solid, self.x = density, solid, x
        self.steps = 100 if x >= 10 else 4  # of the DEM in a window; LIGGGHTS's first half step knows no fluid
        eps = 1 - solid
        self.window = float(f"{x * density * DENSITY * VOLUME / BETA:.6g}")
        if touching:  # damping of contacts, 500/s, in explicit steps
            self.steps = max(self.steps, math.ceil(self.window / 2e-4))
        drag = BETA * solid / VOLUME
        inertia = (density + solid / eps) * DENSITY  # of particles and fluid
        self.time = inertia * solid * eps**2 / drag
        self.alone = 1 / eps**2  # end velocity in fluid at rest, which nobody makes way for, over the end velocity
        travel = 1e-4 * self.width / WINDOWS  # in a window, at the end velocity
        self.end = travel / self.window * numpy.sign(1 - density)
        self.gravity = abs(self.end) * drag / (abs(density - 1) * DENSITY * solid * eps**2)

    def velocity(self, t):
        return self.end * -numpy.expm1(-t / self.time)

    def case(self, name, coupling):
        upper = (ACROSS * self.width, ACROSS * self.width, LAYERS * self.height)
        cells = (ACROSS // 2, ACROSS // 2, LAYERS // 2)
        step = self.window / self.steps
        stiffness = 0.5 * self.density * DENSITY * VOLUME * (math.pi / (20 * step))**2  # a collision: 20 steps
        case = BoxCase(scratch(f"moving_beds/{name}"), upper, cells, cells, WINDOWS * self.window, self.window,
                       sides={side: Cyclic() for side in SIDES}, gravity=(0, 0, -self.gravity),
                       liquid=(DENSITY, VISCOSITY / DENSITY), dem_step=step, stiffness=stiffness,
                       coupling=coupling, tolerance=1e-13, output_interval=self.window,
                       history_interval=self.window, pimple="momentumPredictor yes;",
                       velocity_solver="solver PBiCGStab; preconditioner DILU; tolerance 1e-15; relTol 0;")
        case.sides.update({"z-": Slip(), "z+": Slip()})
        for place in itertools.product(range(ACROSS), range(ACROSS), range(LAYERS)):
            at = [(k + 0.5) * pitch for k, pitch in zip(place, (self.width, self.width, self.height))]
            case.particles.append(Particle(at, DIAMETER, self.density * DENSITY))
        return case


def simulate(demvof, name, bed, **coupling):
    case = bed.case(name, coupling)
    try:
        return bed, case.run(demvof)
    except RuntimeError:  # it broke: particles gone, no room for the fluid, no number
        return bed, None


def measure(bed, run):
    if run is None:
        return {"bed": bed, "failed": True, "largest": math.inf, "end": math.inf, "relaxation": 1, "exchange": math.inf}
    mass = ACROSS**2 * LAYERS * bed.density * DENSITY * VOLUME
    speed = numpy.sqrt(2 * run.history["particle_kinetic_energy"] / mass)  # rms, the ends of the column included
    state = particle_states(run.folder)
    middle = abs(state["position"][:, 2] / (LAYERS * bed.height) - 0.5) < 0.25
    exact = bed.velocity(WINDOWS * bed.window)
    return {"bed": bed, "failed": False, "largest": float(speed.max() / abs(bed.end)),
            "end": float(abs(state["velocity"][middle, 2].mean() / exact - 1)),
            "history": (numpy.array(run.history["time"]) / bed.window, speed / abs(bed.end)),
            "relaxation": run.results["relaxation"]["smallest"],
            "exchange": run.results["conservation"]["exchange"]}


def sweep(long):
    densities = [0.01, 0.03, 0.1, 0.3, 0.8, 1.2, 2.5, 8, 30] if long else [0.03, 1.2, 2.5]
    solids = [0.1, 0.3, 0.5] if long else [0.5]
    stiffnesses = [0.01, 0.1, 1, 10, 100, 1e3] if long else [0.1, 100]
    for density, solid, x in itertools.product(densities, solids, stiffnesses):
        yield Bed(density, solid, x)
    for density, x in itertools.product([0.1, 0.5, 2.5, 8] if long else [2.5], [0.1, 1, 10, 100] if long else [10]):
        yield Bed(density, 0, x, touching=True)


def main():
    options = command_line()
    record = Record(
        "moving_beds", "Beds that move: particles and fluid that make way for each other",
        "A suspension in a closed column starts to sink or to rise in Stokes drag, with the density of the particles from "
        "0.01 to 30 times that of the fluid, solid fractions up to 0.5 and windows from a hundredth of the particles' "
        "response time to a thousand times it; in some runs all of them touch and move as one. The exact velocity is "
        "known. What the particles did in a window comes back as pressure; without relaxation (theory.md) light and dense beds grow without bound.",
        "tests/Alltest --verification -- -R pair.moving_beds_long" if options.long else "tests/Alltest -- -R 'pair.moving_beds$'")
    beds = list(sweep(options.long))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        done = pool.map(lambda numbered: simulate(options.demvof, f"bed{numbered[0]}", numbered[1]), enumerate(beds))
    runs = [measure(bed, run) for bed, run in done]
    judge(record, runs)
    if options.long:
        concurrently(record, options.demvof)
        pictures(record, runs)
    momentum_of_everything(record, 1e-8 if options.long else 1.8e-13)
    raise SystemExit(record.write())


def grown(runs):
    return int(sum(run["largest"] > 1.5 * run["bed"].alone for run in runs))


def judge(record, runs):
    record.note("runs", len(runs))
    record.at_most("runs that end with an error", sum(run["failed"] for run in runs), 0)
    record.at_most("runs that grow", grown(runs), 0)
    record.at_most("largest velocity over the end velocity in fluid at rest, which the first window starts from",
                   max(run["largest"] / run["bed"].alone for run in runs), 1.05)
    settled = [run for run in runs if WINDOWS * run["bed"].window > 5 * run["bed"].time]
    record.at_most("velocity at the end against the exact one, runs of five response times or more",
                   max(run["end"] for run in settled), 0.01)
    record.note("the same, all runs", max(run["end"] for run in runs))
    record.at_most("exchange of momentum open", max(run["exchange"] for run in runs), 9.8e-14)
    record.note("smallest relaxation factor", float(min(run["relaxation"] for run in runs)))


def concurrently(record, demvof):
    """The same with a window of lag."""
    for solid in (0.1, 0.3, 0.5):
        beds = [Bed(density, solid, x) for density in (0.1, 0.8, 2.5, 8) for x in (0.1, 1, 10, 100)]
        runs = [measure(*simulate(demvof, "concurrent", bed, schedule="concurrent")) for bed in beds]
        record.at_most(f"concurrent, solid fraction {solid:g}: runs that grow, of {len(runs)}", grown(runs), 0)
        record.at_most(f"concurrent, solid fraction {solid:g}: runs that end with an error", sum(r["failed"] for r in runs), 0)


def pictures(record, runs):
    for run in runs:
        bed = run["bed"]
        if abs(bed.solid - 0.5) < 1e-9 and (bed.density, bed.x) in ((0.03, 0.1), (0.03, 100), (2.5, 100), (2.5, 0.1)):
            windows, speed = run["history"]
            record.curve("Velocity of the bed over its end velocity, solid fraction 0.5", "windows", "v / v_s",
                         f"density {bed.density:g}, x = {bed.x:g}", windows, speed)
    for x in sorted({run["bed"].x for run in runs}):
        some = [run for run in runs if run["bed"].x == x and abs(run["bed"].solid - 0.5) < 1e-9]
        record.curve("Largest velocity over the end velocity, solid fraction 0.5", "density over that of the fluid",
                     "largest v / v_s", f"x = {x:g}", [run["bed"].density for run in some],
                     [run["largest"] for run in some], "x")


main()
