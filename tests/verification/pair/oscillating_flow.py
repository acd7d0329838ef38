# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles in a flow that oscillates: what a sphere follows, and what a dusty gas passes on.

A sphere of density rho_p in a liquid U cos(w t), drag beta and added mass C_m rho V:

    v/u = (1 + i B w tau)/(1 + i w tau),  B = (1 + C_m)/(rho_p/rho + C_m),  tau = (rho_p + C_m rho) V/beta

Dust of loading f (its mass over the gas's) above a wall that oscillates in its plane, u = U exp(i w t - kappa z); from the
momentum equations of both, Saffman, J. Fluid Mech. 13 (1962) 120:

    kappa^2 = (i w/nu) (1 + f/(1 + i w tau))

Usage: oscillating_flow.py DEMVOF [--long]"""
import cmath
import concurrent.futures
import math

import numpy
from box_case import BoxCase, Cyclic, Outlet, Particle, Slip, command_line, momentum_of_everything, scratch
from record import Record


def oscillating(axis, speed, frequency, pressure="fixedFluxPressure; value uniform 0"):
    """A side that moves, or lets fluid in, with speed sin(2 pi frequency t) along an axis."""
    direction = ["0", "0", "0"]
    direction["xyz".index(axis)] = f"{speed:.17g}"
    return {"type": "patch", "p_rgh": pressure, "alpha.water": "inletOutlet; inletValue uniform 1; value uniform 1",
            "U": f"uniformFixedValue; uniformValue {{ type sine; frequency {frequency:.17g}; amplitude 1; "
                 f"scale ({' '.join(direction)}); level (0 0 0); }} value uniform (0 0 0)"}


def harmonic(times, values, omega):
    """Complex amplitude a of values = Re(a exp(i w t)) + constant + slope t, over whole periods."""
    columns = numpy.stack([numpy.cos(omega * times), -numpy.sin(omega * times), numpy.ones_like(times), times], 1)
    found = numpy.linalg.lstsq(columns, values, rcond=None)[0]
    return complex(found[0], found[1])


def last_period(times, omega):
    return times > times[-1] - 2 * math.pi / omega * (1 + 1e-9)


def sphere(demvof, ratio, added, per_period, order=1):
    """Velocity of the sphere over that of the liquid, complex; and what is exact. ratio: rho_p/rho."""
    diameter, density, viscosity = 1e-3, 1000.0, 0.1
    beta, volume = 3 * math.pi * viscosity * diameter, math.pi / 6 * diameter**3
    tau = (ratio + added) * density * volume / beta
    omega = 1 / tau
    window, periods = 2 * math.pi / omega / per_period, 3
    edge = 16 * diameter  # 1e-4 of its bulk cell: a sphere alone
    speed = 1e-4 * diameter * omega  # so small that nothing but the mean moves, and Re = 1e-5
    forces = [{"drag": "schiller_naumann"}, "pressure_gradient"] + ([{"added_mass": added}] if added else [])
    case = BoxCase(scratch(f"oscillating_flow/sphere_{ratio:g}_{added:g}_{per_period}_{order}"), (edge, edge, 5 * edge), (1, 1, 20),
                   (1, 1, 5), periods * per_period * window, window, gravity=(0, 0, 0),
                   liquid=(density, viscosity / density), forces=forces, longest_step=window,
                   coupling={"averaging": {"kernel": "centre"}, "order": order},
                   sides={**{side: Slip() for side in ("x-", "x+", "y-", "y+")}, "z+": Outlet(),
                          "z-": oscillating("z", speed, omega / (2 * math.pi))})
    case.particles.append(Particle((edge / 2, edge / 2, 2.5 * edge), diameter, ratio * density))
    run = case.run(demvof)
    late = last_period(run.times, omega)
    got = harmonic(run.times[late], run.history["particle_momentum_z"][late], omega)
    got /= ratio * density * volume * speed * -1j  # sin(w t) = Re(-i exp(i w t))
    b = (1 + added) / (ratio + added)
    return got, (1 + 1j * b) / (1 + 1j)


def dusty_layer(demvof, loading, per_period):
    """kappa/sqrt(w/nu), from the momentum of the gas rho U A/kappa; and what is exact."""
    density, ratio, diameter, nu = 1.0, 2000.0, 1e-4, 1e-3
    tau = ratio * diameter**2 / (18 * nu)
    omega = 1 / tau
    length = math.sqrt(nu / omega)  # of the layer, m
    cells = 32
    height = length / 4             # of a bulk cell; one particle in each
    edge = math.sqrt(ratio * math.pi / 6 * diameter**3 / (max(loading, 0.1) * height))  # f rho A h = mass of a particle
    window, periods = 2 * math.pi / omega / per_period, 3
    speed = 1e-3 * edge * omega  # no particle leaves its cell
    case = BoxCase(scratch(f"oscillating_flow/dust_{loading:g}_{per_period}"), (edge, edge, cells * height),
                   (1, 1, 2 * cells), (1, 1, cells), periods * per_period * window, window, gravity=(0, 0, 0),
                   liquid=(density, nu), longest_step=window, pimple="momentumPredictor yes;",
                   forces=[{"drag": "schiller_naumann" if loading else "none"}],
                   coupling={"averaging": {"kernel": "centre"}},
                   sides={"x-": Cyclic(), "x+": Cyclic(), "y-": Cyclic(), "y+": Cyclic(), "z+": Slip(),
                          "z-": {**oscillating("x", speed, omega / (2 * math.pi)), "alpha.water": "zeroGradient"}})
    for k in range(cells):
        case.particles.append(Particle((edge / 2, edge / 2, (k + 0.5) * height), diameter, ratio * density))
    run = case.run(demvof)
    late = last_period(run.times, omega)
    momentum = harmonic(run.times[late], run.history["fluid_momentum_x"][late], omega)
    kappa = density * speed * -1j * edge * edge / momentum
    return kappa * length, cmath.sqrt(1j * (1 + loading / (1 + 1j)))


def main():
    options = command_line()
    record = Record(
        "oscillating_flow", "Spheres in an oscillating liquid, dust above an oscillating wall",
        "A sphere in a liquid that oscillates with the sphere's response time, against the exact amplitude and phase, with and "
        "without added mass; and the layer that an oscillating wall drags along in a dusty gas of as much dust as gas, "
        "against Saffman's decay and wave number.",
        "tests/Alltest --verification -- -R pair.oscillating_flow_long" if options.long
        else "tests/Alltest -- -R 'pair.oscillating_flow$'")
    spheres = [(2.5, 0.5, 320), (2.5, 0.5, 640)]
    layers = [(1, 160)]
    if options.long:
        spheres = [(ratio, added, n) for ratio, added in ((2.5, 0.5), (2.5, 0), (0.01, 0.5)) for n in (160, 320, 640)]
        layers = [(f, n) for f in (0, 1) for n in (160, 320, 640)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        of_spheres = {s: pool.submit(sphere, options.demvof, *s) for s in spheres}
        of_layers = {s: pool.submit(dusty_layer, options.demvof, *s) for s in layers}
        of_spheres = {s: job.result() for s, job in of_spheres.items()}
        of_layers = {s: job.result() for s, job in of_layers.items()}
    for ratio, added in sorted({s[:2] for s in spheres}, reverse=True):
        line = {n: of_spheres[ratio, added, n] for n in sorted(s[2] for s in spheres if s[:2] == (ratio, added))}
        finest, (got, exact) = list(line.items())[-1]
        name = f"sphere, rho_p/rho {ratio:g}, C_m {added:g}"
        record.note(f"{name}: |v/u|, exact {abs(exact):.4f}", abs(got))
        record.note(f"{name}: phase, exact {math.degrees(cmath.phase(exact)):.2f}", math.degrees(cmath.phase(got)), "degrees")
        record.at_most(f"{name}: error of the amplitude, {finest} windows a period", abs(abs(got) / abs(exact) - 1), 0.01 if options.long else 0.0085)
        record.at_most(f"{name}: error of the phase", abs(math.degrees(cmath.phase(got / exact))), 0.3, "degrees")
        errors = [abs(g / e - 1) for g, e in line.values()]
        record.at_least(f"{name}: order in the window", math.log2(errors[-2] / errors[-1]), 0.9)
        record.curve("Sphere in an oscillating liquid", "windows a period", "error of v/u", f"{ratio:g}, C_m {added:g}",
                     line.keys(), errors, "xy")
    for (loading, n), (got, exact) in of_layers.items():
        name = f"layer with dust of loading {loading:g}, {n} windows a period"
        record.note(f"{name}: kappa/sqrt(w/nu), real part, exact {exact.real:.4f}", got.real)
        record.note(f"{name}: imaginary part, exact {exact.imag:.4f}", got.imag)
        record.at_most(f"{name}: error", abs(got / exact - 1), 0.012)
    momentum_of_everything(record, 1e-8 if options.long else 1e-12)
    raise SystemExit(record.write())


if __name__ == "__main__":
    main()
