#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Clumps of two spheres that touch (LIGGGHTS's fix multisphere) through the real pair.

    settling in Stokes's range    as the sphere of their volume, (rho_p - rho) V g/(3 pi mu d), d = 2^(1/3) of the sphere's
    neutral, in a liquid at rest  stay
    on a light liquid's surface   half of their density: half under water, lying
    falling on the floor          books of momentum; continued halfway, the same

What a doublet really does in Stokes's range (Happel and Brenner, Low Reynolds Number Hydrodynamics, 1983): broadside each
sphere has 0.724 of its own drag, lengthwise 0.645."""
import math
import sys

from box_case import BoxCase, Cyclic, Open, Particle, Slip, SIDES, command_line, momentum_of_everything, particle_states, scratch
from record import Record

DIAMETER = 2e-3  # of each sphere, m
VOLUME = math.pi / 3 * DIAMETER**3
EQUAL = 2**(1 / 3) * DIAMETER  # diameter of the sphere of that volume


def script(case, density, places, step, dropped=(0, 0, 0)):
    """LIGGGHTS script of doublets along x at given places."""
    a, sphere = DIAMETER / 2, density * VOLUME / 2
    size = math.sqrt(sum(c * c for c in case.gravity))
    template = (f"fix pair all particletemplate/multisphere 15485863 atom_type 1 density constant {density} nspheres 2 "
                f"ntry 100000 spheres {-a} 0 0 {a} {a} 0 0 {a} type 1 mass {2 * sphere:.12g} inertia_tensor "
                f"{0.8 * sphere * a * a:.12g} 0 0 {2.8 * sphere * a * a:.12g} 0 {2.8 * sphere * a * a:.12g} use_density\n"
                "fix one all particledistribution/discrete 15485867 1 pair 1.0\n")
    insertion = ""
    for i, (x, y, z) in enumerate(places):
        small = 1e-3  # LIGGGHTS measures the region by chance
        insertion += (f"region place{i} block {x - small} {x + small} {y - small} {y + small} {z - small} {z + small} units box\n"
                      f"fix put{i} all insert/pack seed 32452843 distributiontemplate one vel constant {dropped[0]} {dropped[1]} "
                      f"{dropped[2]} insert_every once overlapcheck yes all_in no ntry_mc 1000000 region place{i} particles_in_region 1\nrun 1\n"
                      f"unfix put{i}\n")
    box = " ".join(f"{case.lower[i]} {case.upper[i]}" for i in range(3))
    return f"""units si
