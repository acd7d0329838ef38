# SPDX-License-Identifier: GPL-3.0-or-later
"""Fluid and particles in one bulk cell come to a common velocity, at any stiffness and mass loading.

A periodic box holds eight particles at rest; the fluid moves. In Stokes drag this is linear, and each exchange scheme is
a small matrix from window to window (class Map). The real pair must follow it: its stability, its momentum, its
equilibrium. Usage: two_body_relaxation.py DEMVOF [--long]"""
import concurrent.futures
import itertools
import math

import numpy
from box_case import BoxCase, Cyclic, Particle, SIDES, command_line, scratch
from record import Record

SPEED = 1e-8       # of the fluid at the start, m/s: Re = 2e-8, drag is 3 pi mu d to 6 digits
EDGE, DIAMETER = 0.01, 2e-3
DENSITY, VISCOSITY = 1000.0, 1.0  # kg/m3, Pa s
COUNT = 8
DEM_STEPS = 4             # in a window
SOLID = COUNT * math.pi / 6 * DIAMETER**3
VOLUME_RATIO = SOLID / (EDGE**3 - SOLID)
FLUID_MASS = DENSITY * (EDGE**3 - SOLID)
DRAG_FACTOR = COUNT * 3 * math.pi * VISCOSITY * DIAMETER  # kg/s
SCHEMES = ("explicit", "semi_implicit", "conservative_implicit")
SCHEDULES = ("staggered", "concurrent")
HELD = {"free": 0.0, "half held": 0.5, "held": 1.0}


class Map:
    """One window for the state (u, v, m, j, felt, seen, before): fluid, free particles, left-over; of the particles'
    last window drag impulse and fluid velocity felt; of the coming one the fluid velocity that is told, but for what is
    continued with order 2, and the fluid of a window before. Masses over the fluid's, time over the window. stiffness:
    K dt/(rho eps); loading: mass of all particles over the fluid's."""

    def __init__(self, scheme, schedule, stiffness, loading, held, order=1):
        self.scheme, self.schedule, self.stiffness, self.held = scheme, schedule, stiffness, held
        self.mass = loading * (1 - held)
        free, free_volume = (1 - held) * stiffness, (1 - held) * VOLUME_RATIO
        self.decay = -math.expm1(-free / self.mass) if free > 0 else 0
        self.response = held * stiffness + self.mass * self.decay
        # coupler/exchange/relaxation.hpp
        theta = self.decay * self.mass / free if free > 0 else 1
        inertial, following = theta * free_volume * VOLUME_RATIO / loading, (1 - theta) * free_volume
        gain = 1.5 * inertial + following * (1 + 0.3 * following + 4 * max(VOLUME_RATIO - following, 0))
        answer = self.response if scheme == "conservative_implicit" else 0
        self.relaxation = min(1, 1.2 / (1 + gain) if schedule == "staggered" else 1 / (0.3 + 0.8 * min(answer, 2) + 3 * gain))
        if scheme == "conservative_implicit":
            share = held * stiffness / (stiffness - self.mass * self.decay)
            kept = (2 + share * stiffness) / (2 + stiffness)
            kept = min(1, 1.4 * kept) if schedule == "staggered" else kept**1.5
            part = min(1, share / 0.15)
            self.relaxation *= (1 - part + part * kept) / (1 + 3 * share * (1 - share) * max(0, VOLUME_RATIO - 1.2))
        # coupler/exchange/continuation.hpp
        self.continued = max(0, 1 - 4 * (1 - self.relaxation)) if order == 2 else 0
        self.matrix = numpy.array([self.window(unit) for unit in numpy.eye(7)]).T

    def window(self, now, first=False):
        u, v, m, j, felt, seen, before = now
        ahead = 0.5 * self.continued * (u - before)
        told = seen + ahead
        free, held = (1 - self.held) * self.stiffness, self.held * self.stiffness
        push = (1 - self.held) * m
        new_v, new_j, response = v, held * told, self.response
        if free > 0:
            target = told + push / free
            # The first one begins with half a DEM step (dem_side/forces.hpp): velocities are those of half steps.
            decay = -math.expm1(-free / self.mass * (1 + 0.5 / DEM_STEPS)) if first else self.decay
            new_v = v + (target - v) * decay
            new_j += self.mass * (new_v - v) - push
        if self.schedule == "concurrent" and first:  # what the fluid of the start asks for
            seen_j, seen_u, seen_v = 0, v, v
        elif self.schedule == "concurrent":
            seen_j, seen_u, seen_v = j, felt, v
        else:
            seen_j, seen_u, seen_v = new_j, told, new_v
        if self.scheme == "explicit":
            new_u, new_m = u - seen_j, 0
        elif self.scheme == "semi_implicit":
            new_u, new_m = (u + free * seen_v) / (1 + self.stiffness), 0
        else:
            seen_u += ahead  # expected at the window's end
            new_u = (u - seen_j + response * seen_u) / (1 + response)
            new_m = response * (new_u - seen_u)
        return [new_u, new_v, new_m, new_j, told, seen + self.relaxation * (new_u - seen), u]

    def growth(self):
        return abs(numpy.linalg.eigvals(self.matrix)).max()

    def run(self, windows):
        """Fluid and free-particle velocity at the end of each window, in units of the start's."""
        state, rows = numpy.array([1.0, 0, 0, 0, 1.0, 1.0, 1.0]), []
        for n in range(windows):
            state = self.matrix @ state if n else numpy.array(self.window(state, first=True))
            rows.append(state[:2])
        return numpy.array(rows)


