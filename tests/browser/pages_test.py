#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""report.html of a run, of two runs, and study.html, in headless Chromium at 400 and 1400 px.

pages_test.py DEMVOF: makes a short study of the hydrostatic bed with a failing row and looks at its pages.
pages_test.py DEMVOF PAGE...: looks at these pages; screenshots beside them, PAGE.400.png and PAGE.1400.png.
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from page import chromium, look

CASE = pathlib.Path(__file__).resolve().parents[2] / "cases" / "hydrostatic_bed" / "case.yaml"
WIDTHS = (400, 1400)
STUDY = """
case: {case}
set: {{coupling.end_time: 0.01, output.interval: 0.005}}
quantities: [kinetic_energy, mean_level]
reference: {{row: long_windows}}
rows:
  long_windows: {{}}
  short_windows: {{single_scale: yes, set: {{coupling.window: 5.0e-4}}}}
  wrong: {{set: {{coupling.window: 0.003}}}}
"""


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.temporary.name)
        (folder / "short.yaml").write_text(STUDY.format(case=CASE))
        study = subprocess.run([DEMVOF, "study", folder / "short.yaml", "--out", folder], check=False, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        assert study.returncode == 3, study.stdout  # one row cannot run
        one, two = folder / "long_windows" / "run", folder / "short_windows" / "run"
        subprocess.run([DEMVOF, "report", one], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([DEMVOF, "report", two, one], check=True, stdout=subprocess.DEVNULL)
        cls.pages = {"of a run": one / "report.html", "of two runs": two / "report.html", "of a study": folder / "study.html"}
        cls.least_pictures = {"of a run": 5, "of two runs": 5, "of a study": 2}

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_readable_at_every_width(self):
        with chromium() as browser:
            for name, page in self.pages.items():
                for width in WIDTHS:
                    with self.subTest(page=name, width=width):
                        complaints, pictures = look(browser, page, width)
                        self.assertEqual(complaints, [])
                        self.assertGreaterEqual(pictures, self.least_pictures[name])

    def test_a_bad_page_is_noticed(self):
        bad = pathlib.Path(self.temporary.name) / "bad.html"
        bad.write_text("<!DOCTYPE html><html><body><div style='width: 900px'>wide</div><img src='no.png' alt='gone'>"
                       "<p style='font-size: 6px'>small</p><script>nothing.at.all()</script></body></html>")
        with chromium() as browser:
            complaints = " ".join(look(browser, bad, 400)[0])
        for expected in ("px wide", "not exactly one h1", "no language", "gone: not loaded", "self-contained", "6 px",
                         "nothing is not defined"):
            self.assertIn(expected, complaints)


def look_at(pages):
    bad = 0
    with chromium() as browser:
        for page in map(pathlib.Path, pages):
            for width in WIDTHS:
                complaints, pictures = look(browser, page, width, page.with_suffix(f".{width}.png"))
                print(f"{page} at {width} px: {pictures} pictures, {len(complaints)} complaints")
                print("".join(f"  {complaint}\n" for complaint in complaints), end="")
                bad += len(complaints)
    return 1 if bad else 0


if __name__ == "__main__":
    DEMVOF = sys.argv[1]
    if len(sys.argv) > 2:
        sys.exit(look_at(sys.argv[2:]))
    unittest.main(argv=sys.argv[:1])
