#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A flow between two walls dies out with neutral spheres in it: suspension_viscosity.py DEMVOF

The last mode of u(z) dies out as exp(-pi^2 mu t/(rho H^2)); with spheres that go with their liquid and have its density
the rate goes with the viscosity, which without the law is eps mu. The errors of mesh and step are in both and drop out.
And it is eps mu whatever kernel, window and schedule the spheres are averaged and told with: the exchange adds none.
Nor with heavy spheres that do not follow within a window, dust of loading f in a gas:

    du/dt = -nu k^2 u - (f/tau) (u - v),   dv/dt = (u - v)/tau,   k = pi/H: the slower of two modes
"""
import concurrent.futures
import math
import sys

import numpy

from box_case import BoxCase, Cyclic, Particle, Wall, command_line, scratch
from record import Record

DENSITY, VISCOSITY, GAP, FRACTION = 1000, 0.5, 0.02, 0.05
ACROSS = 20  # spheres in each direction: half a fine cell apart, so that all cells hold the same solid volume
END, FROM = 0.30, 0.12
EXACT = math.pi**2 * VISCOSITY / DENSITY / GAP**2  # 1/s
FINE, WINDOW = 20, 5e-4  # cells in the gap, two in a bulk cell; s


def spheres():
    spacing = GAP / ACROSS
    diameter = (6 / math.pi * FRACTION * spacing**3) ** (1 / 3)
    return [Particle(tuple((site + 0.5) * spacing for site in (i, j, k)), diameter, DENSITY, velocity=(0.01, 0, 0))
            for i in range(ACROSS // 4) for j in range(ACROSS // 4) for k in range(ACROSS)]


def decay_rate(demvof, name, particles, law, window=WINDOW, coupling=None):
    case = BoxCase(scratch("suspension_viscosity") / name, upper=(GAP / 4, GAP / 4, GAP), fine=(2, 2, FINE), bulk=(2, 2, 10),
                   end_time=END, window=window, coupling=coupling or {}, liquid=(DENSITY, VISCOSITY / DENSITY), gravity=(0, 0, 0),
                   velocity=(0.01, 0, 0), particles=particles, dem_step=window / 5, history_interval=0.02,
                   forces=[{"drag": "schiller_naumann"}, "pressure_gradient", {"suspension_viscosity": law}])
    for side in ("x-", "x+", "y-", "y+"):
        case.sides[side] = Cyclic()
    for side in ("z-", "z+"):
        case.sides[side] = Wall()
    run = case.run(demvof)
    momentum = [a + (b if particles else 0) for a, b in zip(
        run.history["fluid_momentum_x"], run.history["particle_momentum_x"] if particles else run.times)]
    first, last = (min(range(len(run.times)), key=lambda i, t=t: abs(run.times[i] - t)) for t in (FROM, END))
    return -math.log(momentum[last] / momentum[first]) / (run.times[last] - run.times[first])


def decay(cells, window, viscosity):
    """Of the mode on a mesh and with Euler's implicit step, 1/s; viscosity: over the liquid's."""
    half = math.pi / 2 / cells
    return math.log1p((math.sin(half) / half) ** 2 * viscosity * EXACT * window) / window


def dust_decay(demvof, name, loading, stiffness, bulk, refine, kernel):
    """Of a dusty gas between two walls, over the exact one. stiffness: nu k^2 tau; bulk: cells in the gap."""
    nu, ratio, layers, windows = 1e-3, 2000, 20, 400
    k = math.pi / GAP
    tau = stiffness / (nu * k * k)
    diameter = math.sqrt(18 * nu * tau / ratio)
    spacing = GAP / layers
    edge = math.sqrt(ratio * math.pi / 6 * diameter**3 / (loading * spacing))  # one sphere in a layer
    exact = -max(numpy.linalg.eigvals([[-nu * k * k - loading / tau, loading / tau], [1 / tau, -1 / tau]]).real)
    end = 2 / exact
    speed = 1e-3 * edge / end  # no sphere leaves its cell
    spheres_of_dust = [Particle((edge / 2, edge / 2, z), diameter, ratio, velocity=(speed * math.sin(k * z), 0, 0))
                       for z in ((i + 0.5) * spacing for i in range(layers))]
    case = BoxCase(scratch("suspension_viscosity") / name, upper=(edge, edge, GAP), fine=(1, 1, bulk * refine),
                   bulk=(1, 1, bulk), end_time=end, window=end / windows, liquid=(1, nu), gravity=(0, 0, 0),
                   velocity=(speed, 0, 0), particles=spheres_of_dust, dem_step=end / windows / 2,
                   history_interval=end / windows, forces=[{"drag": "schiller_naumann"}],
                   coupling={"averaging": {"kernel": kernel}}, longest_step=end / windows,
                   pimple="momentumPredictor yes;")
    for side in ("x-", "x+", "y-", "y+"):
        case.sides[side] = Cyclic()
    run = case.run(demvof)
    momentum = run.history["fluid_momentum_x"] + run.history["particle_momentum_x"]
    late = numpy.searchsorted(run.times, 0.7 * end)
    return -math.log(momentum[-1] / momentum[late]) / (run.times[-1] - run.times[late]) / exact


def main():
    demvof = command_line().demvof
    record = Record("suspension_viscosity", "Viscosity of a suspension",
                    "The flow between two walls, 20 mm apart, dies out with neutral spheres of 5 % in it, "
                    "suspension_viscosity none, krieger_dougherty and eilers. The ratio of the rates is the "
                    "viscosity over the liquid's: Einstein's law says 1.125, Batchelor and Green's 1.138. And without a "
                    "law it is 0.95, whatever the window and the kernel, on a mesh twice as fine as the bulk grid.",
                    "tests/Alltest -- -R pair.suspension_viscosity")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        laws = ("none", "krieger_dougherty", "eilers")
        rates = dict(zip(laws, pool.map(lambda law: decay_rate(demvof, law, spheres(), law), laws)))
    without = rates["none"]
    record.note("without the law: rate over that of the liquid", without / EXACT)
    for law, expected in {"krieger_dougherty": (1 - 0.05 / 0.64) ** -1.6,
                          "eilers": (1 + 1.25 * 0.05 / (1 - 0.05 / 0.64)) ** 2}.items():
        rate = rates[law]
        record.at_least(f"{law}: rate over that of the liquid", rate / EXACT, 1.125)
        record.at_most(f"{law}: rate over the law's", abs(rate / decay(FINE, WINDOW, expected) - 1), 0.003)
    settings = [("gaussian", 5e-4, "staggered"), ("gaussian", 5e-4, "concurrent"), ("volume", 5e-4, "staggered")]
    if command_line().long:
        settings = [(kernel, window, schedule) for kernel in ("gaussian", "linear", "volume", "centre", "diffusion")
                    for window in (1.25e-4, 5e-4, 2e-3) for schedule in ("staggered", "concurrent")]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda setting: decay_rate(
            demvof, "_".join(map(str, setting)), spheres(), "none", setting[1],
            {"averaging": {"kernel": setting[0]}, "schedule": setting[2]}), settings))
    added = {}
    for (kernel, window, schedule), rate in zip(settings, found):
        error = rate / decay(FINE, window, 1 - FRACTION) - 1
        print(f"{kernel}, window {window} s, {schedule}: viscosity added by the exchange {error:.2e}")
        added.setdefault(window, []).append(abs(error))
    # In windows of five response times a fifth of the response is not by particles that follow.
    bounds = {1.25e-4: 0.05, 5e-4: 0.0027, 2e-3: 0.0075}
    for window, errors in sorted(added.items()):
        record.at_most(f"viscosity added by the exchange, over the liquid's, windows of {window:g} s", max(errors), bounds[window])
    dust = {(1, 0.2, 20, 1, "centre"): 0.008, (1, 0.2, 5, 4, "centre"): 0.05, (1, 0.2, 10, 2, "gaussian"): 0.045}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        decays = list(pool.map(lambda setting: dust_decay(demvof, "dust_" + "_".join(map(str, setting)), *setting), dust))
    for (loading, stiffness, bulk, refine, kernel), found in zip(dust, decays):
        record.at_most(f"dust of loading {loading}, nu k2 tau {stiffness}, {bulk} bulk cells of {refine} in the gap, {kernel}: "
                       "decay over the exact one, less 1", abs(found - 1), dust[loading, stiffness, bulk, refine, kernel])
    sys.exit(record.write())


if __name__ == "__main__":
    main()