def windows_of(mapping, wanted):
    """As many as wanted, but none after the prediction has grown a thousandfold."""
    size = abs(mapping.run(wanted)).max(axis=1)
    grown = numpy.flatnonzero(size > 1e3)
    return int(grown[0]) + 1 if len(grown) else wanted


def simulate(demvof, name, scheme, schedule, stiffness, loading, held, wanted, order=1):
    mapping = Map(scheme, schedule, stiffness, loading, held, order)
    windows = windows_of(mapping, wanted)
    window = float(f"{stiffness * FLUID_MASS / DRAG_FACTOR:.6g}")
    case = BoxCase(scratch(f"two_body_relaxation/{name}"), (EDGE, EDGE, EDGE), (2, 2, 2), (1, 1, 1),
                   windows * window, window, sides={side: Cyclic() for side in SIDES}, gravity=(0, 0, 0),
                   liquid=(DENSITY, VISCOSITY / DENSITY), velocity=(SPEED, 0, 0), dem_step=window / DEM_STEPS,
                   tolerance=1e-30, pimple="momentumPredictor yes;",  # viscosity acts within a step
                   velocity_solver="solver PBiCGStab; preconditioner DILU; tolerance 1e-15; relTol 0;",
                   coupling={"schedule": schedule, "exchange": scheme, "order": order, "averaging": {"kernel": "centre"},
                             "mapping": {"to_fine": "nearest", "to_bulk": "nearest"}})
    places = itertools.product((0.25 * EDGE, 0.75 * EDGE), repeat=3)
    for i, place in enumerate(places):
        case.particles.append(Particle(place, DIAMETER, loading * FLUID_MASS / SOLID, held=i < held * COUNT))
    run = case.run(demvof)
    fluid = run.history["fluid_momentum_x"] / (FLUID_MASS * SPEED)
    free_mass = loading * (1 - held)
    particles = run.history["particle_momentum_x"] / (FLUID_MASS * SPEED)
    pending = run.history["pending_momentum_x"] / (FLUID_MASS * SPEED)
    predicted = Map(scheme, schedule, window * DRAG_FACTOR / FLUID_MASS, loading, held, order).run(windows)
    velocity = numpy.column_stack([fluid[1:], particles[1:] / free_mass if free_mass else 0 * fluid[1:]])
    linear = abs(predicted).max(axis=1) < 1e3  # beyond, particles run through the box, and meet
    total = fluid + particles + pending
    return {"scheme": scheme, "schedule": schedule, "stiffness": stiffness, "loading": loading, "held": held,
            "velocity": velocity, "growth": mapping.growth(),
            "off_map": abs(velocity - predicted)[linear].max(initial=0) / abs(predicted[linear]).max(initial=1),
            "largest": abs(velocity).max(),
            "momentum": abs(total - total[0]).max() / abs(numpy.stack([fluid, particles, pending])).max(),
            "exchange": run.results["conservation"]["exchange"],
            "seconds": run.results["wall_seconds"]["total"]}