atom_style sphere
atom_modify map array sort 0 0
boundary {' '.join('p' if case.sides[axis + '-']['type'] == 'cyclic' else 'f' for axis in 'xyz')}
newton off
communicate single vel yes
variable continued index 0
if "${{continued}} == 1" then "read_restart ${{restart_file}}" else "region box block {box} units box" "create_box 1 box"
neighbor {0.4 * DIAMETER} bin
neigh_modify delay 0
fix kn all property/global kn peratomtypepair 1 200
fix kt all property/global kt peratomtypepair 1 57
fix gn all property/global gamman peratomtypepair 1 500
fix gt all property/global gammat peratomtypepair 1 250
fix mu all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model hooke/stiffness tangential history
pair_coeff * *
timestep {step}
{template}fix move all multisphere
include put_${{continued}}
fix gravity all gravity {size} vector {' '.join(str(c) for c in case.gravity)}
fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane {case.lower[2]}
""", insertion


def with_clumps(case, density, places, step, **options):
    text, insertion = script(case, density, places, step, **options)
    case.particles = [Particle(place, DIAMETER, density) for place in places]  # for the section of the case file
    case.extra_files = {"particles/in.particles": text, "particles/put_0": insertion, "particles/put_1": "# they come from the restart file\n"}
    return case


def settling(demvof, record):
    density, viscosity, edge = 2500, 1.0, 0.06

    def box(name):
        return BoxCase(scratch(f"clumps/{name}"), (edge, edge, 2 * edge), (12, 12, 24), (6, 6, 12), 0.1, 2e-3, dem_step=1e-5,
                       liquid=(1000, viscosity / 1000), history_interval=2e-3,
                       forces=[{"drag": "schiller_naumann"}, "pressure_gradient", {"own_wake": "oseen"}])

    doublet = with_clumps(box("settling"), density, [(edge / 2, edge / 2, 1.5 * edge)], 1e-5).run(demvof)
    begin = particle_states(doublet.folder, 0)["position"].mean(axis=0)
    sphere = box("sphere")
    sphere.particles = [Particle(tuple(begin), EQUAL, density)]
    speeds = [-particle_states(folder)["velocity"][:, 2].mean() for folder in (doublet.folder, sphere.run(demvof).folder)]
    free = (density - 1000) * VOLUME * 9.81 / (3 * math.pi * viscosity * EQUAL)
    record.at_most("settling: speed against that of the sphere of its volume in the same box, off", abs(speeds[0] / speeds[1] - 1), 1e-3)
    record.note("settling: the sphere's, over Stokes's without walls", speeds[1] / free)
    record.note("settling: what a doublet has, broadside, over the sphere of its volume", 2**(1 / 3) / (2 * 0.724))
    record.note("settling: lengthwise", 2**(1 / 3) / (2 * 0.645))
    record.at_most("settling: particles' volume on the mesh", doublet.results["conservation"]["solid_volume"], 4.9e-13)


def neutral(demvof, record):
    case = BoxCase(scratch("clumps/neutral"), (0.02, 0.02, 0.04), (8, 8, 16), (4, 4, 8), 0.05, 1e-3, dem_step=1e-5,
                   history_interval=1e-3, tolerance=1e-12)
    run = with_clumps(case, 1000, [(0.01, 0.01, 0.02), (0.01, 0.005, 0.03)], 1e-5).run(demvof)
    speed = math.hypot(*particle_states(run.folder)["velocity"].max(axis=0))
    record.at_most("neutral: speed that they came to, over that of a fall of the same time", speed / (9.81 * 0.05), 8e-16)


def floating(demvof, record):
    level = 0.02
    case = BoxCase(scratch("clumps/floating"), (0.02, 0.02, 0.04), (20, 20, 40), (5, 5, 10), 0.3, 1e-3, level=level, dem_step=1e-5,
                   liquid=(1000, 1e-5), history_interval=1e-2, output_interval=0.3)
    case.sides = {side: Open() if side == "z+" else Slip() for side in SIDES}
    run = with_clumps(case, 500, [(0.0099, 0.0101, level)], 1e-5).run(demvof)
    heights = particle_states(run.folder)["position"][:, 2]
    under = level + VOLUME / 2 / 0.02**2  # displaced: the level has risen
    record.at_most("floating: centres over the surface, over the diameter", abs(heights - under).max() / DIAMETER, 4.5e-3)


def falling(demvof, record):
    def case(name, end):
        box = BoxCase(scratch(f"clumps/{name}"), (0.02, 0.02, 0.04), (8, 8, 16), (4, 4, 8), end, 1e-3, dem_step=1e-5, history_interval=1e-3,
                      output_interval=0.05)
        return with_clumps(box, 2500, [(0.008, 0.01, 0.005), (0.012, 0.0105, 0.011)], 1e-5, dropped=(0.02, 0, -0.1))
    whole = case("falling", 0.1).run(demvof)
    record.at_most("falling: momentum exchange", whole.results["conservation"]["exchange"], 8e-14)
    record.at_most("falling: lost", whole.results["particles"]["lost"], 0)
    counts = [whole.results["particles"][when] for when in ("initial", "final")]
    record.at_most("falling: particles counted at the start and the end, less two clumps", max(abs(n - 2) for n in counts), 0)
    half = case("continued", 0.05)
    half.run(demvof)
    text = (half.folder / "case.yaml").read_text()
    (half.folder / "case.yaml").write_text(text.replace('"end_time": 0.05', '"end_time": 0.1'))
    import subprocess
    subprocess.run([demvof, "run", str(half.folder / "case.yaml"), "--out", str(half.folder / "run"), "--continue"], check=True,
                   stdout=subprocess.DEVNULL)
    one, other = particle_states(whole.folder), particle_states(half.folder / "run")
    record.at_most("falling: continued halfway, places differ by", abs(one["position"] - other["position"]).max(), 1e-12, "m")


def main():
    record = Record("clumps", "Clumps", "Two spheres that touch, as one body (LIGGGHTS's fix multisphere): volume, buoyancy and drag of the "
                    "whole once. Settling against the sphere of its volume, at rest when neutral, floating half under water, falling on "
                    "the floor with closed books and continued.", "tests/Alltest -- -R pair.clumps")
    demvof = command_line().demvof
    for part in (settling, neutral, floating, falling):
        part(demvof, record)
    momentum_of_everything(record, 6e-12)
    sys.exit(record.write())


if __name__ == "__main__":
    main()
