#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the report's 3D view shows and how it is thinned and packed, against geometry that is known; how it looks:
tests/browser/view_test.py. Runs are those of tests/support/made_run.py: a box of 1 x 0.5 x 1 m, water below z = 0.5 m."""
import base64
import dataclasses
import pathlib
import shutil
import sys
import tempfile
import unittest

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "coupler" / "cli"), str(ROOT / "tests" / "support")]

from made_run import write_run  # noqa: E402
from reporting import page, space, view  # noqa: E402
from reporting.run import Run  # noqa: E402


def area(part):
    a, b, c = (part[0][part[1][:, i]].astype(float) for i in range(3))
    return 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum()


def length(part):
    a, b = (part[0][part[1][:, i]].astype(float) for i in range(2))
    return numpy.linalg.norm(b - a, axis=1).sum()


def sphere(triangles):
    """About so many triangles on a sphere with radius 1, of VTK."""
    from vtkmodules.vtkFiltersSources import vtkSphereSource

    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(round((triangles / 2) ** 0.5))
    source.SetPhiResolution(round((triangles / 2) ** 0.5))
    source.Update()
    return source.GetOutput()


def numbers(text, kind):
    return numpy.frombuffer(base64.b64decode(text), kind)


class Views(unittest.TestCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.place)

    def test_surface_walls_edges_and_particles_are_where_they_are(self):
        found = space.read(write_run(self.place / "a"), 0.1, 1000, 1000)
        numpy.testing.assert_allclose(found.surface[0][:, 2], 0.5, atol=1e-6)
        self.assertAlmostEqual(area(found.surface), 0.5, places=6)
        self.assertEqual(found.surface_triangles, len(found.surface[1]))
        self.assertAlmostEqual(area(found.wetted), 0.5 + 2 * 0.5 + 2 * 0.25, places=6)  # floor and four walls
        self.assertLessEqual(found.wetted[0][:, 2].max(), 0.5 + 1e-6)
        self.assertAlmostEqual(length(found.edges), 4 * (1 + 0.5 + 1), places=6)
        self.assertEqual(found.vertical, (2, 1))
        numpy.testing.assert_allclose(found.positions, [[0.25, 0.26, 0.125], [0.75, 0.4, 0.5]])
        numpy.testing.assert_allclose(found.radii, [0.02, 0.03])
        numpy.testing.assert_allclose(found.speeds, [5, 0.1])

    def test_surfaces_of_the_script_are_shown_as_far_as_the_box(self):
        folder = write_run(self.place / "a")
        self.assertEqual(len(space.read(folder, 0.1, 1000, 1000).walls[1]), 0)
        (folder / "surfaces").mkdir()
        corners = "-10 -10 0.25 10 -10 0.25 10 10 0.25 -10 -10 0.25 10 10 0.25 -10 10 0.25"  # a floor of 20 x 20 m
        array = '<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="ascii">{}</DataArray>'
        (folder / "surfaces" / "surfaces_000000.vtp").write_text(
            '<VTKFile type="PolyData" version="0.1"><PolyData><Piece NumberOfPoints="6" NumberOfVerts="0" NumberOfLines="0" '
            'NumberOfStrips="0" NumberOfPolys="2"><Points>' + array.format("Float64", "Points", 3, corners)
            + "</Points><Polys>" + array.format("Int64", "connectivity", 1, "0 1 2 3 4 5")
            + array.format("Int64", "offsets", 1, "3 6") + "</Polys></Piece></PolyData></VTKFile>")
        (folder / "surfaces" / "surfaces.pvd").write_text(
            '<VTKFile type="Collection" version="0.1"><Collection>' + "".join(
                f'<DataSet timestep="{time}" file="surfaces_000000.vtp"/>' for time in (0, 0.1, 0.2)) + "</Collection></VTKFile>")
        spaces = {time: space.read(folder, time, 1000, 1000) for time in (0.1, 0.2)}
        self.assertAlmostEqual(area(spaces[0.1].walls), (1 + 0.1) * (0.5 + 0.1), places=6)
        data = view.encoded(spaces)
        self.assertEqual(len(data["shapes"]), 2)  # edges and walls of both times
        numpy.testing.assert_allclose([data["lower"], data["upper"]], [[-0.05, -0.05, 0], [1.05, 0.55, 1]], atol=1e-6)

    def test_one_fluid_has_no_surface_and_wets_no_walls(self):
        folder = write_run(self.place / "a")
        for field in folder.glob("fluid/*/alpha.water"):
            field.write_text(field.read_text().replace("\n0.0", "\n1.0"))
        shutil.rmtree(folder / "particles")
        found = space.read(folder, 0.1, 1000, 1000)
        self.assertEqual([len(part[1]) for part in (found.surface, found.wetted)], [0, 0])
        self.assertEqual(found.particles, 0)
        self.assertEqual(view.note(found), "No surface and no particles at this time.")
        self.assertIn('class="view"', view.html(Run(folder), 1))

    def test_the_surface_has_no_gap_between_ranks(self):
        from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
        from vtkmodules.vtkCommonDataModel import VTK_VOXEL, vtkUnstructuredGrid

        ranks = []
        for x in (0, 1):  # a cube each, side by side, water in the first
            points, liquid = vtkPoints(), vtkDoubleArray()
            for corner in range(8):
                points.InsertNextPoint(x + (corner & 1), corner >> 1 & 1, corner >> 2)
            ranks.append(vtkUnstructuredGrid())
            ranks[-1].SetPoints(points)
            ranks[-1].InsertNextCell(VTK_VOXEL, 8, range(8))
            liquid.SetName("alpha.water")
            liquid.InsertNextValue(1 - x)
            ranks[-1].GetCellData().AddArray(liquid)
        mesh, liquid = space.whole(ranks, "alpha.water")
        self.assertEqual(mesh.GetNumberOfPoints(), 12)
        surface = space.arrays(space.contour(mesh, liquid))
        self.assertAlmostEqual(area(surface), 1)
        numpy.testing.assert_allclose(surface[0][:, 0], 1)

    def test_a_thinned_surface_keeps_its_shape(self):
        most = 2000
        points, triangles = space.arrays(space.decimated(sphere(20000), most))
        self.assertLessEqual(len(triangles), most)
        self.assertGreater(len(triangles), 0.9 * most)
        radii = numpy.linalg.norm(points, axis=1)
        self.assertLess(abs(radii - 1).max(), 0.006)  # measured: 0.002
        self.assertLess(abs(area((points, triangles)) / (4 * numpy.pi) - 1), 0.003)  # measured: 0.0011

    def test_thinned_particles_are_the_same_at_every_time_and_from_everywhere(self):
        count, most = 500000, 20000
        ids = numpy.arange(1, count + 1)

        def found(order):  # at x is id, so that it can be recognised
            return {"id": ids[order], "position": numpy.stack([ids[order], 0 * ids, 0 * ids], 1).astype(float),
                    "radius": 1e-6 * ids[order], "velocity": numpy.zeros((count, 3))}

        chosen = []
        for order in (slice(None), numpy.random.default_rng(1).permutation(count)):
            positions, radii, _, all_of_them = space.thinned(found(order), most)
            self.assertEqual((len(positions), all_of_them), (most, count))
            numpy.testing.assert_allclose(radii, 1e-6 * positions[:, 0])
            chosen.append(set(positions[:, 0]))
        self.assertEqual(*chosen)
        # No pattern of a lattice: each place in a row gets its share but for chance, 4 sigma.
        for row in (50, 89, 610, 1000):
            places = numpy.bincount(numpy.fromiter(chosen[0], int) % row, minlength=row)
            self.assertLess(abs(places / (most / row) - 1).max(), 4 * (row / most) ** 0.5)

    def test_what_is_packed_reads_back(self):
        spaces = {time: space.read(write_run(self.place / f"a{time}"), time, 1000, 1000) for time in (0.1, 0.2)}
        data = view.encoded(spaces)
        self.assertEqual((data["lower"], data["upper"], data["largest"], data["fastest"]), ([0, 0, 0], [1, 0.5, 1], 0.03, 5))
        packed = data["times"][1]["particles"]
        numpy.testing.assert_allclose(numbers(packed["positions"], "<u2").reshape(-1, 3) / 65535, spaces[0.2].positions,
                                      atol=0.51 / 65535)
        numpy.testing.assert_allclose(0.03 * numbers(packed["radii"], "<u2") / 65535, [0.02, 0.03], atol=0.03 / 65535)
        numpy.testing.assert_array_equal(numbers(packed["speeds"], "u1"), [255, round(255 * 0.2 / 5)])
        surface = data["times"][1]["surface"]
        points, cells = numbers(surface["points"], "<u2").reshape(-1, 3) / 65535, numbers(surface["cells"], "<u2")
        self.assertAlmostEqual(area((points, cells.reshape(-1, 3).astype(int))), 0.5, places=4)

    def test_the_page_is_bounded(self):
        surface = space.arrays(space.decimated(sphere(60000), view.TRIANGLES))
        wall = space.arrays(space.decimated(sphere(60000), space.WALLS))
        random = numpy.random.default_rng(1)
        full = space.Space(-numpy.ones(3), numpy.ones(3), (2, 1), surface, 60000, surface,
                           (numpy.zeros((0, 3)), numpy.zeros((0, 2), int)), wall, random.uniform(-1, 1, (view.PARTICLES, 3)),
                           numpy.full(view.PARTICLES, 0.01), random.uniform(0, 1, view.PARTICLES), 500000)
        spaces = {0.1 * i: dataclasses.replace(full) for i in range(view.ALL_PARTICLES // view.PARTICLES)}
        for i, here in spaces.items():  # that move: each time its own
            here.walls = (wall[0] * (1 - 0.1 * i), wall[1])
        self.assertLess(len(view.figure(spaces)) + len(view.scripts()), 6e6)
        self.assertIn("500000 particles, thinned to 20000", view.note(full))

    def test_without_the_library_the_rest_of_the_report_stays(self):
        run = Run(write_run(self.place / "a"))
        installed, view.LIBRARY = view.LIBRARY, self.place / "nowhere"
        try:
            text = page.html([run])
        finally:
            view.LIBRARY = installed
        self.assertIn("Not shown: three.js is not installed (Debian: libjs-three).", text)
        self.assertNotIn('class="view"', text)
        self.assertIn('alt="surface at 0.2 s"', text)


if __name__ == "__main__":
    unittest.main()
