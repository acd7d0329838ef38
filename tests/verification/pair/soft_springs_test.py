#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts that drag outruns are warned of, with the windows that help: soft_springs_test.py DEMVOF

The suspension of measured_settling.py for a few windows: on springs of 0.1 N/m in windows of 20 ms, and as it is there.
"""
import re
import sys

import measured_settling
from box_case import command_line


def warnings(demvof, stiffness, window):
    measured_settling.STIFFNESS, measured_settling.WINDOW, measured_settling.INTERVAL = stiffness, window, 0.2
    run = measured_settling.simulate(demvof, "gidaspow", 0.2)[0]
    return [line for line in run.results["warnings"] if "docs/warnings.md, Soft contacts" in line]


def main():
    demvof = command_line().demvof
    said = warnings(demvof, 0.1, 0.02)
    assert len(said) == 1, said
    numbers = re.search(r"in (\d+) windows .* windows of (\S+) s and longer, of (\S+) s and shorter", said[0])
    windows, longer, shorter = int(numbers[1]), float(numbers[2]), float(numbers[3])
    assert windows == 10, said
    # 2 beta/k_t: a sphere that sinks at v = eps v_St/F has the slip v/eps, and bears eps of its weight in the liquid: the rest of
    # it is in the pressure of all.
    eps = 1 - measured_settling.FRACTION
    stokes = 3 * 3.14159265 * measured_settling.NU * measured_settling.LIQUID * measured_settling.DIAMETER
    beta = stokes * measured_settling.drag_over_stokes("gidaspow", eps) * eps
    assert abs(longer / (2 * beta / (0.2857 * 0.1)) - 1) < 0.05, (said, beta)  # two digits are printed
    assert shorter < 1e-4 < longer, said
    assert not warnings(demvof, 0.5, 0.1)


if __name__ == "__main__":
    sys.exit(main())