def run_through(demvof, schedule):
    """Particles that run through bulk cells, so that some are gone when the fluid hands over what is left."""
    length = 4 * EDGE
    case = BoxCase(scratch(f"two_body_relaxation/run_through_{schedule}"), (length, EDGE, EDGE), (16, 4, 4), (8, 2, 2),
                   0.04, 1e-3, sides={side: Cyclic() for side in SIDES}, gravity=(0, 0, 0), liquid=(DENSITY, 1e-4),
                   velocity=(0.5, 0, 0), dem_step=1e-5,
                   coupling={"schedule": schedule, "averaging": {"kernel": "centre"}})
    for i, place in enumerate(itertools.product(range(8), range(2), range(2))):
        case.particles.append(Particle([(k + 0.5) * EDGE / 2 for k in place], 1.5e-3, 2500 if i % 2 else 1200,
                                       velocity=(-1 if i % 3 else 2, 0.2, 0)))
    run = case.run(demvof)
    return run.results["conservation"]["exchange"], sum("left-over" in line for line in run.results["warnings"])


def sweep(long):
    """(scheme, schedule, stiffness, loading, held, windows) of all runs."""
    if long:
        stiffnesses, loadings = [1e-2, 0.1, 1, 10, 100, 1e3, 1e4], [1e-3, 1e-2, 0.1, 1, 10, 100, 1e3]
        for scheme, schedule, held in itertools.product(SCHEMES, SCHEDULES, HELD.values()):
            for stiffness, loading in itertools.product(stiffnesses, loadings):
                if held < 1 or loading == 1:  # held particles have no mass
                    yield scheme, schedule, stiffness, loading, held, 40
        return
    for schedule in SCHEDULES:
        for stiffness, loading, held in ((0.1, 1, 0.5), (1e3, 0.1, 0), (1e3, 10, 0), (1e4, 1, 1)):
            yield "conservative_implicit", schedule, stiffness, loading, held, 12
    yield "explicit", "staggered", 10, 1, 0, 12


def main():
    options = command_line()
    record = Record(
        "two_body_relaxation", "Fluid and particles coming to one velocity",
        "A real pair in one periodic bulk cell in the Stokes range: drag stiffness K dt/(rho eps), mass loading, "
        "particles free or held, exchange scheme and schedule are varied. Every run is compared, window by window, with "
        "the exact linear map of its scheme.",
        "tests/Alltest --verification -- -R pair.two_body_relaxation_long" if options.long else "tests/Alltest -- -R 'pair.two_body_relaxation$'")
    cases = list(sweep(options.long))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda numbered: simulate(options.demvof, numbered[0], *numbered[1]), enumerate(cases)))
    judge(record, runs, options.long)
    for schedule in SCHEDULES:
        open_part, warnings = run_through(options.demvof, schedule)
        record.at_most(f"particles running through cells, {schedule}: exchange of momentum open", open_part, 4e-14)
        record.at_most(f"particles running through cells, {schedule}: warnings of left-over without receiver", warnings, 0)
    raise SystemExit(record.write())


def distance(runs, windows):
    """Worst of either velocity from the common one, in units of the fluid's at the start."""
    return max(abs(run["velocity"][windows - 1] - 1 / (1 + run["loading"])).max() for run in runs)


def unstable(run):
    return run["largest"] > 3


