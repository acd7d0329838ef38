#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A sphere skims along a surface, half under it: half_submerged.py DEMVOF

Its bulk cells hold liquid and gas. How the drag is shared between them (coupling.sharing) must not blow the gas away:
no fluid may become faster than the sphere that drags it. Density ratios 1 to 1e4, both sharings, no gravity.
"""
import sys

import numpy

from box_case import BoxCase, Open, Particle, Slip, SIDES, momentum_of_everything, scratch
from record import Record

SPEED, DIAMETER = 0.5, 4e-3
RATIOS = [1, 10, 1000, 10000]


def skim(folder, demvof, kernel, ratio, sharing):
    sides = {side: Open() if side == "z+" else Slip() for side in SIDES}
    case = BoxCase(folder, (0.08, 0.06, 0.07), (16, 12, 14), (8, 6, 7), end_time=0.06, window=1e-3, sides=sides,
                   gravity=(0, 0, 0), gas=(1000 / ratio, 1e-5), level=0.035, tolerance=1e-12,
                   coupling={"sharing": sharing, "averaging": {"kernel": kernel}},
                   particles=[Particle((0.02, 0.03, 0.035), DIAMETER, 8000, velocity=(SPEED, 0, 0))])
    return case.run(demvof)


def main():
    demvof = sys.argv[1]
    record = Record("half_submerged", "Sharing between liquid and gas: a half-submerged sphere",
                    "A sphere of 4 mm (8000 kg/m3) starts at 0.5 m/s along a water surface, centre on the surface, in "
                    "bulk cells of 10 mm that hold liquid and gas, without gravity, for 0.06 s. With `sharing: mass` "
                    "(default) no fluid becomes faster than the sphere at any density ratio; `volume`, the paper's, "
                    "is recorded beside it. The kernel `centre` puts all drag into half-filled cells and shows the "
                    "sharing alone; `gaussian` also reaches cells full of gas, where nothing is shared.",
                    "tests/Alltest -- -R pair.half_submerged")
    for kernel in "centre", "gaussian":
        for sharing in "mass", "volume":
            fastest, gas = [], []
            for ratio in RATIOS:
                run = skim(scratch("half_submerged") / f"{kernel}_{sharing}_{ratio}", demvof, kernel, ratio, sharing)
                fastest.append(float(numpy.max(run.history["max_speed"])) / SPEED)
                gas.append(float(numpy.max(run.history["velocity_squared_integral_gas"])))
                name = f"{kernel}, {sharing}, density ratio {ratio}"
                if sharing == "mass":
                    record.at_most(f"{name}: fastest fluid / sphere's speed", fastest[-1], 1,
                                   loose="what is asked: nothing outruns the sphere")
                else:
                    record.note(f"{name}: fastest fluid / sphere's speed", fastest[-1])
                record.note(f"{name}: largest integral of u.u in the gas", gas[-1], "m5/s2")
                record.at_most(f"{name}: momentum exchange", run.results["conservation"]["exchange"], 1.5e-13)
                record.at_most(f"{name}: momentum of the sphere", run.results["conservation"]["momentum"], 1.6e-14)
            series = f"{kernel}, {sharing}"
            record.curve("fastest fluid", "density ratio", "fastest fluid / sphere's speed", series, RATIOS, fastest,
                         log="xy")
            record.curve("gas", "density ratio", "largest integral of u.u in the gas, m5/s2", series, RATIOS, gas,
                         log="xy")
    momentum_of_everything(record, 4.4e-13)
    return record.write()


if __name__ == "__main__":
    sys.exit(main())
