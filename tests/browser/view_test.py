#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The report's 3D view in headless Chromium, WebGL by the processor: what is seen is counted and measured in the picture.

The run is made by hand (tests/support/made_run.py): ten spheres of two sizes at the first time, six at the second, that
do not hide each other from the front, in and beside a box of 1 x 0.5 x 1 m half full of water.
"""
import io
import pathlib
import sys
import tempfile
import time
import unittest

import numpy
from matplotlib import image
from selenium.webdriver.common.action_chains import ActionChains

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "coupler" / "cli"), str(ROOT / "tests" / "support")]

from made_run import write_run  # noqa: E402
from page import chromium, look  # noqa: E402
from reporting import page  # noqa: E402
from reporting.run import Run  # noqa: E402

SMALL, LARGE = 0.02, 0.04  # radii, m


def spheres(count):
    """Rows of five, every second sphere large, all of them fast: bright."""
    return [(i + 1, (0.1 + 0.27 * (i % 5), 0.1 + 0.05 * (i % 7), 0.3 + 0.4 * (i // 5)), LARGE if i % 2 else SMALL, (1, 0, 0))
            for i in range(count)]


def blobs(picture):
    """Areas, px, and centres of what has a colour between red and yellow, from left to right; below the colour bar."""
    red, _, blue = (picture[40:, :, i].astype(float) for i in range(3))
    left = {tuple(pixel) for pixel in numpy.argwhere(red - blue > 0.25)}
    found = []
    while left:
        edge, blob = [left.pop()], []
        while edge:
            y, x = edge.pop()
            blob.append((x, y))
            for near in ((y + 1, x), (y - 1, x), (y, x + 1), (y, x - 1)):
                if near in left:
                    left.remove(near)
                    edge.append(near)
        found.append((len(blob), numpy.mean(blob, axis=0)))
    return sorted(found, key=lambda one: tuple(one[1]))


class Picture:
    """The page's view, with hands."""

    def __init__(self, browser):
        self.browser = browser
        self.figure = browser.find_element("css selector", "figure.view")
        self.canvas = browser.find_element("css selector", ".stage > canvas")

    def press(self, name):
        for button in self.figure.find_elements("tag name", "button"):
            if name in (button.text, button.get_attribute("title")):
                button.click()

    def tick(self, name):
        for label in self.figure.find_elements("tag name", "label"):
            if label.text.strip() == name:
                label.find_element("tag name", "input").click()

    def seen(self):
        """Of the stage, once drawn."""
        self.browser.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")
        self.browser.execute_script("arguments[0].scrollIntoView()", self.figure)
        return image.imread(io.BytesIO(self.canvas.screenshot_as_png))

    def drag(self, x, y):
        ActionChains(self.browser, duration=50).move_to_element(self.canvas).click_and_hold().move_by_offset(x, y).release(
            ).perform()

    def text(self, selector):
        return self.figure.find_element("css selector", selector).text


class Views(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.temporary.name)
        run = Run(write_run(folder / "run", {0: spheres(10), 0.2: spheres(6)}))
        cls.page = folder / "report.html"
        cls.page.write_text(page.html([run]))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_what_is_drawn_is_what_the_run_left(self):
        with chromium() as browser:
            self.assertEqual(look(browser, self.page, 1000)[0], [])
            view = Picture(browser)
            with_water = view.seen()
            self.assertEqual((view.text("output"), view.text(":scope > p")), ("t = 0.2 s", "6 particles; 16 triangles of the surface."))
            self.assertIn("1 m/s", view.text(".colours"))
            view.tick("surface")
            view.tick("wetted walls")
            water = (abs(with_water - view.seen()).max(axis=2) > 0.02).mean()
            self.assertGreater(water, 0.05)  # of the stage

            view.press("front")
            front = view.seen()
            self.assertEqual(len(blobs(front)), 6)
            view.press("one time back")
            self.assertEqual(view.text("output"), "t = 0 s")
            ten = blobs(view.seen())
            self.assertEqual(len(ten), 10)
            # In a row of five: 0.27 m apart, and as large as their radii in the same scale say.
            lower = sorted(ten, key=lambda one: one[1][1])[5:]
            lower.sort(key=lambda one: one[1][0])
            scale = numpy.diff([centre[0] for _, centre in lower]) / 0.27  # px/m
            numpy.testing.assert_allclose(scale, scale.mean(), rtol=0.01)
            for (area, _), radius in zip(lower, (SMALL, LARGE, SMALL, LARGE, SMALL)):
                self.assertAlmostEqual(area / (numpy.pi * (radius * scale.mean()) ** 2), 1, delta=0.1)

            view.press("nearer")
            nearer = sorted(blobs(view.seen()), key=lambda one: -one[0])
            self.assertAlmostEqual(nearer[0][0] / max(area for area, _ in ten), 1.25**2, delta=0.1)
            view.press("one time on")
            view.press("front")
            numpy.testing.assert_array_equal(view.seen(), front)

    def test_a_drag_turns_it_and_the_wheel_zooms_after_a_click(self):
        with chromium() as browser:
            look(browser, self.page, 1000)
            view = Picture(browser)
            for layer in ("surface", "wetted walls"):
                view.tick(layer)
            view.press("front")
            before = blobs(view.seen())
            ActionChains(browser).scroll_from_origin(self.origin(view), 0, 100).perform()
            numpy.testing.assert_allclose([area for area, _ in blobs(view.seen())], [area for area, _ in before])
            view.drag(45, 0)
            turned = blobs(view.seen())
            spread = [numpy.ptp([centre[0] for _, centre in found]) for found in (before, turned)]
            self.assertLess(spread[1], 0.95 * spread[0])  # about the vertical: narrower, at the same heights
            heights = [[edge(centre[1] for _, centre in found) for edge in (min, max)] for found in (before, turned)]
            numpy.testing.assert_allclose(*heights, atol=1)  # edges of the box cut some in two: the first and the last
            ActionChains(browser).scroll_from_origin(self.origin(view), 0, -200).perform()
            time.sleep(0.1)
            self.assertGreater(max(area for area, _ in blobs(view.seen())), 1.05 * max(area for area, _ in turned))

    @staticmethod
    def origin(view):
        from selenium.webdriver.common.actions.wheel_input import ScrollOrigin

        return ScrollOrigin.from_element(view.canvas)

    def test_dark_and_narrow(self):
        with chromium() as browser:
            browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                    {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
            self.assertEqual(look(browser, self.page, 400)[0], [])
            picture = Picture(browser).seen()
            self.assertLess(numpy.median(picture[:, :, :3]), 0.3)
            labels = browser.execute_script("""
                const stage = document.querySelector(".stage").getBoundingClientRect();
                return [...document.querySelectorAll(".stage .label:not([hidden])")].map(label => {
                    const box = label.getBoundingClientRect();
                    return [label.textContent, box.left >= stage.left && box.right <= stage.right &&
                                               box.top >= stage.top && box.bottom <= stage.bottom];
                });""")
            self.assertEqual(sorted(text for text, _ in labels), ["0", "0", "0", "0.5", "1", "1.18", "x [m]", "y [m]", "z [m]"])
            self.assertEqual([text for text, inside in labels if not inside], [])


if __name__ == "__main__":
    unittest.main()
