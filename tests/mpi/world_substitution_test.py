# SPDX-License-Identifier: GPL-3.0-or-later
"""Every MPI function with a communicator that OpenFOAM or LIGGGHTS imports is replaced in the programs.

Usage: world_substitution_test.py NM MPI_HEADER PROGRAM[,PROGRAM...] LIBRARY...
One function forgotten, and a solver talks to the whole pair where it means its own ranks: a deadlock.
"""
import os
import re
import subprocess
import sys
import unittest

NM, HEADER, PROGRAMS, *LIBRARIES = sys.argv[1:]
PROGRAMS = PROGRAMS.split(",")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def with_dependencies(libraries):
    """The libraries and all they are linked with, the MPI library itself left out."""
    found = set()
    for library in libraries:
        found.add(os.path.realpath(library))
        found.update(os.path.realpath(path) for path in re.findall(r"=> (/\S+)", run("ldd", library)))
    return {path for path in found if not re.search(r"/lib(mpi|open-rte|open-pal|mca_)[^/]*$", path)}


def symbols(path, which):
    return set(re.findall(r" [A-Z] (MPI_\w+)|$", run(NM, "-D", which, path))) - {""}


def functions_with_communicator(header):
    """Names of the functions that get a communicator by value (not a pointer to one)."""
    with open(header) as file:
        text = re.sub(r"/\*.*?\*/", " ", file.read(), flags=re.S)
    found = re.findall(r"\b(MPI_\w+)\s*\(([^;{}()]*?\bMPI_Comm\s+\w[^;{}()]*?)\)\s*[;_]", text)
    return {name for name, _ in found}


class WorldSubstitution(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.with_communicator = functions_with_communicator(HEADER)
        cls.imports = {}
        for library in sorted(with_dependencies(LIBRARIES)):
            for name in symbols(library, "--undefined-only"):
                cls.imports.setdefault(name, set()).add(os.path.basename(library))

    def test_the_lists_are_what_they_should_be(self):
        for name in ("MPI_Allreduce", "MPI_Comm_create", "MPI_Alltoallv", "MPI_Scatterv", "MPI_Abort", "MPI_Irecv"):
            self.assertIn(name, self.with_communicator)
            self.assertIn(name, self.imports)
        self.assertNotIn("MPI_Wait", self.with_communicator)
        self.assertNotIn("MPI_Comm_free", self.with_communicator)  # a pointer: no world to replace
        self.assertIn("MPI_Waitall", self.imports)

    def test_every_import_with_a_communicator_is_replaced(self):
        needed = self.with_communicator & set(self.imports) | {"MPI_Init", "MPI_Init_thread", "MPI_Finalize"}
        for program in PROGRAMS:
            missing = needed - symbols(program, "--defined-only")
            self.assertFalse(missing, "%s does not replace %s" % (
                program, ", ".join("%s (imported by %s)" % (name, ", ".join(sorted(self.imports.get(name, []))))
                                   for name in sorted(missing))))
        print("%d functions with a communicator imported by %s: all replaced in %s" % (
            len(needed), ", ".join(os.path.basename(library) for library in LIBRARIES), ", ".join(PROGRAMS)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
