# SPDX-License-Identifier: GPL-3.0-or-later
"""Two histories that should be the same, compared."""


def differences(run, whole):
    """The largest difference of each recorded quantity at any time, relative to its own largest value; a component is
    compared with the largest one of its vector."""
    found = {}
    for name, values in whole.history.items():
        if name.startswith("max_speed_") or name == "time":
            continue  # a place may change from one cell to another of the same speed
        family = [other for other in whole.history if name[-2:] in ("_x", "_y", "_z") and other[:-2] == name[:-2]]
        scale = max(abs(v) for other in family or [name] for v in whole.history[other]) or 1
        found[name] = max(abs(v - w) for v, w in zip(values, run.history[name])) / scale
    return found
