# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against window, with particles told the fluid of the window's start (order 1) or of its middle (order 2).

A sphere in an oscillating liquid (oscillating_flow.py) against the exact amplitude and phase; fluid and as heavy particles
that come to one velocity (two_body_relaxation.py) against the exact course, and against the linear map of the scheme.

Usage: order_in_the_window.py DEMVOF [--long]"""
import concurrent.futures
import math

from box_case import command_line, momentum_of_everything
from oscillating_flow import sphere
from record import Record
from two_body_relaxation import DEM_STEPS, simulate

LOADING = 1.0


def relaxation(demvof, windows, order):
    """Largest error of fluid and particles after K T = rho eps, over the fluid's velocity at the start; and the run."""
    run = simulate(demvof, f"order_{order}_{windows}", "conservative_implicit", "staggered", 1 / windows, LOADING, 0, windows, order)
    time = 1 + 0.5 / (DEM_STEPS * windows)  # velocities are those of half steps
    fluid = (1 + LOADING * math.exp(-time * (1 + LOADING) / LOADING)) / (1 + LOADING)
    return abs(run["velocity"][-1] - [fluid, (1 - fluid) / LOADING]).max(), run


def main():
    options = command_line()
    record = Record(
        "order_in_the_window", "Error against window",
        "A sphere in an oscillating liquid and particles that come to one velocity with as heavy a fluid, with coupling.order 1 "
        "and 2 and windows of several lengths, against the exact solutions.",
        "tests/Alltest --verification -- -R pair.order_in_the_window_long" if options.long else "tests/Alltest -- -R 'pair.order_in_the_window$'")
    spheres = [(2.5, 0.5), (2.5, 0), (0.01, 0.5)] if options.long else [(2.5, 0.5)]
    per_period = (20, 40, 80, 160) if options.long else (40, 80)
    counts = (5, 10, 20, 40, 80) if options.long else (10, 20)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = {(f"sphere, rho_p/rho {ratio:g}, C_m {added:g}", order): [pool.submit(sphere, options.demvof, ratio, added, n, order) for n in per_period]
                for ratio, added in spheres for order in (1, 2)}
        errors = {key: [abs(got / exact - 1) for got, exact in (job.result() for job in line)] for key, line in jobs.items()}
        relaxing = {order: list(pool.map(lambda n, order=order: relaxation(options.demvof, n, order), counts)) for order in (1, 2)}
    for order in (1, 2):
        errors["relaxation", order] = [error for error, _ in relaxing[order]]
    for (name, order), line in errors.items():
        windows = counts if name == "relaxation" else per_period
        for n, error in zip(windows, line):
            record.note(f"{name}, order {order}: error with {n} windows", error)
        found = math.log2(line[-2] / line[-1])
        if order == 1:
            record.note(f"{name}, order 1: order in the window", found)
        else:
            record.at_least(f"{name}, order 2: order in the window", found, 1.8)
            record.at_most(f"{name}: error of order 2 over that of order 1, {windows[-1]} windows", line[-1] / errors[name, 1][-1], 0.2)
        record.curve(name, "windows", "error, -", f"order {order}", windows, line, "xy")
    runs = [run for _, run in relaxing[2]]
    record.at_most("relaxation, order 2: distance from the linear map", max(run["off_map"] for run in runs), 1.5e-6 if options.long else 3e-7)
    record.at_most("relaxation, order 2: exchange of momentum open", max(run["exchange"] for run in runs), 1e-13 if options.long else 1e-14)
    record.at_most("relaxation, order 2: drift of total momentum", max(run["momentum"] for run in runs), 1e-12 if options.long else 5e-14)
    momentum_of_everything(record, 1e-8 if options.long else 6e-14)
    raise SystemExit(record.write())


if __name__ == "__main__":
    main()
