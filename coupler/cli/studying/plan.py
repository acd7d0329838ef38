# SPDX-License-Identifier: GPL-3.0-or-later
"""A study file, checked: which runs, what they are measured against."""
import dataclasses
import difflib
import itertools
import pathlib
import re

import yaml

KEYS = {"case": "the case file, counted from the study file's folder",
        "set": "settings of every run, as --set of demvof run: {coupling.end_time: 0.1}",
        "quantities": "columns of history.csv whose error is measured",
        "reference": "{row: NAME}, {exact: {QUANTITY: VALUE}} or {file: CSV, quantity: NAME, time: COLUMN, value: COLUMN}",
        "repeat": "how often each run is made for its wall time (median); 1 when not given",
        "rows": "the runs: {NAME: {set: {...}, single_scale: yes|no, converged_in_time: NAME}}",
        "sweep": "further runs, one for each combination: {KEY: [VALUE, ...]}"}
ROW_KEYS = {"set", "single_scale", "converged_in_time"}
REFERENCE_KEYS = {"row": {"row"}, "exact": {"exact"},
                  "file": {"file", "quantity", "time", "value", "time_scale", "value_scale", "value_shift"}}


class BadStudy(Exception):
    """What is wrong with the study file, for people."""


@dataclasses.dataclass
class Row:
    name: str
    settings: dict  # path of a key -> value
    single_scale: bool = False
    converged_in_time: str = None  # name of the row that differs by short windows and steps alone


@dataclasses.dataclass
class Plan:
    file: pathlib.Path
    case: pathlib.Path
    rows: list
    quantities: list
    reference: dict
    repeat: int = 1


def read_plan(path):
    """Throws BadStudy with one line per mistake."""
    path = pathlib.Path(path)
    try:
        content = yaml.safe_load(path.read_text())
    except OSError as error:
        raise BadStudy(f"{path}: {error.strerror}") from None
    except yaml.YAMLError as error:
        raise BadStudy(f"{path}: not valid YAML: {error}") from None
    if not isinstance(content, dict):
        raise BadStudy(f"{path}: give a map with {', '.join(KEYS)}")
    mistakes = []
    for key in content:
        if key not in KEYS:
            near = difflib.get_close_matches(str(key), KEYS, 1)
            mistakes.append(f"{key}: unknown key" + (f"; did you mean {near[0]}?" if near else ""))
    for key in ("case", "quantities", "reference"):
        if key not in content:
            mistakes.append(f"{key}: missing; {KEYS[key]}")
    case = path.parent / str(content.get("case", ""))
    if "case" in content and not case.is_file():
        mistakes.append(f"case: there is no file {case}")
    repeat = content.get("repeat", 1)
    if not isinstance(repeat, int) or repeat < 1:
        mistakes.append(f"repeat: {repeat} is not allowed; give a whole number from 1 on")
    quantities = content.get("quantities", [])
    if not isinstance(quantities, list) or not all(isinstance(q, str) for q in quantities):
        mistakes.append(f"quantities: {quantities} is not allowed; give a list of names")
        quantities = []
    rows = read_rows(content, mistakes)
    check_reference(content.get("reference"), rows, path, mistakes)
    if mistakes:
        raise BadStudy("\n".join(f"{path}: {mistake}" for mistake in mistakes))
    return Plan(path, case, rows, quantities, content["reference"], repeat)


def read_rows(content, mistakes):
    common = content.get("set") or {}
    rows = []
    for name, row in (content.get("rows") or {}).items():
        row = row or {}
        if not re.fullmatch(r"[\w.+-]+", str(name)):
            mistakes.append(f"rows.{name}: a name is made of letters, digits and _ . + -")
        if not isinstance(row, dict) or set(row) - ROW_KEYS:
            mistakes.append(f"rows.{name}: give a map with {', '.join(sorted(ROW_KEYS))}")
            continue
        rows.append(Row(str(name), {**common, **(row.get("set") or {})}, bool(row.get("single_scale", False)),
                        row.get("converged_in_time")))
    sweep = content.get("sweep") or {}
    if not isinstance(sweep, dict) or not all(isinstance(values, list) and values for values in sweep.values()):
        mistakes.append("sweep: give a map of keys to lists of values")
    elif sweep:
        for values in itertools.product(*sweep.values()):
            settings = dict(zip(sweep, values))
            rows.append(Row(sweep_name(settings), {**common, **settings}))
    names = [row.name for row in rows]
    for name in dict.fromkeys(names):
        if names.count(name) > 1:
            mistakes.append(f"rows.{name}: given twice")
    for row in rows:
        if row.converged_in_time is not None and row.converged_in_time not in names:
            mistakes.append(f"rows.{row.name}.converged_in_time: there is no row {row.converged_in_time}")
    if not rows:
        mistakes.append("rows: missing; give rows or a sweep")
    return rows


def sweep_name(settings):
    """window_0.0005+kernel_linear"""
    return "+".join(re.sub(r"[^\w.+-]+", "_", f"{key.split('.')[-1]}_{value}").strip("_")
                    for key, value in settings.items())


def check_reference(reference, rows, path, mistakes):
    if reference is None:
        return
    kind = next((k for k in REFERENCE_KEYS if isinstance(reference, dict) and k in reference), None)
    if kind is None or set(reference) - REFERENCE_KEYS[kind]:
        mistakes.append(f"reference: {reference} is not allowed; give {KEYS['reference']}")
    elif kind == "row" and reference["row"] not in [row.name for row in rows]:
        mistakes.append(f"reference: there is no row {reference['row']}")
    elif kind == "file":
        missing = {"quantity", "time", "value"} - set(reference)
        if missing:
            mistakes.append(f"reference: missing {', '.join(sorted(missing))}")
        if not (path.parent / reference["file"]).is_file():
            mistakes.append(f"reference: there is no file {path.parent / reference['file']}")


def assignment(key, value):
    """The argument of --set; YAML's flow style for lists and numbers."""
    text = yaml.safe_dump(value, default_flow_style=True, width=10**6).strip()
    return f"{key}={text.removesuffix('...').strip()}"
