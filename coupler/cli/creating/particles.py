# SPDX-License-Identifier: GPL-3.0-or-later
"""The LIGGGHTS script: a copy beside the files that it names, less what a coupled run does itself."""
import re
import shutil

MARK = "# demvof new: "


def copy_particles(script, target):
    """The script's name, and a line for each change of the copy."""
    target.mkdir()
    text = script.read_text(errors="replace")
    for word in sorted(set(re.findall(r"[\w./+-]+", text))):
        file = script.parent / word
        if file.is_file() and file != script and ".." not in word and not word.startswith("/"):
            (target / word).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, target / word)
    for folder in re.findall(r"(?:^|\s)(\w[\w/]*)/[\w*.]+", text):  # of dumps: LIGGGHTS makes none
        if (script.parent / folder).is_dir() or folder in ("post", "restart"):
            (target / folder).mkdir(parents=True, exist_ok=True)
    lines, changed = edited(text.splitlines())
    (target / script.name).write_text("\n".join(lines) + "\n")
    return script.name, changed


def edited(lines):
    """The script's lines as a coupled run wants them, and what was changed."""
    changed = []

    def put(number, line, why):
        changed.append(f"line {number + 1}: '{lines[number].strip()}': {why}")
        lines[number] = line

    runs = [n for n, line in enumerate(lines) if line.split("#")[0].split()[:1] == ["run"]]
    if runs and lines[runs[-1]].split()[1:2] != ["0"]:
        put(runs[-1], f"{MARK}coupling.end_time says how long\n# {lines[runs[-1]]}",
            "taken out: the coupled run starts where the script ends")
    for n, line in enumerate(lines):
        words = line.split("#")[0].split()
        if words[:1] == ["processors"] and words[1:4] != ["*", "*", "*"]:
            put(n, f"processors * * *  {MARK}{' '.join(words)}", "replaced by 'processors * * *': ranks are those of the run")
        elif words[:1] == ["fix"] and len(words) > 3 and (words[3].startswith("couple/cfd") or words[3] == "buoyancy"):
            put(n, f"{MARK}the coupling does this\n# {line}", "taken out: dem_side does this")
    return lines, changed
