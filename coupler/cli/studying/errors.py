# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of runs against a reference, and what they say about cost."""
import csv

import numpy


def against_history(times, values, reference_times, reference_values):
    """Root mean square of the difference over that of the reference, at the reference's times within both."""
    inside = (reference_times >= times[0] - 1e-12) & (reference_times <= times[-1] * (1 + 1e-9))
    if not inside.any():
        return None
    wanted = reference_values[inside]
    size = numpy.sqrt(numpy.mean(wanted**2))
    found = numpy.interp(reference_times[inside], times, values)
    return float(numpy.sqrt(numpy.mean((found - wanted)**2)) / size) if size > 0 else None


def read_points(path, reference):
    """Times and values of a reference table, in the run's units: value_scale * (column + value_shift)."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if line.strip() and not line.startswith("#")))
    times = numpy.array([float(row[reference["time"]]) for row in rows]) * reference.get("time_scale", 1)
    values = numpy.array([float(row[reference["value"]]) for row in rows]) + reference.get("value_shift", 0)
    order = numpy.argsort(times)
    return times[order], values[order] * reference.get("value_scale", 1)


def errors(run, plan, reference_run):
    """quantity -> relative error, - (None: cannot be said) of one run."""
    kind = plan.reference
    found = {}
    for quantity in plan.quantities:
        values = run.history.get(quantity)
        error = None
        if values is not None and len(values):
            if "row" in kind and reference_run is not None and quantity in reference_run.history:
                error = against_history(run.times, values, reference_run.times, reference_run.history[quantity])
            elif "exact" in kind and quantity in kind["exact"]:
                exact = kind["exact"][quantity]
                error = float(abs(values[-1] - exact) / abs(exact))
            elif "file" in kind and quantity == kind["quantity"]:
                error = against_history(run.times, values, *read_points(plan.file.parent / kind["file"], kind))
        found[quantity] = error
    return found


def errors_in_time(run, plan, converged_run):
    """quantity -> difference to the same mesh with windows and steps so short that they no longer matter, -."""
    return {quantity: against_history(run.times, run.history[quantity], converged_run.times,
                                      converged_run.history[quantity])
            for quantity in plan.quantities if quantity in run.history and quantity in converged_run.history}


def reference_text(reference):
    if "row" in reference:
        return f"the run {reference['row']}"
    if "exact" in reference:
        return "exact values: " + ", ".join(f"{name} = {value:g}" for name, value in reference["exact"].items())
    return f"{reference['file']} ({reference['quantity']})"


def pareto(rows, quantity):
    """Names of the rows that no other row beats in both time and error."""
    known = [(row["wall_seconds"], row["errors"].get(quantity), row["name"]) for row in rows
             if row["status"] == "completed" and row["errors"].get(quantity) is not None]
    return [name for time, error, name in known
            if not any((t <= time and e <= error and (t, e) != (time, error)) for t, e, _ in known)]


def statements(rows, plan):
    """What each multiscale run costs beside the cheapest single-scale run that is as good, one sentence each."""
    reference = plan.reference.get("row")
    done = [row for row in rows if row["status"] == "completed" and row["wall_seconds"]]
    single = [row for row in done if row["single_scale"]]
    lines = []
    for quantity in plan.quantities:
        for row in done:
            error = row["errors"].get(quantity)
            if row["single_scale"] or row["name"] == reference or error is None or not single:
                continue
            as_good = [s for s in single if s["errors"].get(quantity) is not None and s["errors"][quantity] <= error]
            begin = f"{quantity}: to reach error {100 * error:.3g} %, {row['name']} needs {row['wall_seconds']:.1f} s"
            if as_good:
                cheapest = min(as_good, key=lambda s: s["wall_seconds"])
                lines.append(f"{begin}, {row['wall_seconds'] / cheapest['wall_seconds']:.2f} times the time of the "
                             f"cheapest single-scale run that does, {cheapest['name']} "
                             f"({100 * cheapest['errors'][quantity]:.3g} %).")
            else:
                best = min((s for s in single if s["errors"].get(quantity) is not None),
                           key=lambda s: s["errors"][quantity], default=None)
                nearest = (f" (the best, {best['name']}, has {100 * best['errors'][quantity]:.3g} % after "
                           f"{best['wall_seconds']:.1f} s)" if best else "")
                lines.append(f"{begin}; no single-scale run reaches that{nearest}.")
    return lines
