#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The report, of whole runs and of what is left of broken ones; runs are those of tests/support/made_run.py."""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "coupler" / "cli" / "report.py"
sys.path[:0] = [str(SCRIPT.parent), str(ROOT / "tests" / "support")]

from made_run import CELLS, RESULTS, write_run  # noqa: E402
from reporting import fields, run, tables  # noqa: E402

def report(*folders):
    """(exit code, what was printed, the page)."""
    done = subprocess.run([sys.executable, SCRIPT, *folders], capture_output=True, text=True, cwd=folders[0], check=False)
    page = folders[0] / "report.html"
    return done.returncode, done.stdout + done.stderr, page.read_text() if page.exists() else ""


class Reports(unittest.TestCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.place)

    def test_a_whole_run(self):
        code, printed, page = report(write_run(self.place / "a"))
        self.assertEqual(code, 0, printed)
        self.assertIn("report.html", printed)
        self.assertNotIn("Not shown", page)
        for text in ("completed", "t = 0 s", "t = 0.2 s", "3 min 20 s", "There is &lt;none&gt;.", "a processor", "2.0e-09",
                     "75.0 %", 'alt="fronts against time"', "relative change"):
            self.assertIn(text, page)
        self.assertNotIn("t = 0.1 s", page)  # not among output.pictures
        self.assertNotRegex(page, r'(src|href)="(?!data:)')  # self-contained

    def test_windows_of_their_own_lengths_are_shown_over_time(self):
        folder = write_run(self.place / "a", window={"shortest": 1e-4, "longest": 2e-3, "largest_error": 1.5, "over": 3})
        (folder / "history.csv").write_text("time,window,window_error,active_bulk_cells,smallest_relaxation\n# s,s,-,-,-\n"
                                            "0,0,0,0,1\n0.1,2e-3,0.5,7,0.6\n0.2,1e-4,2,8,0.7\n")
        code, printed, page = report(folder)
        self.assertEqual(code, 0, printed)
        shown = page[page.index("From window to window"):page.index("<h2>Run</h2>")]
        for title in ("Length of the windows", "Error of the windows over what is allowed", "Bulk cells averaged and exchanged",
                      "Smallest relaxation factor of what particles are told"):
            self.assertIn(f'alt="{title}"', shown)
            self.assertEqual(page.count(f'alt="{title}"'), 1)
        self.assertIn("0.0001 s to 0.002 s, 3 above the tolerance", page)
        self.assertNotIn("Not shown", page)

    def test_the_plane_shows_liquid_surface_and_particles_where_they_are(self):
        section = fields.read(write_run(self.place / "a"), 0.2)
        self.assertEqual(section.normal, "y")
        self.assertAlmostEqual(section.position, 0.25)
        numpy.testing.assert_allclose(section.lower, [0, 0])
        numpy.testing.assert_allclose(section.upper, [1, 1])
        self.assertEqual(len(section.polygons), CELLS[0] * CELLS[2])
        for polygon, liquid in zip(section.polygons, section.liquid):
            self.assertEqual(liquid, 1 if polygon[:, 1].mean() < 0.5 else 0)
        for line in section.surface:  # between the layers with alpha = 1 and 0
            numpy.testing.assert_allclose(line[:, 1], 0.5, atol=1e-6)
        numpy.testing.assert_allclose(section.centres, [[0.25, 0.125]])
        numpy.testing.assert_allclose(section.radii, [0.02])
        numpy.testing.assert_allclose(section.speeds, [5])

    def test_warnings_unfold_what_explains_them(self):
        said = ["law <x> out of range (docs/warnings.md, Range of a law)", "odd (docs/warnings.md, No such heading)", "plain"]
        code, printed, page = report(write_run(self.place / "a", warnings=said))
        self.assertEqual(code, 0, printed)
        self.assertIn("; 3 warnings.", page)
        self.assertIn("<summary>law &lt;x&gt; out of range</summary><p>A law (drag, lift, torque, history) was asked", page)
        self.assertIn("<code>closures</code> of results.json.</p>", page)  # the last words of that section
        self.assertIn('<summary>odd</summary><p class="quiet">docs/warnings.md, No such heading</p>', page)
        self.assertIn("<li>plain</li>", page)

    def test_a_failed_run_says_where_and_why(self):
        failure = {"side": "particles", "stage": "DEM steps", "time": 0.15, "message": "Lost atoms <3>"}
        folder = write_run(self.place / "a", status="failed", failure=failure)
        (folder / "particles.log").write_text("line 1\nERROR: Lost atoms\n")
        code, _, page = report(folder)
        self.assertEqual(code, 0)
        for text in ("The particles side failed in DEM steps at t = 0.15 s", "Lost atoms &lt;3&gt;", "ERROR: Lost atoms"):
            self.assertIn(text, page)

    def test_a_run_without_results_shows_how_far_it_came(self):
        folder = write_run(self.place / "a")
        (folder / "results.json").unlink()
        (folder / "progress.json").write_text('{"time": 0.25, "end_time": 0.5}')
        code, _, page = report(folder)
        self.assertEqual(code, 0)
        self.assertIn("unfinished", page)
        self.assertIn("0.25 s of 0.5 s", page)

    def test_each_part_may_be_missing_or_cut_off(self):
        def cut(path, size=60):
            path.write_bytes(path.read_bytes()[:size])

        damages = {
            "no history": lambda f: (f / "history.csv").unlink(),
            "no row of history": lambda f: (f / "history.csv").write_text("time,liquid_front\n# s,m\n"),
            "half a row of history": lambda f: (f / "history.csv").write_text("time,liquid_front\n# s,m\n0,0.1\n0.1"),
            "half of the results": lambda f: cut(f / "results.json"),
            "no fluid": lambda f: shutil.rmtree(f / "fluid"),
            "no mesh": lambda f: shutil.rmtree(f / "fluid" / "constant"),
            "half a field": lambda f: cut(f / "fluid" / "0.2" / "alpha.water", 300),
            "a time without fields": lambda f: (f / "fluid" / "0.2" / "alpha.water").unlink(),
            "no particles": lambda f: shutil.rmtree(f / "particles"),
            "half a particle file": lambda f: cut(f / "particles" / "particles_000002.vtp"),
            "half a particle index": lambda f: cut(f / "particles" / "particles.pvd"),
        }
        for damage, inflict in damages.items():
            with self.subTest(damage):
                folder = write_run(self.place / damage.replace(" ", "_"))
                inflict(folder)
                code, printed, page = report(folder)
                self.assertEqual(code, 0, printed)
                self.assertTrue(page.rstrip().endswith("</html>"))
        with self.subTest("a field that cannot be read leaves the other pictures alone"):
            page = (self.place / "a_time_without_fields" / "report.html").read_text()
            self.assertIn('alt="surface at 0 s"', page)
            self.assertNotIn('alt="surface at 0.2 s"', page)

    def test_several_runs_are_compared(self):
        one = write_run(self.place / "one")
        configuration = {**RESULTS["configuration"], "coupling": {"end_time": 0.2, "window": 5e-4}}
        two = write_run(self.place / "two", configuration=configuration, quantities={"liquid_front": 0.75})
        code, printed, page = report(one, two)
        self.assertEqual(code, 0, printed)
        self.assertIn("2 at the start, 2 at the end, 0 lost", printed)
        self.assertIn("coupling.window", page)
        self.assertNotIn("coupling.end_time</td>", page)  # the same in both
        with open(one / "results.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["coupling.window"] for row in rows], ["0.001", "0.0005"])
        self.assertEqual([row["quantities.liquid_front"] for row in rows], ["0.5", "0.75"])
        self.assertEqual([row["status"] for row in rows], ["completed", "completed"])

    def test_a_folder_of_something_else_is_refused(self):
        code, printed, page = report(self.place)
        self.assertEqual((code, page), (2, ""))
        self.assertIn("not the folder of a run", printed)

    def test_history_reads_back_with_units(self):
        path = self.place / "history.csv"
        path.write_text("time,liquid_front,particles\n# s,m,-\n0,0.05,nan\n0.1,0.0625,3883\n")
        columns, units = run.read_history(path)
        self.assertEqual(units, {"time": "s", "liquid_front": "m", "particles": "-"})
        numpy.testing.assert_array_equal(columns["liquid_front"], [0.05, 0.0625])
        self.assertTrue(numpy.isnan(columns["particles"][0]))

    def test_numbers_for_people(self):
        self.assertEqual(tables.amount(0.123456, "m"), "0.1235 m")
        self.assertEqual(tables.amount(511104), "511104")
        self.assertEqual(tables.amount(None, "m"), "-")
        self.assertEqual([tables.duration(t) for t in (0.5, 59, 61, 3720)], ["0.5 s", "59 s", "1 min 01 s", "1 h 02 min"])


if __name__ == "__main__":
    unittest.main()
