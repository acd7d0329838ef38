#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The check.py of each case, on runs made here: inside every bound, and outside each one in turn."""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
MASS = 2500 * math.pi / 6 * 2.7e-3**3  # of a bead, kg


def results(**changes):
    good = {"status": "completed", "particles": {"initial": 3883, "lost": 0}, "cells": {"fine_max": 48000},
            "steps": {"fluid": 500}, "configuration": {"bulk_grid": {"lower": [0, 0, 0], "upper": [1, 1, 0.3456],
                                                                    "cells": [1, 1, 16]}},
            "conservation": {"exchange": 1e-14, "momentum": 0, "solid_volume": 1e-14, "liquid_volume": 1e-14}}
    for path, value in changes.items():
        place, _, key = path.rpartition("__")
        (good[place] if place else good)[key] = value
    return good


def history(**columns):
    """The text of history.csv, times 0, 0.1, 0.2, ... unless given."""
    length = max(len(column) for column in columns.values())
    columns = {"time": [0.1 * n for n in range(length)], **columns}
    rows = [",".join(map(str, row)) for row in zip(*columns.values())]
    return "\n".join([",".join(columns), "# " + ",".join("-" for _ in columns), *rows]) + "\n"


def frames(states):
    """Texts of a series of particle files; states: time -> (positions, radii, velocities), m, m, m/s."""
    def array(name, kind, values, components=1):
        text = " ".join(" ".join(map(repr, row)) if components > 1 else repr(row) for row in values)
        return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">{text}</DataArray>'

    files, index = {}, ""
    for number, (time, (positions, radii, velocities)) in enumerate(states.items()):
        name = f"particles_{number:06d}.vtp"
        index += f'<DataSet timestep="{time!r}" file="{name}"/>'
        files["particles/" + name] = (
            '<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>'
            f'<Piece NumberOfPoints="{len(radii)}"><PointData>{array("id", "Int64", range(1, len(radii) + 1))}'
            f'{array("radius", "Float64", radii)}{array("velocity", "Float64", velocities, 3)}'
            f'{array("spin", "Float64", [(0.0, 0.0, 0.0)] * len(radii), 3)}</PointData>'
            f'<Points>{array("position", "Float64", positions, 3)}</Points></Piece></PolyData></VTKFile>')
    files["particles/particles.pvd"] = f'<VTKFile type="Collection"><Collection>{index}</Collection></VTKFile>'
    return files


def one_cell(lower, upper, values):
    """Texts of an OpenFOAM case with one cell, a box; values: time -> field -> (kind, uniform value)."""
    def foam(kind, name, text):
        return f"FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n{text}\n"

    corners = [(x, y, z) for z in (lower[2], upper[2]) for y in (lower[1], upper[1]) for x in (lower[0], upper[0])]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    mesh = {"points": ("vectorField", "8(" + " ".join("({} {} {})".format(*point) for point in corners) + ")"),
            "faces": ("faceList", "6(" + " ".join("4({} {} {} {})".format(*face) for face in faces) + ")"),
            "owner": ("labelList", "6(0 0 0 0 0 0)"), "neighbour": ("labelList", "0()"),
            "boundary": ("polyBoundaryMesh", "1(wall { type wall; nFaces 6; startFace 0; })")}
    files = {f"fluid/constant/polyMesh/{name}": foam(kind, name, text) for name, (kind, text) in mesh.items()}
    files["fluid/system/controlDict"] = foam("dictionary", "controlDict", f"startTime 0; endTime {max(values)}; deltaT 1; "
                                             "writeControl timeStep; writeInterval 1;")
    for time, fields in values.items():
        for name, (kind, value) in fields.items():
            files[f"fluid/{time:g}/{name}"] = foam(kind, name, f"dimensions [0 0 0 0 0 0 0];\ninternalField uniform {value};\n"
                                                   "boundaryField { wall { type calculated; } }")
    return files


