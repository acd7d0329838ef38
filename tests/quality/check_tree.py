#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the source tree's text that no compiler makes: check_tree.py RULE [FOLDER].

Prints one line per offence, as file:line: text; exits 1 if there is one. `check_tree.py --self-test` shows each rule
a tree that breaks it.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

CODE = {".cpp", ".hpp", ".py", ".js", ".sh", ".cmake"}
SCRIPTS = {"Allrun", "Allwmake", "Alltest", "Allclean", "CMakeLists.txt"}
MACHINE_PATH = re.compile(r"(?<![\w.$}/~*-])/(home|root|tmp|work|Users|mnt|opt|srv)/\w")
SOLVER_INCLUDE = re.compile(r'#\s*include\s*[<"](?!coupler/)(foam_side/|dem_side/|liggghts/|lammps|[\w/]+\.(H|C)[>"])')
OPENFOAM_OR_LIGGGHTS = re.compile(r"\b(LAMMPS_NS|namespace Foam|Foam::)")


def files(folder):
    """Files that git tracks or would track; without git, all but build folders."""
    git = subprocess.run(["git", "-C", folder, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    if git.returncode == 0:
        names = [folder / name for name in git.stdout.splitlines()]
    else:
        names = [path for path in folder.rglob("*") if not path.relative_to(folder).parts[0].startswith("build")]
    return sorted(path for path in names if path.is_file())


def lines(path):
    try:
        return list(enumerate(path.read_text(encoding="utf-8").splitlines(), 1))
    except UnicodeDecodeError:  # a picture
        return []


def is_code(path):
    return path.suffix in CODE or path.name in SCRIPTS


def machine_paths(folder):
    """No path that exists on one machine only."""
    for path in files(folder):
        if path.name != "LICENSE":
            yield from ((path, n, text) for n, text in lines(path) if MACHINE_PATH.search(text))


def licence_header(folder):
    """Every source file says its licence in its first lines."""
    for path in filter(is_code, files(folder)):
        if not any("SPDX-License-Identifier: GPL-3.0-or-later" in text for _, text in lines(path)[:3]):
            yield path, 1, "no SPDX-License-Identifier: GPL-3.0-or-later"


def solver_free_coupler(folder):
    """The coupler knows neither solver."""
    for path in files(folder):
        if path.relative_to(folder).parts[0] == "coupler" and path.suffix in {".cpp", ".hpp"}:
            yield from ((path, n, text) for n, text in lines(path)
                        if SOLVER_INCLUDE.search(text) or OPENFOAM_OR_LIGGGHTS.search(text.split("//")[0]))


LAYERS = [{"base"}, {"grid"}, {"closures", "transfer", "exchange"}, {"link"}, {"config"}, {"scene"}, {"output"}, {"cli"}]
LEVEL = {name: level for level, names in enumerate(LAYERS) for name in names}
COUPLER_INCLUDE = re.compile(r'#\s*include\s*"coupler/(\w+)/')


def layers(folder):
    """The folders of the coupler are layers: each includes only those below it and itself."""
    for path in files(folder):
        parts = path.relative_to(folder).parts
        if len(parts) < 3 or parts[0] != "coupler" or path.suffix not in {".cpp", ".hpp"}:
            continue
        for n, text in lines(path):
            found = COUPLER_INCLUDE.match(text)
            if found and found[1] != parts[1] and not LEVEL.get(found[1], 99) < LEVEL.get(parts[1], -1):
                yield path, n, text


def short_files(folder):
    """No source file beyond 400 lines."""
    for path in filter(is_code, files(folder)):
        if len(lines(path)) > 400:
            yield path, len(lines(path)), "longer than 400 lines"


HEADING = re.compile(r"^#+ (.*)", re.MULTILINE)
REFERENCE = re.compile(r"\(docs/(\w+\.md), ([^)\"]+)\)")


def explained(folder):
    """What a message or comment calls (docs/PAGE.md, HEADING) is there, and each heading of docs/warnings.md is called."""
    headings = {path.name: set(HEADING.findall(path.read_text())) for path in (folder / "docs").glob("*.md")}
    named = set()
    for path in files(folder):
        if path.suffix not in {".cpp", ".hpp"}:
            continue
        text = re.sub(r'"\s*\n\s*"|\n\s*//+ ?', lambda gap: "" if '"' in gap[0] else " ", path.read_text())
        for page, heading in REFERENCE.findall(text):
            named.add((page, heading))
            if heading not in headings.get(page, ()):
                yield path, 1, f"there is no docs/{page}, {heading}"
    for heading in sorted(headings.get("warnings.md", set()) - {"Warnings"}):
        if ("warnings.md", heading) not in named:
            yield folder / "docs" / "warnings.md", 1, f"no message names {heading}"


RULES = {rule.__name__: rule for rule in (machine_paths, licence_header, solver_free_coupler, layers, short_files, explained)}


def self_test():
    """Each rule finds its offence, and nothing in a clean file."""
    licence = "// SPDX-License-Identifier: GPL-3.0-or-later\n"
    clean = licence + '#include "coupler/base/vec3.hpp"\n#include <mpi.h>\nconst char* etc = "/usr/share/openfoam";\n'
    broken = {
        "layers": licence + '#include "coupler/config/parameters.hpp"\n',
        "machine_paths": licence + 'const char* data = "/ho' + 'me/somebody/data";\n',
        "licence_header": "#include <mpi.h>\n",
        "solver_free_coupler": licence + '#include "fvMesh.H"\n',
        "short_files": licence + "\n" * 400,
        "explained": licence + 'const char* said = "no room (docs/warnings.md, "\n    "Rooms)";\n',
    }
    for name, text in broken.items():
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "coupler", "link", "a.cpp")
            file.parent.mkdir(parents=True)
            file.write_text(clean)
            if list(RULES[name](pathlib.Path(folder))):
                sys.exit(f"{name} finds an offence in a clean file")
            file.write_text(text)
            if not list(RULES[name](pathlib.Path(folder))):
                sys.exit(f"{name} does not find its offence")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rule", nargs="?", choices=RULES)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    offences = list(RULES[arguments.rule](arguments.folder))
    for path, line, text in offences:
        print(f"{path.relative_to(arguments.folder)}:{line}: {text.strip()}")
    print(f"{RULES[arguments.rule].__doc__}  {len(offences)} offences")
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main())
