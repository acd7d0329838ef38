# SPDX-License-Identifier: GPL-3.0-or-later
"""The pair that faults are injected into: small, with a surface, contacts and both programs busy."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "verification" / "pair"))
from box_case import BoxCase, Open, Particle, Wall, SIDES  # noqa: E402


def beads_into_water(folder, fine=(8, 4, 8), **keys):
    """Its case file; windows of 1 ms, a state after every second one."""
    beads = [Particle((0.01 + 0.02 * (i % 2), 0.006 + 0.008 * (i // 2 % 2), 0.024 + 0.004 * (i // 4)), 2e-3, 2500,
                      velocity=(0, 0, -0.3)) for i in range(12)]
    keys = {"end_time": 0.01, "output_interval": 2e-3, **keys}
    end_time = keys.pop("end_time")
    return BoxCase(folder, (0.04, 0.02, 0.04), fine, (8, 4, 8), end_time, window=1e-3, level=0.0174,
                   gravity=(5, 0, -8.4), contacts=True, dem_step=1e-5, particles=beads,
                   sides={side: Open() if side == "z+" else Wall() for side in SIDES}, **keys).write()
