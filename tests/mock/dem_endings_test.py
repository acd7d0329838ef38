#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What dem_side says, and with which exit codes both sides end, when a script or a run goes wrong.

Usage: dem_endings_test.py MPIRUN DEMVOF_PAIR DEM_SIDE MOCK_FLUID FOLDER
"""
import json
import pathlib
import shutil
import subprocess
import sys

mpirun, pair, dem_side, mock_fluid = sys.argv[1:5]
folder = pathlib.Path(sys.argv[5])
shutil.rmtree(folder, ignore_errors=True)
shutil.copytree(pathlib.Path(__file__).parent / "beads", folder)
case = (folder / "settling.yaml").read_text().replace("end_time: 0.6", "end_time: 0.02")
script = (folder / "in.settling").read_text()
points = ("units si\natom_style atomic\nregion box block 0 0.1 0 0.1 0 0.4 units box\ncreate_box 1 box\n"
          "mass 1 1.0\ncreate_atoms 1 single 0.05 0.05 0.3\ntimestep 1e-4\nfix integrate all nve\n")


def run(name, case_text, script_text, *options):
    (folder / "case.yaml").write_text(case_text)
    (folder / "in.settling").write_text(script_text)
    out = folder / name
    command = [mpirun, "--timeout", "60", "-np", "2", pair,
               "-np", "1", dem_side, str(folder / "case.yaml"), "--out", str(out), "+",
               "-np", "1", mock_fluid, str(folder / "case.yaml"), *options]
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr, out


# name: (case, script, options of mock_fluid, exit code, words of the message)
endings = {
    "units": (case, script.replace("include box", "include box_lj"), [], 2, ["units are 'lj'", "units si"]),
    "points": (case, points, [], 2, ["atom_style is 'atomic'", "atom_style granular"]),
    "no_time_step": (case, script.replace("timestep 1e-4", ""), [], 2, ["no timestep", "timestep 1e-5"]),
    "no_integrator": (case, script.replace("fix integrate all nve/sphere", ""), [], 2,
                      ["nothing moves the particles", "nve/sphere"]),
    "wrong_integrator": (case, script.replace("nve/sphere", "nve/limit radius_ratio 0.1"), [], 2,
                         ["fix integrate nve/limit", "nothing moves the particles"]),
    "two_gravities": (case, script + "fix moon all gravity 1.6 vector 0 0 -1\n", [], 2,
                      ["2 fixes of style gravity", "at most one"]),
    "buoyancy": (case, script + "fix lift all buoyancy level 0.3 dim z density 1000\n", [], 2,
                 ["fix lift buoyancy", "pressure gradient"]),
    "force_taken_away": (case, script + "fix hold all setforce 0 0 0\n", [], 2, ["fix hold setforce", "fix freeze"]),
    "steps_that_change": (case, script + "fix clock all dt/reset 1 1e-6 1e-4 1e-5\n", [], 2,
                          ["fix clock dt/reset", "run away from the fluid's"]),
    "no_diameter": (case, script + "create_atoms 1 single 0.05 0.05 0.1 units box\n", [], 2,
                    ["diameter of 1 m", "set ... diameter"]),
    "no_box": (case, "units si\natom_style granular\n", [], 2, ["no simulation box"]),
    "window_between": (case.replace("window: 1.0e-3", "window: 1.25e-3"), script, [], 2,
                       ["0.00125 s is not a whole number of DEM steps of 0.0001 s", "0.0012 or 0.0013"]),
    "outside": (case.replace("upper: [0.1, 0.1, 0.4]", "upper: [0.1, 0.1, 0.3]"), script, [], 2,
                ["bulk_grid: from 0 to 0.3 m along z", "0.35"]),
    "periodic": (case.replace("lower: [0, 0, 0]", "lower: [-0.01, 0, 0]"),
                 script.replace("include box", "include box_periodic"), [], 2,
                 ["along x", "periodic", "from 0 to 0.1 m"]),
    "gravity": (case, script, ["--gravity", "1.62"], 2, ["gravity", "1.62", "9.81"]),
    "typing_error": (case, script.replace("pair_coeff", "pear_coeff").replace("include contacts", "pear_coeff * *"),
                     [], 2, ["in.settling", "LIGGGHTS stopped", "Unknown command: pear_coeff"]),
    "incomplete": (case, script.replace("include contacts", "pair_style gran model hooke tangential history"), [], 2,
                   ["in.settling", "LIGGGHTS stopped", "All pair coeffs are not set"]),
    "lost_in_a_window": (case, script + 'fix stop all print 37 "${not_there}"\n', [], 3,
                         ["LIGGGHTS stopped", "ERROR", "DEM steps", "t = 0.003 s"]),
}
box = (folder / "box").read_text()
(folder / "box_lj").write_text(box.replace("units si", "units lj"))
(folder / "box_periodic").write_text(box.replace("boundary f f f", "boundary p f f"))

failed = 0
for name, (case_text, script_text, options, code, words) in endings.items():
    returned, said, _ = run(name, case_text, script_text, *options)
    missing = [word for word in words if word not in said]
    print(f"{name}: exit code {returned}" + (f", expected {code}" if returned != code else ""))
    if returned != code or missing:
        failed += 1
        print(f"  not said: {missing}\n  said:\n{said}")

# The partner is killed: dem_side tells how far the run came.
returned, said, out = run("killed", case, script, "--killed-in-window", "5")
results = json.loads((out / "results.json").read_text()) if (out / "results.json").exists() else {}
told = (results.get("status") == "failed" and results["failure"]["side"] == "fluid"
        and results["steps"] == {"windows": 4, "fluid": 0, "particles": 40})
print(f"killed: exit code {returned}, results.json {'tells so' if told else results}")
if not told or "foam_side" not in said:
    failed += 1
    print(said)
sys.exit(1 if failed else 0)
