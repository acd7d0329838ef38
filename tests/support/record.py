# SPDX-License-Identifier: GPL-3.0-or-later
"""What a verification test measured: values with their bounds, and curves for its picture.

    record = Record("terminal_velocity", "Terminal velocity of six spheres", "What is tested and against what.")
    record.at_most("worst error", 0.004, 0.01, "-")
    record.note("bulk cells", 120, "-")
    record.curve("error against bulk spacing", "spacing / d", "error, -", "measured", xs, ys, log="xy")
    sys.exit(record.write())

write() prints a table, writes <folder>/<row>.json and returns 0 when every bound holds, 1 otherwise. The folder is
$DEMVOF_RECORDS, or records/ below the working directory. record.hpp writes the same file from C++.
"""
import json
import math
import os
import pathlib
import sys
import time


ROUND_OFF = 1e-8  # bounds below it are of round-off


def room(value):
    """How much worse a value of a record could be within its bound, as a factor."""
    better, worse = sorted((abs(value["value"]), abs(value["bound"])))
    if value["comparison"] == "at least" and value["value"] < 0:
        better, worse = worse, better
    return worse / better if better > 0 else math.inf


def without_teeth(values):
    """Of a record's values those whose bound has more room than 3 times, round-off 20 times, and no written reason for
    it. One bound for a sweep, rows "what is varied: quantity", is judged by the row that comes closest to it. A count
    that has to be 0 and a round-off that is exactly 0 have none to measure."""
    closest = {}
    for value in values:
        bound = value["bound"]
        if bound is None or value.get("loose") or not value["passed"] or bound == 0:
            continue
        round_off = abs(bound) < ROUND_OFF
        if round_off and value["value"] == 0:
            continue
        sweep = (value["name"].rsplit(": ", 1)[-1], bound, value["comparison"])
        best = closest.get(sweep)
        if best is None or room(value) < room(best):
            closest[sweep] = value
    return [value for value in closest.values() if room(value) > (20 if abs(value["bound"]) < ROUND_OFF else 3)]


class Record:
    def __init__(self, row, title, what, command=None):
        """row: file name and key; what: a paragraph for docs/verification.md; command: that repeats it, from the
        project's top folder (default: this program and its arguments)."""
        self.row, self.title, self.what = row, title, what
        self.command = command or " ".join(os.path.relpath(word) if os.path.isabs(word) else word for word in sys.argv)
        self.values, self.curves = [], []
        self.begin = time.monotonic()

    def _add(self, name, value, bound, unit, comparison, passed, loose=None):
        self.values.append({"name": name, "value": value, "bound": bound, "unit": unit, "comparison": comparison,
                            "passed": bool(passed), **({"loose": loose} if loose else {})})

    def at_most(self, name, value, bound, unit="-", loose=None):
        """loose: why the bound may be further away than 3 times the value (20 times where it is round-off)."""
        self._add(name, value, bound, unit, "at most", math.isfinite(value) and value <= bound, loose)

    def at_least(self, name, value, bound, unit="-", loose=None):
        self._add(name, value, bound, unit, "at least", math.isfinite(value) and value >= bound, loose)

    def note(self, name, value, unit="-"):
        """A number that is measured and held to no bound."""
        self._add(name, value, None, unit, "recorded", True)

    def curve(self, picture, x_label, y_label, series, x, y, log="", style="o-"):
        """A line of a picture: curves of the same `picture` share axes. log: any of "x", "y". style: as in
        matplotlib, e.g. "k-" for what is exact."""
        self.curves.append({"picture": picture, "x_label": x_label, "y_label": y_label, "series": series,
                            "x": [float(v) for v in x], "y": [float(v) for v in y], "log": log, "style": style})

    def write(self):
        folder = pathlib.Path(os.environ.get("DEMVOF_RECORDS", "records"))
        folder.mkdir(parents=True, exist_ok=True)
        content = {"row": self.row, "title": self.title, "what": self.what, "command": self.command,
                   "wall_seconds": round(time.monotonic() - self.begin, 1), "values": self.values,
                   "curves": self.curves}
        (folder / f"{self.row}.json").write_text(json.dumps(content, indent=1) + "\n")
        loose = without_teeth(self.values)
        for v in self.values:
            bound = "" if v["bound"] is None else f"({v['comparison']} {v['bound']:.4g})"
            value = v["value"] if isinstance(v["value"], (int, str)) else f"{v['value']:.4g}"
            print(f"{'ok ' if v['passed'] else 'NOT'}  {v['name']:<60} {value} {v['unit']} {bound}"
                  + (f"  {room(v):.0f} times the value" if any(v is one for one in loose) else ""))
        return 0 if all(v["passed"] for v in self.values) else 1
