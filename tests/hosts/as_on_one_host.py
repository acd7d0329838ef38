# SPDX-License-Identifier: GPL-3.0-or-later
"""A run over several hosts beside the same one on one host, to which nothing happened."""
import pathlib
import subprocess
import sys

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "support"), str(TESTS / "verification" / "pair"), str(TESTS.parent / "coupler" / "cli")]
from histories import differences  # noqa: E402
from reporting.run import Run  # noqa: E402

# Relative. LIGGGHTS sorts the beads in memory now and then; after a restart their sums may be taken in another order.
ROUND_OFF = 1e-12


def require_as_on_one_host(test, demvof, case_file, out, *options):
    alone = out.parent / "one_host"
    done = subprocess.run([demvof, "run", case_file, "--out", alone, *options], text=True, check=False, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    test.assertEqual(done.returncode, 0, done.stdout)
    here, there = Run(out), Run(alone)
    test.assertEqual(list(here.times), list(there.times))
    largest = max(differences(here, there).values())
    print(f"---- {len(there.times)} times, largest difference from one host {largest:.1e}", flush=True)
    test.assertLess(largest, ROUND_OFF)
