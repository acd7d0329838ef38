#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spheres released in water, as Mordant and Pinton (2000) measured them: measured_spheres.py DEMVOF [--long]

    measured      v(t) = V (1 - exp(-3 t/T)), of a sphere let go at rest
    here          the pair, with drag and pressure gradient and: nothing else; added mass; added mass and history. V and T
                  of the same form, fitted over 0 <= t <= 2 T (T the measured one: the form is at 99.8 % of V there)
    own solution  of the equation of motion with the same laws, integrated here: tells the programs' errors from the laws'

Nothing is fitted to the measured data: laws and coefficients are those of the literature, as the case file names them.
"""
import dataclasses
import math
import pathlib
import sys

import numpy
from box_case import BoxCase, Particle, Wall, command_line, momentum_of_everything, scratch
from record import Record
from reporting.run import read_reference

WATER, GRAVITY = (1000, 0.9e-6), 9.81  # density, kg/m3; kinematic viscosity, m2/s
SPACING = 8                            # of the bulk grid, diameters: what a sphere feels of its own wake is below 0.1 %
SETS = {"drag": (), "and added mass": ({"added_mass": 0.5},), "and history": ({"added_mass": 0.5}, "history")}
WINDOWS, STEPS = 400, 4                # in 2 T; DEM steps in a window


@dataclasses.dataclass
class Sphere:
    diameter: float
    ratio: float   # of the densities
    end: float     # V, m/s
    time: float    # T, s
    material: str

    @property
    def name(self):
        return f"{self.material}, {1e3 * self.diameter:g} mm"


def spheres():
    _, table = read_reference(pathlib.Path(__file__).parent / "measured" / "mordant_pinton_2000.csv")
    return [Sphere(*row, "glass" if row[1] < 5 else "steel")
            for row in zip(*(table[key].tolist() for key in ("d_m", "density_ratio", "V_m_s", "T_s")))]


def fall(demvof, sphere, law, forces, windows=WINDOWS, across=12):
    """Times and speed at each window of a run over 2 T."""
    h = SPACING * sphere.diameter
    along = math.ceil(2 * sphere.time * sphere.end / h) + 10
    window = 2 * sphere.time / windows
    name = f"{sphere.material}_{1e3 * sphere.diameter:g}_{law}_{len(forces)}_{windows}_{across}"
    case = BoxCase(scratch(f"measured_spheres/{name}"), (across * h, across * h, along * h), (across, across, along),
                   (across, across, along), windows * window, window, liquid=WATER, dem_step=window / STEPS, tolerance=1e-8,
                   forces=[{"drag": law}, "pressure_gradient", *forces])
    case.sides = {side: Wall() for side in case.sides}
    case.particles = [Particle((0.63 * h + (across // 2 - 0.5) * h, 0.29 * h + (across // 2 - 0.5) * h, (along - 5) * h),
                               sphere.diameter, sphere.ratio * WATER[0])]
    case.script_tail = f"neighbor {h:.17g} bin\n"  # one particle: no need for bins of its own size
    run = case.run(demvof)
    speed = -run.history["particle_momentum_z"] / (sphere.ratio * WATER[0] * math.pi / 6 * sphere.diameter**3)
    speed[0] = 0  # that row has half a DEM step of the weight in it (docs/outputs.md), and nothing of the fluid yet
    return run.times, speed


def drag_over_stokes(law, reynolds):
    if law == "schiller_naumann":
        return 1 + 0.15 * reynolds**0.687
    return (0.63 * math.sqrt(reynolds) + 4.8) ** 2 / 24  # Dallavalle's, which Di Felice's is at a void fraction of 1


def solved_here(sphere, law, forces, times):
    """Speed at the times, of steps of a quarter of theirs: (m + C_m m_f) dv/dt = (m - m_f) g - beta v - B int v'(s)/sqrt(t - s) ds,
    the acceleration constant within a step, the kernel exact."""
    rho, nu = WATER
    displaced = rho * math.pi / 6 * sphere.diameter**3
    inertia = sphere.ratio * displaced + (0.5 * displaced if forces else 0)
    basset = 1.5 * sphere.diameter**2 * rho * math.sqrt(math.pi * nu) if "history" in forces else 0
    steps = 4 * (len(times) - 1)
    dt = times[-1] / steps
    kernel = 2 * math.sqrt(dt) * numpy.diff(numpy.sqrt(numpy.arange(steps + 1)))
    speed, rate = numpy.zeros(steps + 1), numpy.zeros(steps)
    for i in range(steps):
        past = basset * (kernel[1:i + 1][::-1] @ rate[:i])
        middle = speed[i]
        for _ in range(3):
            beta = 3 * math.pi * rho * nu * sphere.diameter * drag_over_stokes(law, middle * sphere.diameter / nu)
            rate[i] = ((sphere.ratio - 1) * displaced * GRAVITY - past - beta * middle) / (inertia + basset * kernel[0])
            middle = speed[i] + dt / 2 * rate[i]
        speed[i + 1] = speed[i] + dt * rate[i]
    return speed[::4]


def fit(times, speed):
    """V and T of V (1 - exp(-3 t/T)), least squares."""
    def off(scale):
        form = 1 - numpy.exp(-3 * times / scale)
        end = form @ speed / (form @ form)
        return ((speed - end * form) ** 2).sum(), end

    low, high = 0.05 * times[-1], 5 * times[-1]
    for _ in range(60):  # golden section
        a, b = high - 0.618034 * (high - low), low + 0.618034 * (high - low)
        low, high = (low, b) if off(a)[0] < off(b)[0] else (a, high)
    return off(low)[1], low


def measured(sphere, times):
    return sphere.end * (1 - numpy.exp(-3 * times / sphere.time))


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def judge(record, demvof, sphere, law):
    """Off the measured values by what, for each set of forces: V, T, rms of v(t)/V."""
    found, picture = {}, f"{sphere.name}, Re {sphere.end * sphere.diameter / WATER[1]:.0f}, {law}"
    for which, forces in SETS.items():
        name = f"{sphere.name}, {law} {which}"
        times, speed = fall(demvof, sphere, law, forces)
        end, time = fit(times, speed)
        found[which] = (end / sphere.end - 1, time / sphere.time - 1)
        record.note(f"{name}: V {end:.4f} m/s, measured {sphere.end:g}: off", found[which][0])
        record.note(f"{name}: T {time:.4f} s, measured {sphere.time:g}: off", found[which][1])
        record.note(f"{name}: rms of v(t) less the measured form, over V", rms(speed - measured(sphere, times)) / sphere.end)
        own = solved_here(sphere, law, forces, times)
        record.at_most(f"{name}: largest difference to the own solution, over V", abs(speed - own).max() / sphere.end, 0.006)
        record.curve(picture, "t, s", "speed, m/s", which, times[::4], speed[::4], style="-")
    record.curve(picture, "t, s", "speed, m/s", "measured", times[::20], measured(sphere, times[::20]), style="ko")
    return found


def judge_by_the_experiment(record, found):
    """found: of each sphere. What tells the forces apart, and what the drag law is known to be good for."""
    def worst(which, n):
        return max((abs(one[which][n]) for one in found), default=math.nan)

    record.at_most("schiller_naumann and added mass: V, furthest off", worst("and added mass", 0), 0.1,
                   loose="measured drag lies within 5 % of the standard curve, V with it; the water's temperature adds as much")
    record.at_most("schiller_naumann and history: T, furthest off", worst("and history", 1), 0.15,
                   loose="what 5 % of the drag and another interval of the fit (below) change of T")
    least = {which: min(-one[which][1] for one in found) for which in ("drag", "and added mass")}
    record.at_least("schiller_naumann drag alone: T is too short by, at least", least["drag"], 0.1)
    record.at_least("schiller_naumann and added mass without history: T is too short by, at least", least["and added mass"], 0.08)


def fine_enough(record, demvof, sphere):
    """Windows and DEM steps half as long, and a tank half as wide again: V and T may not change."""
    forces = SETS["and history"]
    times, speed = fall(demvof, sphere, "schiller_naumann", forces)
    whole = fit(times, speed)
    for what, options in {"windows and DEM steps half as long": {"windows": 2 * WINDOWS}, "a tank of 144 d": {"across": 18}}.items():
        other = fit(*fall(demvof, sphere, "schiller_naumann", forces, **options))
        record.at_most(f"{sphere.name}, {what}: change of V", abs(other[0] / whole[0] - 1), 3.5e-4)
        record.at_most(f"{sphere.name}, {what}: change of T", abs(other[1] / whole[1] - 1), 5e-3)
    half = times <= sphere.time * (1 + 1e-9)
    part = fit(times[half], speed[half])
    record.note(f"{sphere.name}: V, fitted over T in place of 2 T, changes by", part[0] / whole[0] - 1)
    record.note(f"{sphere.name}: T, likewise", part[1] / whole[1] - 1)


def main():
    options = command_line()
    record = Record(
        "measured_spheres", "Spheres released in water, against the experiment",
        "Three spheres let go at rest in water, Re 41 to 360, through the real pair, with drag and pressure gradient, with added mass, and with "
        "added mass and history, against V and T of v = V (1 - exp(-3 t/T)) as Mordant and Pinton (2000) measured them "
        "(tests/verification/pair/measured). Nothing is fitted to the data. Without history T is 12 to 40 % too short; with it T is right within 9 %, "
        "and the end velocity 5 to 9 % too low: Basset's kernel is that of Re < 1 and remembers for ever, while the wake of a sphere of "
        "Re 41 and more forgets within a few diameters. No set of forces here has both. Di Felice's law, which is Dallavalle's for one sphere, is "
        "10 % too slow from Re 280 on. What each run gives is its own equation of motion's solution within 0.3 %: these are errors of the "
        "laws.",
        "tests/Alltest --verification -- -R pair.measured_spheres_long" if options.long else "tests/Alltest -- -R 'pair.measured_spheres$'")
    found = [judge(record, options.demvof, sphere, "schiller_naumann") for sphere in spheres()[:None if options.long else 1]]
    judge_by_the_experiment(record, found)
    if options.long:
        for sphere in spheres():
            judge(record, options.demvof, sphere, "di_felice")
        fine_enough(record, options.demvof, spheres()[0])
    momentum_of_everything(record, 2e-13)
    sys.exit(record.write())


if __name__ == "__main__":
    main()
