# SPDX-License-Identifier: GPL-3.0-or-later
"""Windows as long as their error allows: a bead falls into water over a bed at rest.

Windows are long while the bead falls through air, short when it meets the water, and long again. The bead's momentum in
such a run and in runs with windows of one length is compared with that in a run with short ones. The fluid's step is the
same in all of them, so that only the exchange differs.

Usage: own_windows.py DEMVOF [--long]"""
import concurrent.futures

import numpy
from box_case import BoxCase, Open, Particle, SIDES, Wall, command_line, momentum_of_everything, scratch
from record import Record

DIAMETER, DENSITY, LEVEL = 2e-3, 2500, 0.0275
END, INTERVAL = 0.05, 0.01
SHORT, STEP = 1e-4, 1e-4  # window of the reference; of the fluid, s
FALL, SPLASH = (0.012, 0.0235), (0.0265, 0.033)  # s: in air; from meeting the water on


def simulate(demvof, name, window):
    bed = [Particle((0.0025 + 0.005 * i, 0.0025 + 0.005 * j, DIAMETER / 2), DIAMETER, DENSITY)
           for i in range(8) for j in range(4)]
    bead = Particle((0.0225, 0.0125, 0.045), DIAMETER, DENSITY, velocity=(0, 0, -0.5))
    case = BoxCase(scratch(f"own_windows/{name}"), (0.04, 0.02, 0.06), (8, 4, 12), (8, 4, 12), END, window, level=LEVEL,
                   contacts=True, dem_step=1e-5, particles=bed + [bead], first_step=STEP, longest_step=STEP, courant=0.3,
                   sides={side: Open() if side == "z+" else Wall() for side in SIDES}, output_interval=INTERVAL,
                   tolerance=1e-9)
    return case.run(demvof)


def momentum(run):
    """Of the particles, at the outputs."""
    rows = [numpy.argmin(abs(run.times - INTERVAL * n)) for n in range(1, round(END / INTERVAL) + 1)]
    assert numpy.allclose(run.times[rows], INTERVAL * numpy.arange(1, len(rows) + 1), rtol=1e-12), "outputs are met"
    return run.history["particle_momentum_z"][rows]


def error(run, reference):
    exact = momentum(reference)
    return numpy.sqrt(((momentum(run) - exact)**2).mean() / (exact**2).mean())


def main():
    options = command_line()
    lengths = (1e-3, 5e-4, 2e-4) if options.long else (1e-3,)
    tolerances = (1e-3, 2e-4, 1e-4, 5e-5) if options.long else (5e-5,)
    windows = {"reference": SHORT, **{f"window {length:g} s": length for length in lengths},
               **{f"tolerance {t:g} m/s": {"tolerance": t, "shortest": 1e-4, "longest": 5e-3} for t in tolerances}}
    record = Record(
        "own_windows", "Windows as long as their error allows",
        "A bead falls through air into water over a bed of 32 beads at rest, with windows of one length and with windows of "
        "their own lengths. The momentum of the beads at the outputs is compared with that in a run with windows of 0.1 ms; "
        "the fluid's step is 0.1 ms in all of them.",
        "tests/Alltest --verification -- -R pair.own_windows_long" if options.long else "tests/Alltest -- -R 'pair.own_windows$'")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = dict(zip(windows, pool.map(lambda item: simulate(options.demvof, item[0].split()[0] + item[0].split()[-2]
                                                                if " " in item[0] else item[0], item[1]), windows.items())))
    costs = {}
    for name, run in runs.items():
        if name == "reference":
            continue
        costs[name] = (run.results["steps"]["windows"], error(run, runs["reference"]))
        print("{}: {} windows, error {:.5f}".format(name, *costs[name]))
        record.note(f"{name}: windows", costs[name][0])
        record.note(f"{name}: error of the momentum", costs[name][1])
    count, wrong = costs[f"window {lengths[0]:g} s"]
    own_count, own_wrong = costs[f"tolerance {tolerances[-1]:g} m/s"]
    # The error is of first order in the window: windows times error says what an error costs.
    record.at_most("windows times error, over that of windows of 1 ms", own_count * own_wrong / (count * wrong), 0.8)
    record.at_most("error, over that of windows of 1 ms", own_wrong / wrong, 0.6)
    run = runs[f"tolerance {tolerances[-1]:g} m/s"]
    lengths = run.history["window"]
    within = lambda span: lengths[(run.times > span[0]) & (run.times < span[1])]  # noqa: E731
    record.at_least("longest window in the fall over the shortest at the splash", within(FALL).max() / within(SPLASH).min(), 3)
    conservation = max(run.results["conservation"][book] for run in runs.values() for book in ("exchange", "momentum", "solid_volume"))
    record.at_most("impulse, momentum, solid volume: worst window", conservation, 1e-13)
    if options.long:
        for label, part in (("one length", "window"), ("their own lengths", "tolerance")):
            some = sorted(cost for name, cost in costs.items() if name.startswith(part))
            record.curve("Error against cost", "windows", "error of the momentum, -", label, [n for n, _ in some],
                         [e for _, e in some], log="xy")
    momentum_of_everything(record, 1e-12)
    raise SystemExit(record.write())


main()
