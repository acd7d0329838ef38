# SPDX-License-Identifier: GPL-3.0-or-later
"""Each file that a run writes at an output fails, or its writer is killed, at each thing that is done to it:
points_test.py DEMVOF LIBRARY FOLDER [--long] [unittest arguments]

By default a few of these points. However the run ends: within its time, with the right code and a results.json that is
true, and with a whole state before it, from which it becomes the run that nothing befell.
"""
import errno
import shutil
import time

from injected import LONG, RANDOM, Injected, demvof, main, status

# At the second output, after window 4. (name, the operations on it before that output)
FIELDS = [(f"fluid/0.004/{field}", {}) for field in
          ("U", "p_rgh", "p", "alpha.water", "phi", "voidFraction", "velocityFlux", "uniform/time")]
# Written beside their places and renamed: opened once, brought to the disk where a state needs them.
STATE = [(f"restart/4/{file}", {}) for file in ("particles.json", "particles.", "fluid.0", "state.json")]
STATE += [("restart/latest.json", {"open": 1, "write": 1, "fsync": 1, "rename": 1})]
SHOWN = [("particles/particles_000002.vtp", {}), ("bulk/bulk_000002.vti", {}),
         ("particles/particles.pvd", {"open": 2, "write": 2, "rename": 2}), ("bulk/bulk.pvd", {"open": 2, "write": 2, "rename": 2})]
SINGLE = [("progress.json", {"open": 1, "write": 1, "rename": 1}), ("history.csv", {"write": 4, "fsync": 1})]
LATE = [("results.json", {})]  # at the end


def points():
    """(operation, name, count, error; 0: a kill)"""
    for name, before in FIELDS + STATE + SHOWN + SINGLE + LATE:
        renamed = not name.startswith("fluid/") and name != "history.csv"
        operations = ["write"] + (["open", "rename"] if renamed else ["open"] if name != "history.csv" else [])
        if name.startswith(("fluid/", "restart/")) or name == "history.csv":
            operations.append("fsync")
        for operation in operations:
            count = before.get(operation, 0) + 1
            for error in (errno.ENOSPC if operation in ("open", "write") else errno.EIO, 0):
                yield operation, name, count, error


class Points(Injected):
    def end(self, point):
        """Runs into the fault; what kind of end it was."""
        operation, name, count, error = point
        shutil.rmtree(self.out, ignore_errors=True)
        try:
            code, text = demvof(self.case_file, self.out, fault=f"{operation} {name} {count} {error}")
        except AssertionError as silent:
            return str(silent)
        if not (self.out / "results.json").exists():
            return "no results.json" if name != "results.json" or "results.json" not in text else f"code {code}, said so"
        results = status(self.out)
        if code == 0:
            return "completed" if results["status"] == "completed" else f"code 0, but {results['status']}"
        if results["status"] != "failed" or code not in (3, 4):
            return f"code {code}, but {results['status']}"
        if error and code != 3:
            return f"code {code} for an error"
        if error and name.rstrip(".").split("/")[-1].split(".")[0] not in results["failure"]["message"]:
            return "the file is not named: " + results["failure"]["message"]
        return f"code {code}"

    def test_points(self):
        whole = self.whole()
        chosen = list(points())
        if not LONG:
            chosen = RANDOM.sample(chosen, 2)
        wrong, ends = [], {}
        for point in chosen:
            begin = time.monotonic()
            end = self.end(point)
            seconds = time.monotonic() - begin
            good = end in ("code 3", "code 4", "code 3, said so", "code 4, said so")
            # A run is worth more than its progress bar; at the last file all others are there.
            good |= end == "completed" and point[1] == ("progress.json" if point[3] else "results.json")
            if not (self.out / "restart/latest.json").exists():
                end, good = end + ", no state", False
            else:
                code, text = demvof(self.case_file, self.out, "--continue")
                over = code == 2 and "is at 0.01 s already" in text
                if not over and (code != 0 or (self.out / "history.csv").read_text() != whole):
                    end, good = f"{end}, does not continue: {text}", False
            ends[end] = ends.get(end, 0) + 1
            print(*point, f"{seconds:.1f} s:", end, "" if good else "WRONG", flush=True)
            if not good:
                wrong.append((*point, end))
        print(f"{len(chosen)} points: {ends}")
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    main()
