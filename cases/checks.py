# SPDX-License-Identifier: GPL-3.0-or-later
"""What the check.py of the cases share: a run read from its folder, and a table of checked numbers."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "coupler" / "cli"))

from reporting.fields import particle_arrays  # noqa: E402
from reporting.run import NoRun, Run  # noqa: E402


def run_from_command_line(case_folder):
    """The run whose folder is the first argument; `run` in the case's folder without one."""
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else case_folder / "run"
    try:
        return Run(folder)
    except NoRun as error:
        print(f"check: {error}", file=sys.stderr)
        sys.exit(2)


def beads(run, time):
    """Of the output at that time: arrays by name, rows by the beads' id; none if there is no such output."""
    try:
        return particle_arrays(run.folder, time)
    except ImportError as error:
        print(f"check: VTK's Python modules are not installed (Debian: python3-vtk9): {error}", file=sys.stderr)
        sys.exit(2)


def schiller_naumann(reynolds):
    """Drag coefficient of a sphere (1933)."""
    return 24 * (1 + 0.15 * reynolds**0.687) / reynolds if reynolds < 1000 else 0.44


def terminal_velocity(diameter, density, fluid_density, viscosity, drag_coefficient=schiller_naumann, gravity=9.81):
    """Of a sphere: the root of weight - buoyancy - drag, by bisection, m/s; viscosity in Pa s."""
    weight = (density - fluid_density) * math.pi / 6 * diameter**3 * gravity
    low, high = 1e-6, 10.0
    while high - low > 1e-12:
        speed = 0.5 * (low + high)
        reynolds = fluid_density * speed * diameter / viscosity
        drag = math.pi * diameter**2 / 8 * drag_coefficient(reynolds) * fluid_density * speed**2
        low, high = (speed, high) if drag < weight else (low, speed)
    return low


class Checks:
    """Prints each number with its bound; exit_code() is 1 if one is outside."""

    def __init__(self):
        self.failed = 0

    def _line(self, good, what, text):
        print(f"{'ok ' if good else 'NOT'}  {what:<52} {text}")
        self.failed += not good

    def at_most(self, what, value, bound, unit=""):
        good = value is not None and value <= bound
        self._line(good, what, f"{'missing' if value is None else f'{value:.4g}'} {unit} (at most {bound:.4g})")

    def at_least(self, what, value, bound):
        good = value is not None and value >= bound
        self._line(good, what, f"{'missing' if value is None else value} (at least {bound})")

    def equal(self, what, value, expected):
        self._line(value == expected, what, f"{value} (expected {expected})")

    def near(self, what, value, expected, tolerance, unit=""):
        error = None if value is None else value / expected - 1
        good = error is not None and abs(error) <= tolerance
        found = "missing" if value is None else f"{value:.4g} {unit}, {100 * error:+.2f} %"
        self._line(good, what, f"{found} of {expected:.4g} (at most {100 * tolerance:g} %)")

    @staticmethod
    def note(what, text):
        print(f"     {what:<52} {text}")

    def exit_code(self):
        return 1 if self.failed else 0
