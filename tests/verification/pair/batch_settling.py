#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A suspension settles in a beaker with a water surface on top: batch_settling.py DEMVOF [--long]

Kynch, Trans. Faraday Soc. 48 (1952) 166: two shocks. The clear liquid grows downwards with the settling speed of the
suspension, eps^4.65 v_St for Wen and Yu's drag in slow flow, and the sediment grows upwards with
speed phi/(phi_max - phi). They meet where all has settled, at H_0 phi/phi_max. The water's surface stays where it is.

The sediment grows so only where the flux phi v(phi) lies above the chord from the suspension to the sediment, as it does
for Di Felice's law. With Gidaspow's, which is Ergun's from 0.2 on, it lies below, and a fan comes between.
"""
import math
import pathlib
import random
import sys

from box_case import BoxCase, Cyclic, Open, Particle, Wall, command_line, momentum_of_everything, scratch
from record import Record

DIAMETER, DENSITY, LIQUID, VISCOSITY = 1e-3, 2500, 1000, 0.2
FRACTION, HEIGHT, WIDTH, TOP = 0.15, 0.06, 5e-3, 0.08
ACROSS, LAYERS = 3, 48
STOKES = (DENSITY - LIQUID) * 9.81 * DIAMETER**2 / (18 * VISCOSITY)
WEN_YU = (1 - FRACTION) ** 4.65 * STOKES


def settling_with_di_felice():
    """Speed of the suspension: eps v_St = F u_s with the superficial slip u_s = eps s, and v = eps s."""
    eps, speed = 1 - FRACTION, WEN_YU
    for _ in range(50):
        reynolds = LIQUID * speed * DIAMETER / VISCOSITY
        chi = 3.7 - 0.65 * math.exp(-((1.5 - math.log10(reynolds)) ** 2) / 2)
        factor = (0.63 + 4.8 / math.sqrt(reynolds)) ** 2 * reynolds / 24 * eps**-chi
        speed = eps * STOKES / factor
    return speed


def suspension():
    """A lattice with a little disorder; its layers fill the height with the solid fraction."""
    jitter, spacing, rise = random.Random(1), WIDTH / ACROSS, HEIGHT / LAYERS
    return [Particle(((i + 0.5) * spacing + jitter.uniform(-1e-4, 1e-4), (j + 0.5) * spacing + jitter.uniform(-1e-4, 1e-4),
                      (k + 0.5) * rise + jitter.uniform(-5e-5, 5e-5)), DIAMETER, DENSITY)
            for k in range(LAYERS) for j in range(ACROSS) for i in range(ACROSS)]


def heights(folder):
    """Of each output: the particles' heights, sorted."""
    from vtk import vtkXMLPolyDataReader
    from vtk.util.numpy_support import vtk_to_numpy
    frames = []
    for file in sorted((pathlib.Path(folder) / "particles").glob("*.vtp")):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(file))
        reader.Update()
        frames.append(sorted(vtk_to_numpy(reader.GetOutput().GetPoints().GetData())[:, 2]))
    return frames


def interface(frame):
    """Height that a sharp top would have: sum of z - z_0 above z_0 = n A (z_I - z_0)^2/2, z_0 in the undisturbed part."""
    bottom = HEIGHT / 3
    moment = sum(max(0, z - bottom) for z in frame) * math.pi / 6 * DIAMETER**3
    return bottom + math.sqrt(2 * moment / (FRACTION * WIDTH**2))