def judge(record, runs, long):
    ours = [run for run in runs if run["scheme"] == "conservative_implicit"]
    record.note("runs", len(runs))
    name = "distance from the linear map over the largest velocity, worst run"
    for scheme, bound in (("explicit", 3.5e-9), ("conservative_implicit", 1.5e-6)):
        record.at_most(f"{scheme}: {name}", max(run["off_map"] for run in runs if run["scheme"] == scheme), bound)
    for schedule in SCHEDULES:
        some = [run for run in ours if run["schedule"] == schedule]
        record.at_most(f"conservative_implicit, {schedule}: runs that grow", int(sum(map(unstable, some))), 0)
        record.at_most(f"conservative_implicit, {schedule}: exchange of momentum open",
                       max(run["exchange"] for run in some), 6e-13 if long else 9e-15)
        record.at_most(f"conservative_implicit, {schedule}: drift of total momentum, free particles",
                       max(run["momentum"] for run in some if run["held"] == 0), 5e-11 if long else 7e-12)
        free = [run for run in some if run["held"] == 0 and run["stiffness"] >= 1e3]
        for_both = [run for run in free if run["stiffness"] >= 100 * run["loading"]]
        light = [run for run in free if run["loading"] <= 0.1]
        name = f"{schedule}: distance from the common velocity, stiffness >= 1000, after"
        if schedule == "staggered":
            record.at_most(f"{name} 3 windows, if >= 100 for the particles too", distance(for_both, 3), 0.025)
        else:
            record.at_most(f"{name} 10 windows, loading <= 0.1", distance(light, 10), 7e-4)
        record.note(f"{name} 3 windows, all", distance(free, 3))
        record.note(f"{name} 10 windows, all", distance(free, 10))
    if long:
        maps(record, runs)


def maps(record, runs):
    # semi_implicit does not keep momentum, and pulls the fluid to the particles' velocity at the last full DEM step; the
    # map has half steps.
    semi = [run for run in runs if run["scheme"] == "semi_implicit"]
    record.note("semi_implicit: distance from the linear map over the largest velocity, worst run",
                max(run["off_map"] for run in semi))
    record.note("semi_implicit: worst error of total momentum, over the largest of its parts",
                max(run["momentum"] for run in semi if run["held"] == 0))
    for scheme, schedule, (what, held) in itertools.product(SCHEMES, SCHEDULES, HELD.items()):
        some = [r for r in runs if (r["scheme"], r["schedule"], r["held"]) == (scheme, schedule, held)]
        record.note(f"{scheme}, {schedule}, {what}: runs that grow", int(sum(map(unstable, some))))
        record.note(f"{scheme}, {schedule}, {what}: predicted to grow", int(sum(r["growth"] > 1 + 1e-6 for r in some)))
    for scheme, schedule in itertools.product(("explicit", "conservative_implicit"), SCHEDULES):
        picture = f"Free particles, {scheme}, {schedule}"
        some = [r for r in runs if (r["scheme"], r["schedule"], r["held"]) == (scheme, schedule, 0)]
        for label, style, grows in (("stays", "o", False), ("grows", "x", True)):
            points = [r for r in some if unstable(r) == grows]
            record.curve(picture, "K dt / (rho eps)", "mass loading", label, [r["stiffness"] for r in points],
                         [r["loading"] for r in points], "xy", style)
    for schedule in SCHEDULES:
        for loading in (0.1, 1, 10):
            r = next(r for r in runs if (r["scheme"], r["schedule"], r["held"], r["stiffness"], r["loading"])
                     == ("conservative_implicit", schedule, 0, 1e3, loading))
            record.curve("Fluid velocity over its equilibrium, K dt / (rho eps) = 1000", "window", "u (1 + loading)",
                         f"{schedule}, loading {loading:g}", range(1, len(r["velocity"]) + 1),
                         r["velocity"][:, 0] * (1 + loading))


if __name__ == "__main__":
    main()
