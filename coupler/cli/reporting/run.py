# SPDX-License-Identifier: GPL-3.0-or-later
"""The output folder of a run, as far as the run got: whatever is missing or cut off is left out."""
import csv
import json
import pathlib
import re

import numpy


class NoRun(Exception):
    """The folder holds nothing of a run."""


class Run:
    """results: results.json, or what can be said without it; history: column name -> values, times in "time";
    units: column name -> unit."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        outputs = ("results.json", "history.csv", "progress.json")
        if not any((self.folder / name).is_file() for name in outputs):
            raise NoRun(f"{folder}: there is none of {', '.join(outputs)}: not the folder of a run")
        self.progress = read_json(self.folder / "progress.json")
        self.results = read_json(self.folder / "results.json")
        self.history, self.units = read_history(self.folder / "history.csv")

    @property
    def name(self):
        return self.folder.resolve().name

    @property
    def status(self):
        return self.results.get("status", "unfinished: there is no results.json")

    @property
    def completed(self):
        return self.status == "completed"

    @property
    def configuration(self):
        return self.results.get("configuration") or {}

    @property
    def times(self):
        return self.history.get("time", numpy.array([]))

    @property
    def last_time(self):
        """Simulated time that the run reached as far as its files tell, s; None if they do not."""
        reached = [float(time) for time in self.times[-1:]] + [self.progress.get("time")]
        return max((time for time in reached if isinstance(time, (int, float))), default=None)

    def setting(self, path, default=None):
        """A value of the resolved configuration: setting("output.pictures")."""
        value = self.configuration
        for key in path.split("."):
            if not isinstance(value, dict) or key not in value:
                return default
            value = value[key]
        return value

    def number(self, path):
        """A number of results.json: number("wall_seconds.total"); None if it is not there or null."""
        value = self.results
        for key in path.split("."):
            value = value.get(key) if isinstance(value, dict) else None
        return value if isinstance(value, (int, float)) and not isinstance(value, bool) else None

    @property
    def gravity(self):
        return read_gravity(self.folder)

    def reference_files(self, pattern):
        """Reference data of the case: beside the run's folder, or in the folder that report.py is called from."""
        for place in (self.folder.resolve().parent, pathlib.Path.cwd()):
            found = sorted((place / "reference").glob(pattern))
            if found:
                return found
        return []

    def log_tail(self, name, count=25):
        """The last lines of a log; empty if there is none."""
        try:
            return (self.folder / name).read_text(errors="replace").splitlines()[-count:]
        except OSError:
            return []


def read_gravity(folder):
    """Of the fluid case of a run, m/s2; a zero vector if it is not there."""
    try:
        text = (folder / "fluid" / "constant" / "g").read_text()
        return numpy.array([float(x) for x in re.search(r"value[^(]*\(([^)]*)\)", text).group(1).split()])
    except (OSError, AttributeError, ValueError):
        return numpy.zeros(3)


def read_json(path):
    """The file's object; an empty one if there is no such file or it is cut off."""
    try:
        content = json.loads(path.read_text())
        return content if isinstance(content, dict) else {}
    except (OSError, ValueError):
        return {}


def read_history(path):
    """Columns and units of history.csv; rows that are cut off or no numbers end the table."""
    try:
        lines = path.read_text().splitlines()
    except OSError:
        return {}, {}
    if not lines:
        return {}, {}
    names = lines[0].split(",")
    units, rows = {}, []
    for line in lines[1:]:
        if line.startswith("#"):
            units = dict(zip(names, line.lstrip("# ").split(",")))
            continue
        try:
            row = [float(cell) for cell in line.split(",")]
        except ValueError:
            break
        if len(row) != len(names):
            break
        rows.append(row)
    table = numpy.array(rows).reshape(len(rows), len(names))
    return {name: table[:, i] for i, name in enumerate(names)}, units


def read_reference(path):
    """A reference table: (source line, column name -> values). Comment lines come first."""
    lines = path.read_text().splitlines()
    comments = [line.lstrip("# ") for line in lines if line.startswith("#")]
    rows = list(csv.DictReader(line for line in lines if line and not line.startswith("#")))
    columns = {}
    for name in rows[0] if rows else []:
        try:
            columns[name] = numpy.array([float(row[name]) for row in rows])
        except ValueError:
            pass  # a column of words
    return " ".join(comments), columns