def top(frame):
    """Height below which all but half a layer of the particles are."""
    return frame[-1 - ACROSS * ACROSS // 2]


def packed_fraction(frame):
    """Of a sediment at rest."""
    return len(frame) * math.pi / 6 * DIAMETER**3 / (WIDTH**2 * (top(frame) + DIAMETER / 2))


def front(frame, packed):
    """Height up to which the particles are packed to more than half of what they do in the end."""
    slab, volume = 2 * DIAMETER, math.pi / 6 * DIAMETER**3
    z = 0.0
    while sum(z <= h < z + slab for h in frame) * volume / (slab * WIDTH**2) > (packed + FRACTION) / 2:
        z += 0.1 * DIAMETER
    return z + slab / 2


def simulate(demvof, drag, end_time, interval):
    case = BoxCase(scratch(f"batch_settling/{drag}"), (WIDTH, WIDTH, TOP), (2, 2, 32), (2, 2, 32), end_time, window=0.02,
                   liquid=(LIQUID, VISCOSITY / LIQUID), gas=(1, 1e-5), level=HEIGHT + 5e-3, particles=suspension(),
                   contacts=True, stiffness=5, dem_step=1e-4, output_interval=interval, history_interval=interval,
                   forces=[{"drag": drag}, "pressure_gradient"])
    case.sides = {"x-": Cyclic(), "x+": Cyclic(), "y-": Cyclic(), "y+": Cyclic(), "z-": Wall(), "z+": Open()}
    run = case.run(demvof)
    frames = heights(run.folder)
    return run, [interval * n for n in range(len(frames))], frames


def judge_interface(record, drag, expected, bounds, run, times, frames):
    """bounds: of the errors of speed and level."""
    first, last = times.index(1.0), times.index(5.0)
    fall = (interface(frames[first]) - interface(frames[last])) / (times[last] - times[first])
    record.note(f"{drag}: speed of the interface over its exact one - 1", fall / expected - 1)
    record.at_most(f"{drag}: error of the interface's speed", abs(fall / expected - 1), bounds[0])
    levels = run.history["mean_level"]
    record.at_most(f"{drag}: surface of the liquid, largest change of its level over H0",
                   max(abs(level - levels[0]) for level in levels) / HEIGHT, bounds[1])
    record.at_most(f"{drag}: liquid volume, drift", run.results["conservation"]["liquid_volume"], 1.8e-14)
    record.at_most(f"{drag}: momentum exchange", run.results["conservation"]["exchange"], 5e-14)
    record.curve("batch settling", "t, s", "height, m", f"top of the particles, {drag}", times, list(map(top, frames)))


def judge_sediment(record, speed, times, frames):
    packed = packed_fraction(frames[-1])
    rise, meeting = speed * FRACTION / (packed - FRACTION), HEIGHT * FRACTION / packed
    fronts = [front(frame, packed) for frame in frames]
    record.note("sediment: solid fraction", packed)
    measured = (fronts[times.index(16.0)] - fronts[times.index(6.0)]) / 10
    record.note("sediment: speed of its front over Kynch's - 1", measured / rise - 1)
    record.at_most("sediment: error of its front's speed", abs(measured / rise - 1), 0.05)
    fall = [HEIGHT - speed * t for t in times]
    meet = next(i for i, (low, high) in enumerate(zip(fronts, fall)) if low > high)
    record.note("height where front and interface meet over H0", fronts[meet] / HEIGHT)
    record.at_most("the same: error against H0 phi/phi_max", abs(fronts[meet] / meeting - 1), 0.01,
                   loose="the front is read to a tenth of a sphere, 0.7 % of this height")
    record.curve("batch settling", "t, s", "height, m", "sediment, di_felice", times, fronts)
    record.curve("batch settling", "t, s", "height, m", "both shocks, Kynch", [0, (HEIGHT - meeting) / speed, 0],
                 [0, meeting, HEIGHT], style="k--")


def main():
    options = command_line()
    record = Record("batch_settling", "Batch settling with its two shocks",
                    "432 spheres of 1 mm in a liquid of 0.2 Pa s (Re 0.01), solid fraction 0.15, settle in a beaker of "
                    "periodic sides, 65 mm of liquid under gas, with Wen and Yu's drag (Gidaspow's at this void fraction). "
                    "The interface to the clear liquid must fall with eps^4.65 of Stokes's velocity, and the surface of the "
                    "liquid stay. With --long also with Di Felice's drag, to the end: the sediment's front, and where the "
                    "two meet (Kynch 1952).",
                    "tests/Alltest --verification -- -R pair.batch_settling_long" if options.long
                    else "tests/Alltest -- -R 'pair.batch_settling$'")
    record.note("Stokes velocity", STOKES, "m/s")
    judge_interface(record, "gidaspow", WEN_YU, (0.0135, 1.9e-9), *simulate(options.demvof, "gidaspow", 5.0, 0.5))
    if options.long:
        speed = settling_with_di_felice()
        run, times, frames = simulate(options.demvof, "di_felice", 28.0, 0.5)
        judge_interface(record, "di_felice", speed, (1.5e-3, 5e-9), run, times, frames)
        judge_sediment(record, speed, times, frames)
    record.curve("batch settling", "t, s", "height, m", "interface, eps^4.65 v_St", [0, 5], [HEIGHT, HEIGHT - 5 * WEN_YU],
                 style="k-")
    momentum_of_everything(record, 1e-8 if options.long else 1.2e-10)
    sys.exit(record.write())


if __name__ == "__main__":
    main()
