#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A dense suspension settles, as Pham Van Bang measured it by MRI: measured_settling.py DEMVOF [--long]

Between clear liquid above and sediment below the suspension of solid fraction phi sinks at v; the sediment of phi_bed grows with
v phi/(phi_bed - phi) (Kynch). For slow flow a drag law F(eps) of spheres that all sink alike gives

    v = eps v_St/F,   v_St = (rho_p - rho) g d^2/(18 mu)

which the pair has to meet; that the experiment meets it is up to the law.
"""
import math
import pathlib
import sys

import numpy
from box_case import BoxCase, Cyclic, Open, Particle, Wall, command_line, momentum_of_everything, particle_states, scratch
from record import Record
from reporting.run import read_reference

DIAMETER, DENSITY, LIQUID, NU = 290e-6, 1050, 950, 2.105e-5
FRACTION = 0.49
WIDTH, HEIGHT, TOP = 4 * DIAMETER, 24 * DIAMETER, 28 * DIAMETER  # of the column; of the suspension; of the liquid
# Window: so long that the springs of the contacts bring back what drag moves, k_t dt_w > 2 sum of beta (docs/stability.md).
STIFFNESS, WINDOW, INTERVAL = 0.5, 0.1, 1.0
EARLY = (2, 12)  # s: the suspension is still as it was made
VOLUME = math.pi / 6 * DIAMETER**3
STOKES = (DENSITY - LIQUID) * 9.81 * DIAMETER**2 / (18 * LIQUID * NU)


def suspension():
    """Centres of spheres without order that nowhere overlap, as many in each layer: put down at random, then pushed apart;
    periodic across."""
    count = round(FRACTION * WIDTH**2 * HEIGHT / VOLUME)
    places = numpy.random.default_rng(1).random((count, 3)) * (WIDTH, WIDTH, 0)
    places[:, 2] = (numpy.arange(count) + 0.5) * HEIGHT / count
    for _ in range(20000):
        away = places[:, None] - places[None]
        away[..., :2] -= WIDTH * numpy.round(away[..., :2] / WIDTH)
        distance = numpy.sqrt((away**2).sum(-1)) + 1e3 * numpy.eye(count)
        overlap = numpy.maximum(0, 1.005 * DIAMETER - distance)
        if overlap.max() < 0.005 * DIAMETER:
            return places
        places += 0.4 * (away * (overlap / distance)[..., None]).sum(1)
        places[:, :2] %= WIDTH
        places[:, 2] = numpy.clip(places[:, 2], DIAMETER / 2, HEIGHT - DIAMETER / 2)
    raise RuntimeError("the spheres do not fit")


def drag_over_stokes(law, eps):
    """Of slow flow, at the superficial velocity (docs/theory.md, Drag laws)."""
    phi = 1 - eps
    return {"gidaspow": 150 * phi / (18 * eps**2),                             # Ergun's at this void fraction
            "di_felice": 4.8**2 / 24 * eps**-3.7,                       # its limit
            "beetstra": 10 * phi / eps**2 + eps**2 * (1 + 1.5 * math.sqrt(phi))}[law]


def simulate(demvof, law, end):
    """Times of the outputs; at each the heights and vertical velocities of the spheres."""
    case = BoxCase(scratch(f"measured_settling/{law}"), (WIDTH, WIDTH, TOP), (2, 2, 14), (2, 2, 14), end, WINDOW, liquid=(LIQUID, NU),
                   contacts=True, stiffness=STIFFNESS, dem_step=4e-5, output_interval=INTERVAL, forces=[{"drag": law}, "pressure_gradient"],
                   tolerance=1e-9)
    case.sides = {"x-": Cyclic(), "x+": Cyclic(), "y-": Cyclic(), "y+": Cyclic(), "z-": Wall(), "z+": Wall()}
    case.particles = [Particle(tuple(place), DIAMETER, DENSITY) for place in suspension()]
    run = case.run(demvof)
    states = [particle_states(run.folder, n) for n in range(round(end / INTERVAL) + 1)]
    heights = numpy.array([s["position"][:, 2] for s in states])
    slosh = rms([numpy.hypot(*s["velocity"].mean(axis=0)[:2]) for s in states[1:]])
    return run, INTERVAL * numpy.arange(len(states)), heights, slosh


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def sinking(times, heights, begin, end):
    """Mean speed of the spheres in the middle of the suspension between two times."""
    middle = (heights[0] > HEIGHT / 2) & (heights[0] < 0.85 * HEIGHT)
    first, last = numpy.searchsorted(times, (begin, end))
    return float((heights[first] - heights[last])[middle].mean() / (times[last] - times[first]))


def upper_front(heights):
    """Height that a sharp top would have: n A (z - z_0) of solid above z_0."""
    bottom = 0.6 * HEIGHT
    return bottom + math.sqrt(2 * numpy.maximum(0, heights - bottom).sum() * VOLUME / (FRACTION * WIDTH**2))


def lower_front(before, after, speed, interval):
    """Height that best divides spheres at rest below from those that sink above, in the middle of an interval."""
    height = (before + after) / 2
    before, after, height = (one[height < HEIGHT / 2] for one in (before, after, height))
    order = numpy.argsort(height)
    at_rest = (before - after)[order] < speed * interval / 2
    wrong = numpy.cumsum(numpy.r_[0, ~at_rest]) + (at_rest.sum() - numpy.cumsum(numpy.r_[0, at_rest]))
    best = int(numpy.flatnonzero(wrong == wrong.min())[0])
    return float(height[order[best - 1]] + DIAMETER / 2) if best else 0.0


def packed(heights, front):
    """Solid fraction of the sediment, without its first and its last diameter."""
    inside = numpy.clip((front - DIAMETER - (heights - DIAMETER / 2)) / DIAMETER, 0, 1)  # share of each sphere below the upper end
    below = numpy.clip((heights + DIAMETER / 2 - DIAMETER) / DIAMETER, 0, 1)
    return float((inside * below).sum() * VOLUME / (WIDTH**2 * (front - 2 * DIAMETER)))


def judge(record, demvof, law, end, seen):
    """seen: measured speeds of the upper and the lower front, m/s."""
    run, times, heights, slosh = simulate(demvof, law, end)
    exact = STOKES * (1 - FRACTION) / drag_over_stokes(law, 1 - FRACTION)
    sinks, whole = sinking(times, heights, *EARLY), sinking(times, heights, EARLY[0], end)
    record.note(f"{law}: eps v_St/F", exact, "m/s")
    record.note(f"{law}: speed of the suspension, {EARLY[0]} to {EARLY[1]} s", sinks, "m/s")
    record.at_most(f"{law}: off eps v_St/F", abs(sinks / exact - 1), 0.08,
                   loose="0.01 more or less of solid in the part that is looked at is 8 % of the speed")
    record.note(f"{law}: speed of the suspension, {EARLY[0]} to {end:g} s", whole, "m/s")
    record.note(f"{law}: off the measured upper front, {EARLY[0]} to {EARLY[1]} s", sinks / seen[0] - 1)
    record.note(f"{law}: off the measured upper front, {EARLY[0]} to {end:g} s", whole / seen[0] - 1)
    fronts = [lower_front(heights[n - 2], heights[n], whole, 2 * INTERVAL) for n in range(2, len(times))]
    bed = packed(heights[-1], fronts[-1])
    record.note(f"{law}: solid fraction of the sediment, measured 0.59", bed)
    record.note(f"{law}: speed of the lower front by Kynch, with that sediment: off the measured one",
                whole * FRACTION / (bed - FRACTION) / seen[1] - 1)
    record.note(f"{law}: height of the lower front at the end, over the diameter (it is read to one diameter)", fronts[-1] / DIAMETER)
    record.note(f"{law}: the same by the measured speed", seen[1] * times[-2] / DIAMETER)
    record.note(f"{law}: mean horizontal velocity of all spheres over the speed of the suspension, rms", slosh / whole)
    upper = [upper_front(one) / DIAMETER for one in heights]
    record.curve("fronts", "t, s", "height / d", f"{law}: upper", times, upper, style="-")
    record.curve("fronts", "t, s", "height / d", f"{law}: lower", times[1:-1], [z / DIAMETER for z in fronts], style="-")
    return run


def main():
    demvof = command_line().demvof
    record = Record("measured_settling", "A dense suspension that settles, against the experiment", "359 spheres of 290 um in oil, solid fraction 0.49, 24 diameters high in a periodic column of 4, sink for 30 s through the real pair, against "
                    "the fronts that Pham Van Bang measured over 1140 s in a column of 180 diameters (tests/verification/pair/measured); a front's "
                    "speed does not depend on the height. Soft contacts (0.5 N/m, friction 0.3). Nothing is fitted to the data. The suspension has to "
                    "sink as its law of drag says; the laws then differ by two thirds. The lower front also depends on the solid fraction of the sediment less that "
                    "of the suspension, 0.1, of which each hundredth counts for 10 %; in 30 s it rises by 3.5 diameters and is read to one, so that its speed is "
                    "not a result of this test. The window is long on purpose: with 20 ms the whole suspension "
                    "slides to and fro (docs/stability.md).",
                    "tests/Alltest --verification -- -R pair.measured_settling")
    _, table = read_reference(pathlib.Path(__file__).parent / "measured" / "pham_van_bang_settling.csv")
    seen = [abs(float(numpy.polyfit(table["t_s"], table[name], 1)[0])) for name in ("upper_m", "lower_m")]
    for name, speed in zip(("upper", "lower"), seen):
        record.note(f"measured: speed of the {name} front", speed, "m/s")
    record.note("measured: error of both from the pixels of 0.78 mm", 0.78e-3 / math.sqrt(12) / (table["t_s"].std() * math.sqrt(len(table["t_s"]))), "m/s")
    for law in ("gidaspow", "di_felice", "beetstra"):
        judge(record, demvof, law, 30.0, seen)
    times = numpy.array([0.0, 30])
    record.curve("fronts", "t, s", "height / d", "measured slopes", times, (HEIGHT - seen[0] * times) / DIAMETER, style="k--")
    record.curve("fronts", "t, s", "height / d", "measured slopes, lower", times, seen[1] * times / DIAMETER, style="k:")
    momentum_of_everything(record, 2e-13)
    sys.exit(record.write())


if __name__ == "__main__":
    main()
