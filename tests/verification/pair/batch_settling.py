#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A suspension settles in a beaker with a water surface on top: batch_settling.py DEMVOF [--long]

Kynch, Trans. Faraday Soc. 48 (1952) 166: two shocks. The clear liquid grows downwards with the settling speed of the
suspension, eps^4.65 v_St for Wen and Yu's drag in slow flow, and the sediment grows upwards with
speed phi/(phi_max - phi). They meet where all has settled. The water's surface stays where it is.
"""
import math
import pathlib
import random
import sys

from box_case import BoxCase, Cyclic, Open, Particle, Wall, command_line, scratch
from record import Record

DIAMETER, DENSITY, LIQUID, VISCOSITY = 1e-3, 2500, 1000, 0.2
FRACTION, HEIGHT, WIDTH, TOP = 0.15, 0.06, 5e-3, 0.08
ACROSS, LAYERS = 3, 48
STOKES = (DENSITY - LIQUID) * 9.81 * DIAMETER**2 / (18 * VISCOSITY)
SPEED = (1 - FRACTION) ** 4.65 * STOKES


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


def sediment(frame):
    """Height up to which the particles are packed to more than half of what they do at the floor."""
    slab, area = 2 * DIAMETER, WIDTH**2
    volume = math.pi / 6 * DIAMETER**3

    def fraction(z):
        return sum(z <= h < z + slab for h in frame) * volume / (slab * area)

    packed = fraction(DIAMETER)
    z = DIAMETER
    while fraction(z) > (packed + FRACTION) / 2:
        z += 0.1 * DIAMETER
    return z + slab / 2, packed


def main():
    options = command_line()
    end_time, interval = (28.0, 1.0) if options.long else (5.0, 0.5)
    case = BoxCase(scratch("batch_settling"), (WIDTH, WIDTH, TOP), (2, 2, 32), (2, 2, 32), end_time, window=0.02,
                   liquid=(LIQUID, VISCOSITY / LIQUID), gas=(1, 1e-5), level=HEIGHT + 5e-3, particles=suspension(),
                   contacts=True, stiffness=5, dem_step=1e-4, output_interval=interval, history_interval=interval,
                   forces=[{"drag": "gidaspow"}, "pressure_gradient"])
    case.sides = {"x-": Cyclic(), "x+": Cyclic(), "y-": Cyclic(), "y+": Cyclic(), "z-": Wall(), "z+": Open()}
    run = case.run(options.demvof)
    frames = heights(run.folder)
    times = [interval * n for n in range(len(frames))]
    interfaces, tops = [interface(frame) for frame in frames], [top(frame) for frame in frames]
    first, last = times.index(1.0), times.index(5.0)

    record = Record("batch_settling", "Batch settling with its two shocks",
                    "432 spheres of 1 mm in a liquid of 0.2 Pa s (Re 0.01), solid fraction 0.15, settle in a beaker of "
                    "periodic sides, 65 mm of liquid under gas, with Wen and Yu's drag. The interface to the clear "
                    "liquid must fall with eps^4.65 of Stokes's velocity, and the surface of the liquid stay. With "
                    "--long to the end: the sediment's front, and where the two meet (Kynch 1952).",
                    "tests/Alltest --verification -- -R pair.batch_settling_long" if options.long
                    else "tests/Alltest -- -R 'pair.batch_settling$'")
    fall = (interfaces[first] - interfaces[last]) / (times[last] - times[first])
    record.note("Stokes velocity", STOKES, "m/s")
    record.note("interface: speed over eps^4.65 v_St - 1", fall / SPEED - 1)
    record.at_most("interface: error of its speed", abs(fall / SPEED - 1), 0.0135)
    levels = run.history["mean_level"]
    record.at_most("surface of the liquid: largest change of its level over H0",
                   max(abs(level - levels[0]) for level in levels) / HEIGHT, 2e-14)
    record.at_most("liquid volume, drift", run.results["conservation"]["liquid_volume"], 2e-14)
    record.at_most("momentum exchange", run.results["conservation"]["exchange"], 5e-14)
    if options.long:
        fronts = [sediment(frame) for frame in frames]
        packed = fronts[-1][1]
        rise = SPEED * FRACTION / (packed - FRACTION)
        measured = (fronts[times.index(10.0)][0] - fronts[times.index(2.0)][0]) / 8
        meeting = HEIGHT / (SPEED + rise)
        record.note("sediment: solid fraction", packed)
        record.at_most("sediment: error of its front's speed", abs(measured / rise - 1), 0.05)
        settled = next(t for t, z in zip(times, tops) if z < tops[-1] + DIAMETER)
        record.note("time until all has settled over that of Kynch's shocks", settled / meeting)
        record.at_most("height of the sediment: error", abs((tops[-1] + DIAMETER / 2) / (HEIGHT * FRACTION / packed) - 1),
                       0.03)
        record.curve("batch settling", "t, s", "height, m", "sediment", times, [z for z, _ in fronts])
        record.curve("batch settling", "t, s", "height, m", "sediment, Kynch", [0, meeting], [0, rise * meeting], style="k--")
    record.curve("batch settling", "t, s", "height, m", "top of the particles", times, tops)
    record.curve("batch settling", "t, s", "height, m", "interface, eps^4.65 v_St", [0, min(end_time, HEIGHT / SPEED)],
                 [HEIGHT, HEIGHT - SPEED * min(end_time, HEIGHT / SPEED)], style="k-")
    sys.exit(record.write())


if __name__ == "__main__":
    main()
