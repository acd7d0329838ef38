# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study found: as text, as study.json, as study.html."""
import json

from matplotlib import ticker

from reporting import tables
from reporting.figures import COLOURS, SIZE, pyplot
from reporting.page import STYLE, escape, image, section, table
from studying.errors import pareto, reference_text


def percent(error):
    return "-" if error is None else f"{100 * error:.3g} %"


def error_cell(row, quantity):
    """The error, and how much of it is the time's where the study says what to compare with."""
    of_time = row["errors_in_time"].get(quantity)
    return percent(row["errors"].get(quantity)) + ("" if of_time is None else f" (time {percent(of_time)})")


def text(rows, quantities, statements):
    """The table for the terminal."""
    width = max(len(row["name"]) for row in rows)
    wide = {q: max([len(q)] + [len(error_cell(row, q)) for row in rows]) for q in quantities}
    lines = [f"{'':<{width}}  {'status':<12}{'wall':>10}{'cells':>10}  " + "  ".join(f"{q:>{wide[q]}}" for q in quantities)]
    for row in rows:
        wall = "-" if row["wall_seconds"] is None else f"{row['wall_seconds']:.1f} s"
        cells = row["cells"].get("fine_max") or "-"
        errors = "  ".join(f"{error_cell(row, q):>{wide[q]}}" for q in quantities)
        lines.append(f"{row['name']:<{width}}  {row['status']:<12.12}{wall:>10}{cells:>10}  {errors}")
    return "\n".join(lines + [""] + statements)


def write_json(path, rows, plan, statements):
    content = {"rows": rows, "reference": reference_text(plan.reference), "statements": statements}
    path.write_text(json.dumps(content, indent=1) + "\n")


def error_against_time(rows, quantity):
    """The runs in the plane of wall time and error; a line through those that none beats in both."""
    known = [row for row in rows if row["status"] == "completed" and row["errors"].get(quantity)]
    if not known:
        return None
    figure, axes = pyplot.subplots(figsize=SIZE, layout="constrained")
    for single, colour, label in ((True, COLOURS[1], "single-scale"), (False, COLOURS[0], "multiscale")):
        points = [row for row in known if row["single_scale"] == single]
        if points:
            axes.plot([r["wall_seconds"] for r in points], [r["errors"][quantity] for r in points], "o", color=colour,
                      label=label)
    for number, row in enumerate(rows, 1):  # names would lie over each other: the table says who is who
        if row in known:
            axes.annotate(str(number), (row["wall_seconds"], row["errors"][quantity]), fontsize=9, xytext=(4, 3),
                          textcoords="offset points")
    front = sorted((row["wall_seconds"], row["errors"][quantity]) for row in known
                   if row["name"] in pareto(rows, quantity))
    axes.plot([t for t, _ in front], [e for _, e in front], "-", color="#8a949e", linewidth=1, zorder=0,
              label="not beaten in both")
    axes.set(xscale="log", yscale="log", xlabel="wall time [s]", ylabel="relative error [%]")
    label_log_axis(axes.xaxis, lambda seconds, _: f"{seconds:g}")
    label_log_axis(axes.yaxis, lambda error, _: f"{100 * error:g}")
    axes.legend()
    return figure


def label_log_axis(axis, text):
    """Numbers at 1, 2 and 5 of every decade: runs often differ by less than one."""
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(text)
    axis.set_minor_formatter(ticker.NullFormatter())


def cost(rows):
    """Wall time of each run, split into its parts."""
    done = [row for row in rows if row["status"] == "completed"]
    if not done:
        return None
    figure, axes = pyplot.subplots(figsize=(SIZE[0], 0.8 + 0.35 * len(done)), layout="constrained")
    left = [0.0] * len(done)
    for part, colour in zip(("fluid", "particles", "exchange"), COLOURS):
        widths = [row["parts_seconds"].get(part) or 0 for row in done]
        axes.barh([row["name"] for row in done], widths, left=left, color=colour, label=part)
        left = [a + b for a, b in zip(left, widths)]
    axes.invert_yaxis()
    axes.set_xlabel("wall time [s]")
    axes.legend()
    return figure


def html(rows, plan, statements):
    """The page, self-contained."""
    header = ["", "run", "status", "wall time", "fluid", "particles", "exchange", "fine cells", "memory", *plan.quantities]
    body = []
    for number, row in enumerate(rows, 1):
        parts = [tables.duration(row["parts_seconds"].get(p)) for p in ("fluid", "particles", "exchange")]
        status = row["status"] if not row["failure"] else f"{row['status']}: {row['failure']}"
        body.append([str(number), escape(row["name"]), escape(status), tables.duration(row["wall_seconds"]), *parts,
                     tables.amount(row["cells"].get("fine_max")), tables.size(row["peak_memory_bytes"]),
                     *(error_cell(row, q) for q in plan.quantities)])
    plots = ""
    for quantity in plan.quantities:
        figure = error_against_time(rows, quantity)
        if figure:
            plots += (f"<figure class=\"plot\"><figcaption>{escape(quantity)}</figcaption>"
                      f"{image(figure, f'error of {quantity} against wall time')}</figure>")
    figure = cost(rows)
    costs = f"<figure class=\"plot\">{image(figure, 'wall time by part')}</figure>" if figure else ""
    said = "".join(f"<p>{escape(line)}</p>" for line in statements)
    title = f"Study {plan.file.stem}"
    parts = [f"<h1>{escape(title)}</h1>",
             f"<p>Errors against {escape(reference_text(plan.reference))}; root mean square over the run, relative to "
             "that of the reference. In brackets: the part of the time, against the same mesh with short windows and "
             "steps. Wall times: median of " f"{plan.repeat} run(s), one after the other.</p>",
             section("What it says", said), section("Runs", table(body, header)),
             section("Error against run time", "<p class=\"quiet\">The numbers are those of the table's rows.</p>"
                     f"<div class=\"columns\">{plots}</div>"), section("Cost", costs)]
    return ("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
            f"<title>{escape(title)}</title><style>{STYLE}</style></head><body>" + "\n".join(parts)
            + "</body></html>\n")