class CaseChecks(unittest.TestCase):
    def verdict(self, case, facts, table, files):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        for name, text in {"results.json": json.dumps(facts), "history.csv": table, **files}.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)
        done = subprocess.run([sys.executable, CASES / case / "check.py", folder], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def expect(self, case, facts, table, refused, files=None):
        """refused: a word of the one line that must say NOT; empty: none may. files: name in the run's folder -> text."""
        code, printed = self.verdict(case, facts, table, files or {})
        lines = [line for line in printed.splitlines() if line.startswith("NOT")]
        self.assertEqual((code, len(lines)), (1, 1) if refused else (0, 0), printed)
        self.assertTrue(not refused or refused in lines[0], printed)

    def test_dam_break_with_beads(self):
        def table(energy=(0.25, 0.2502, 0.2), speed=(0, 6.1, 2)):  # 1.5 times the clear-water peak is 6.15 m/s
            return history(mechanical_energy=energy, max_speed=speed, max_speed_x=(0, 0, 0), max_speed_y=(0, 0, 0),
                           max_speed_z=(0, 0, 0))

        case = "three_phase_dam_break"
        self.expect(case, results(), table(), "")
        self.expect(case, results(status="interrupted"), table(), "status")
        self.expect(case, results(particles__lost=1), table(), "lost")
        self.expect(case, results(conservation__exchange=1e-11), table(), "exchange")
        self.expect(case, results(conservation__solid_volume=1e-11), table(), "solid volume")
        self.expect(case, results(conservation__liquid_volume=1e-4), table(), "liquid volume")
        self.expect(case, results(conservation__exchange=None), table(), "exchange")
        self.expect(case, results(), table(energy=(0.25, 0.2504, 0.2)), "energy")
        self.expect(case, results(), table(speed=(0, 6.2, 2)), "speed")

    def test_dam_break_without_beads_follows_the_measured_front(self):
        measured = [tuple(map(float, line.split(","))) for line in
                    (CASES / "three_phase_dam_break" / "reference" / "martin_moyce_1952_n2_front.csv").read_text().splitlines()
                    if line[0].isdigit()]
        scale = math.sqrt(0.05 / (2 * 9.81))  # s per unit of T
        clear = results(particles__initial=0)

        def table(stretch, shift):
            rows = [(0, 0.05)] + [((t + shift) * scale, 0.05 * z * stretch) for t, z in measured]
            text = "time,liquid_front,max_speed,max_speed_x,max_speed_y,max_speed_z\n# -,-,-,-,-,-\n"
            return text + "".join(f"{t},{x},1,0,0,0\n" for t, x in rows)

        self.expect("three_phase_dam_break", clear, table(1.0, -0.15), "")
        self.expect("three_phase_dam_break", clear, table(0.5, 0.0), "front")
        self.expect("three_phase_dam_break", clear, table(1.0, -0.15).rsplit("\n", 6)[0] + "\n", "front")  # too short

    def test_settling_particle(self):
        def table(speed):
            return history(particle_kinetic_energy=[0.5 * MASS * v * v for v in (0, 0.2, 0.3, speed, speed, speed)])

        self.expect("settling_particle", results(), table(0.3430), "")
        self.expect("settling_particle", results(), table(0.3460), "")
        self.expect("settling_particle", results(), table(0.3470), "terminal")
        self.expect("settling_particle", results(), table(0.3390), "terminal")

    def test_hydrostatic_bed(self):
        self.expect("hydrostatic_bed", results(), history(max_speed=(0, 9e-7)), "")
        self.expect("hydrostatic_bed", results(), history(max_speed=(0, 2e-6, 0)), "speed")
        self.expect("hydrostatic_bed", results(steps__fluid=99), history(max_speed=(0, 0)), "steps")

    def test_single_particle_impact(self):
        mass, rise = 2000 * math.pi / 6 * 4e-3**3, math.pi / 6 * 4e-3**3 / 0.05**2

        def run(time_scale=1.0, speed_scale=1.0, level_scale=1.0):
            """A free fall, slowed by about as much as air does, which ends under water."""
            times = [0.001 * n * 1.004 * time_scale for n in range(140)]
            heights = [0.14 - 0.5 * 9.81 * (0.001 * n) ** 2 for n in range(140)]
            speeds = [9.81 * 0.001 * n * 0.994 * speed_scale for n in range(140)]
            return history(time=times, particle_potential_energy=[mass * 9.81 * z for z in heights],
                           particle_kinetic_energy=[0.5 * mass * v * v for v in speeds],
                           mean_level=[0.051] * 139 + [0.051 + level_scale * rise])

        case, falling = "single_particle_impact", {"particles": {"script": "particles/in.falling"}}
        good = results(configuration=falling)
        self.expect(case, good, run(), "")
        self.expect(case, good, run(speed_scale=0.98), "speed")
        self.expect(case, good, run(level_scale=0.98), "level")
        self.expect(case, results(configuration=falling, conservation__exchange=1e-11), run(), "exchange")
        self.expect(case, results(configuration=falling, conservation__momentum=1e-11), run(), "momentum")
        self.expect(case, results(configuration=falling, conservation__liquid_volume=1e-8), run(), "liquid volume")
        code, printed = self.verdict(case, good, run(time_scale=1.01), {})
        self.assertEqual((code, printed.count("NOT")), (1, 2), printed)  # late at both heights

        injected = {"particles": {"script": "particles/in.injected"}, "coupling": {"phase_interchange": "replacement"}}
        books = {"became_liquid": 1, "volume_error": 1e-15}
        self.expect(case, results(configuration=injected, replacement=books), run(), "")
        self.expect(case, results(configuration=injected, replacement={**books, "became_liquid": 0}), run(), "became")
        self.expect(case, results(configuration=injected, replacement={**books, "volume_error": 1e-9}), run(), "change")

    def test_particle_injection(self):
        def table(level, end=1.6):
            return history(time=[0, end], mean_level=[0.3, level])

        case = "particle_injection"
        injection = {"configuration": {"particles": {"script": "particles/in.injection"}}}
        facts = results(particles={"lost": 0, "final": 1500}, **injection)
        self.expect(case, facts, table(0.30982), "")
        self.expect(case, facts, table(0.30995), "level")
        self.expect(case, facts, table(0.30970), "level")
        self.expect(case, results(particles={"lost": 0, "final": 1400}, **injection), table(0.30916), "beads in the end")
        self.expect(case, results(particles={"lost": 0, "final": 300}, **injection), table(0.301963, end=0.2), "")
        self.expect(case, results(particles={"lost": 1, "final": 1500}, **injection), table(0.30982), "lost")
        self.expect(case, results(particles={"lost": 0, "final": 1500}, conservation__exchange=1e-11, **injection),
                    table(0.30982), "exchange")
        self.expect(case, results(particles={"lost": 0, "final": 1500}, conservation__liquid_volume=1e-4, **injection),
                    table(0.30982), "liquid volume")
        column = {"configuration": {"particles": {"script": "particles/in.column"}}}
        self.expect(case, results(particles={"lost": 0, "final": 3000}, **column), table(0.31005), "")
        self.expect(case, results(particles={"lost": 0, "final": 3000}, **column), table(0.30982), "level")

    def test_liquid_fluidised_bed(self):
        weight, solid = 640 * 1500 * math.pi / 6 * 2e-3**3 * 9.81, 640 * math.pi / 6 * 2e-3**3 / 0.0176**2

        def table(*eps):  # 80, 65, 50 and 35 mm/s
            return history(time=[2.5, 5.5, 8.5, 11.5],
                           particle_potential_energy=[weight * (0.0088 + 0.5 * solid / (1 - e)) for e in eps])

        case, law = "liquid_fluidised_bed", (0.8462, 0.7794, 0.7020, 0.6089)
        self.expect(case, results(), table(*law), "")
        self.expect(case, results(conservation__exchange=1e-11), table(*law), "exchange")
        for place, velocity in enumerate((80, 65, 50, 35)):
            for factor in (0.96, 1.04):
                wrong = [e * (factor if at == place else 1) for at, e in enumerate(law)]
                self.expect(case, results(), table(*wrong), f"{velocity} mm/s")

    def test_floating_beads_dam_break(self):
        volume, floor, liquid = math.pi / 6 * 8e-3**3, 0.256 * 0.016, 0.096 * 0.016 * 0.064
        ratios = [(300, 600, 900)[n % 3] / 1221 for n in range(16)]

        def depth(ratio):
            """Root in [0, 1] of 2 x^3 - 3 x^2 + ratio: with x = 1/2 + sin(a), sin(3 a) = 2 ratio - 1."""
            return 0.5 + math.sin(math.asin(2 * ratio - 1) / 3)

        level = (liquid + volume * sum(ratios)) / floor

        def at_rest(off=0.0, speed=0.0):
            positions = [(0.01, 0.008, level + (0.5 - depth(ratio) - (off if n == 4 else 0)) * 8e-3)
                         for n, ratio in enumerate(ratios)]
            return frames({6.0: (positions, [4e-3] * 16, [(0.0, 0.0, speed)] * 16)})

        def table(energy=(1, 1.0005, 0.5)):
            return history(time=[0, 1, 6], mechanical_energy=energy, liquid_volume=[liquid] * 3)

        case, good = "floating_beads_dam_break", results(particles={"lost": 0, "final": 16})
        self.expect(case, good, table(), "", at_rest())
        self.expect(case, good, table(), "600", at_rest(off=0.05))
        self.expect(case, good, table(), "600", at_rest(off=-0.05))
        self.expect(case, good, table(), "fastest", at_rest(speed=0.02))
        self.expect(case, good, table((1, 1.002, 0.5)), "energy", at_rest())
        self.expect(case, results(particles={"lost": 1, "final": 16}), table(), "lost", at_rest())

    def test_hopper_into_water(self):
        volume, big, small = math.pi / 6 * 4e-3**3, 600, 1.0
        # 600 beads evenly between 0 and 40 mm over the hopper's floor: what lies over each millimetre is known.
        filled = [(0.01, 0.008, 0.36 + 0.04 * (n + 0.5) / big) for n in range(big)]
        bulk = 2500 * big * volume / 0.04 / (0.096 * 0.016)
        law = 1.03 * bulk * math.sqrt(9.81) * 0.016 * (0.02 - 1.4 * 4e-3) ** 1.5
        rate = law / (2500 * volume)  # beads per second
        terminal = 0.2674

        def run(flow=1.0, speed=1.0):
            def state(fallen, sinking=0.0):
                height = [(0.01, 0.008, 0.1)] * fallen + filled[fallen:] + [(0.012, 0.008, 0.02)]
                return height, [2e-3] * big + [1e-3], [(0.0, 0.0, 0.0)] * big + [(0.0, 0.0, -sinking)]

            return frames({0.0: state(0), 0.1: state(10), 0.2: state(10, speed * terminal),
                           0.3: state(10 + round(0.2 * rate * flow)), 1.2: state(500)})

        def table(error=0.0):
            level = 0.16 + (500 * volume + math.pi / 6 * 2e-3**3) / (0.096 * 0.016)
            return history(time=[0, 1.2], mean_level=[0.16, level + error])

        case = "hopper_into_water"
        self.expect(case, results(), table(), "", run())
        self.expect(case, results(), table(), "mass flow", run(flow=0.65))
        self.expect(case, results(), table(), "mass flow", run(flow=1.35))
        self.expect(case, results(), table(), "terminal", run(speed=0.95))
        self.expect(case, results(), table(error=-1.2e-3), "level", run())

    def test_gas_slurry_column(self):
        beads, area, liquid = 700 * math.pi / 6 * 4e-3**3, 0.096 * 0.016, 2.7e-4
        air = 0.384 * area - liquid - beads
        contact = 0.03  # N, and 0.002 N of rate of momentum
        pressure = (9.81 * (1000 * liquid + 1200 * beads + 1.2 * air) - contact + 0.002) / area - 1.2 * 9.81 * 0.384

        def tables(factor):
            times = [0.01 * n for n in range(401)]
            return {f"fluid/postProcessing/{name}/0/values.dat":
                    "".join(f"{t:g} " + " ".join(f"{value:.9g}" for value in values) + "\n" for t in times)
                    for name, values in (("floor", [factor * pressure]), ("sparger", [factor * pressure]),
                                         ("taps", [1300.0, 600.0]))}

        case, table = "gas_slurry_column", history(
            time=[0, 2, 4], liquid_volume=[liquid] * 3, fluid_momentum_z=[0, 0.003, 0.005],
            particle_momentum_z=[0, 0, 0.002], pending_momentum_z=[0, 0, 0.001])
        books = {"momentum": {"impulses": {"contacts": [0, 0, 4 * contact]}}}
        self.expect(case, results(**books), table, "", tables(1.0))
        self.expect(case, results(**books), table, "force of floor", tables(0.985))
        self.expect(case, results(**books), table, "force of floor", tables(1.015))
        self.expect(case, results(**books, conservation__liquid_volume=1e-4), table, "liquid volume", tables(1.0))

    def test_rotating_drum(self):
        lower, upper, bead, mass = (0.001, -0.01, 0), (0.003, 0.01, 0.02), 0.03, 2500 * math.pi / 6 * 4e-3**3
        water = 0.9 * 1000 * 0.002 * 0.02 * 0.02  # kg; its centre is at x = 2 mm
        weight, shear, speed = -9.81 * (water * 0.002 + mass * bead), -1e-6, 0.04
        times = (0.1, 0.25, 0.4, 1.0, 2.0, 3.0)

        def run(rest=1.0, turning=1.0, faster=0.0):
            """The wall's torque over what it has to be; faster: what water and bead have gained by the end, m/s along y."""
            stored = faster * (water * 0.002 + mass * bead) / 2  # N m
            log = "    Step    Atoms         torque          omega\n"
            moment = "# Time (total) (pressure) (viscous)\n"
            for n in range(1, 151):
                contact = (rest if n <= 20 else turning) * (weight - shear - (stored if n > 50 else 0))
                log += f"  {400 * n} 1000 {contact!r} 1\nLoop time of 1 on 1 procs for 40 steps with 1000 atoms\n"
                moment += f"{0.02 * n:g} (0 0 {shear}) (0 0 0) (0 0 {shear})\n"
            velocity = {time: (0.0, speed + (faster if time == 3 else 0), 0.0) for time in times}
            fields = {time: {"alpha.water": ("volScalarField", 1), "voidFraction": ("volScalarField", 0.9),
                             "U": ("volVectorField", "({} {} {})".format(*velocity[time]))} for time in times}
            states = {time: ([(bead, -0.02, 0.01)], [2e-3], [velocity[time]]) for time in times}
            return {"particles.log": log, "fluid/postProcessing/drum/0/moment.dat": moment,
                    **one_cell(lower, upper, fields), **frames(states)}

        case, table = "rotating_drum", history(time=[0, 3])
        self.expect(case, results(), table, "", run())
        self.expect(case, results(), table, "", run(faster=0.02))
        self.expect(case, results(), table, "turning", run(turning=1.03))
        self.expect(case, results(), table, "turning", run(turning=0.97))
        self.expect(case, results(), table, "at rest", run(rest=1.03))
        self.expect(case, results(particles__lost=1), table, "lost", run())
        self.expect(case, results(conservation__exchange=1e-11), table, "exchange", run())

    def test_no_run_is_no_verdict(self):
        done = subprocess.run([sys.executable, CASES / "hydrostatic_bed" / "check.py", "/nowhere"], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main()
