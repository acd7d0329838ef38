# SPDX-License-Identifier: GPL-3.0-or-later
"""report.html: one self-contained page. A part that cannot be made says why and leaves the others alone."""
import base64
import html as markup
import io
import json

from reporting import explained, figures, tables, view

STYLE = """
:root { color-scheme: light dark; --line: #dde3e8; --quiet: #5b6670; --text: #1c2329; --page: #fff; --block: #f4f6f8; }
@media (prefers-color-scheme: dark) {
  :root { --line: #3d464e; --quiet: #a3adb6; --text: #e3e7ea; --page: #1a1f24; --block: #262c32; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1320px; padding: 1rem; color: var(--text); background: var(--page);
       font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.2; } h2 { font-size: 1.2rem; margin: 2rem 0 .6rem; }
h2.run { font-size: 1.5rem; margin-top: 3rem; border-top: 2px solid var(--line); padding-top: 1rem; }
.status { display: inline-block; padding: .1rem .6rem; border-radius: 1rem; font-size: .95rem; font-weight: 600; }
.good { background: #d9f0e0; color: #14532d; } .bad { background: #fbe0dd; color: #7f1d1d; }
.quiet { color: var(--quiet); }
.columns { display: grid; gap: 1rem 2rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 380px), 1fr)); }
.pictures { display: grid; gap: .8rem; grid-template-columns: repeat(auto-fill, minmax(min(46%, 200px), 1fr)); }
.wide { overflow-x: auto; }
figure { margin: 0; } figcaption { color: var(--quiet); font-size: .9rem; }
.plot figcaption { color: inherit; font-weight: 600; }
.number { white-space: nowrap; }
img { width: 100%; height: auto; display: block; } .plot img { max-width: 640px; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: .25rem .8rem .25rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; } td { overflow-wrap: anywhere; min-width: 2.2rem; } td .number { overflow-wrap: normal; }
.warnings { max-width: 60rem; padding-left: 1.2rem; } .warnings p { margin: .4rem 0; } summary { cursor: pointer; }
pre { overflow-x: auto; background: var(--block); padding: .7rem; font-size: .85rem; white-space: pre-wrap; }
.bar { display: inline-block; height: .7rem; background: #1f6fb2; vertical-align: middle; min-width: 1px; }
"""


def html(runs):
    """The page about these runs, as text."""
    title = runs[0].name if len(runs) == 1 else f"{len(runs)} runs"
    parts = [f"<h1>{escape(case_name(runs[0]))}: {escape(title)}</h1>"]
    if len(runs) > 1:
        parts += [guarded(comparison, runs), section("Fronts", guarded(fronts, runs)),
                  section("History", guarded(histories, runs)), section("From window to window", guarded(windows, runs))]
    for run in runs:
        if len(runs) > 1:
            parts.append(f"<h2 class=\"run\">{escape(run.name)}</h2>")
        parts += one_run(run, views=len(runs))
    if any("class=\"view\"" in part for part in parts):
        parts.append(view.scripts())
    return ("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
            f"<title>{escape(case_name(runs[0]))}: {escape(title)}</title><style>{STYLE}</style></head><body>"
            + "\n".join(parts) + "</body></html>\n")


def one_run(run, views):
    kind = "good" if run.completed else "bad"
    parts = [f"<p><span class=\"status {kind}\">{escape(run.status)}</span> {escape(tables.headline(run))}</p>"]
    if not run.completed:
        parts.append(guarded(stopped, run))
    parts += [section("Surface and particles", guarded(pictures, run)),
              section("In three dimensions", guarded(lambda shown: view.html(shown, views), run))]
    if views == 1:
        parts += [section("Fronts", guarded(fronts, [run])), section("History", guarded(histories, [run])),
                  section("From window to window", guarded(windows, [run]))]
    parts.append(section("Warnings", guarded(warnings, run)))
    parts.append('<div class="columns">' + section("Run", guarded(summary, run))
                 + section("Conservation", guarded(conservation, run)) + section("Cost", guarded(costs, run)) + "</div>")
    parts.append(section("What was on, and why", guarded(scene, run)))
    parts.append(guarded(configuration, run))
    return parts


def guarded(part, argument):
    """The part's text; of a part that fails, the reason: half a run still gets its report."""
    try:
        return part(argument)
    except Exception as error:  # whatever an unfinished file may cause
        return f"<p class=\"quiet\">Not shown: {escape(str(error) or type(error).__name__)}.</p>"


def section(title, content):
    return f"<section><h2>{escape(title)}</h2>{content}</section>" if content else ""


def escape(text):
    return markup.escape(str(text))


def case_name(run):
    parent = run.folder.resolve().parent
    return parent.name if (parent / "case.yaml").is_file() else "demvof run"


def image(figure, alternative, dpi=160):
    """The figure as an inline picture; the figure is closed. data-smallest-text: its height over the picture's width."""
    sizes = [text.get_fontsize() for text in figure.findobj(figures.Text) if text.get_visible() and text.get_text()]
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=dpi)
    figures.pyplot.close(figure)
    code = base64.b64encode(data.getvalue()).decode()
    smallest = f" data-smallest-text=\"{min(sizes) / 72 / figure.get_figwidth():.4f}\"" if sizes else ""
    return f"<img alt=\"{escape(alternative)}\"{smallest} src=\"data:image/png;base64,{code}\">"


def table(rows, header=()):
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<div class=\"wide\"><table>{'<tr>' + head + '</tr>' if head else ''}{body}</table></div>"


def stopped(run):
    """Why a run is not complete, as far as its files tell."""
    failure = run.results.get("failure") or {}
    lines = []
    if failure:
        lines.append(f"<p>The {escape(failure.get('side', '?'))} side failed in {escape(failure.get('stage', '?'))} at "
                     f"t = {tables.amount(failure.get('time'))} s: {escape(failure.get('message', ''))}</p>")
    lines.append(f"<p>What follows goes up to t = {tables.amount(run.last_time)} s.</p>")
    for log in ("fluid.log", "particles.log"):
        tail = run.log_tail(log)
        if tail:
            lines.append(f"<details><summary>End of {log}</summary><pre>{escape(chr(10).join(tail))}</pre></details>")
    return "".join(lines)


def pictures(run):
    drawn, caption, reasons = figures.pictures(run)
    boxes = "".join(f"<figure>{image(figure, f'surface at {time:g} s')}<figcaption>t = {time:.4g} s</figcaption></figure>"
                    for time, figure in drawn)
    notes = "".join(f"<p class=\"quiet\">{escape(text)}</p>" for text in [caption, *reasons])
    return f"<div class=\"pictures\">{boxes}</div>{notes}"


def fronts(runs):
    figure = figures.fronts(runs)
    if not figure:
        return ""
    sources = [figures.read_reference(path)[0] for path in runs[0].reference_files("*front*.csv")]
    notes = "".join(f"<p class=\"quiet\">Points: {escape(source)}</p>" for source in sources)
    return f"<div class=\"plot\">{image(figure, 'fronts against time')}</div>{notes}"


def histories(runs):
    made = figures.histories(runs)
    if not made:
        return "<p class=\"quiet\">There is no history.csv, or no row in it yet.</p>"
    return plots(made)


def windows(runs):
    made = figures.grouped(runs, figures.WINDOWS)
    return plots(made) if made else ""


def plots(made):
    return "<div class=\"columns plot\">" + "".join(
        f"<figure><figcaption>{escape(title)}</figcaption>{image(figure, title)}</figure>" for title, figure in made) + "</div>"


def summary(run):
    return table([(escape(what), escape(value)) for what, value in tables.summary(run)])


def conservation(run):
    rows = [(escape(what), "-" if error is None else f"{error:.1e}") for what, error in tables.conservation(run)]
    return table(rows, ("what must hold", "worst relative error"))


def warnings(run):
    said = run.results.get("warnings")
    return explained.html(said) if said else ""


def costs(run):
    rows = [(escape(name), f"<span class=\"number\">{tables.duration(seconds)}</span>",
             f"<span class=\"number\">{100 * share:.1f} %</span>",
             f"<span class=\"bar\" style=\"width:{90 * share:.1f}px\"></span>") for name, seconds, share in tables.costs(run)]
    if not rows:
        return "<p class=\"quiet\">Not recorded.</p>"
    waiting = tables.duration(run.number("wall_seconds.waiting"))
    return table(rows) + f"<p class=\"quiet\">Waiting for the partner, both sides together: {waiting}.</p>"


def scene(run):
    rows = [(escape(item.get("decision", "")), "on" if item.get("on") else "off", escape(item.get("reason", "")))
            for item in run.results.get("scene") or []]
    if not rows:
        return "<p class=\"quiet\">Not recorded.</p>"
    decided = "Decided at the start, for the whole run; what changes from window to window is shown over time above."
    return table(rows, ("", "", "because")) + f"<p class=\"quiet\">{decided}</p>"


def configuration(run):
    if not run.configuration:
        return ""
    command = run.results.get("command", "")
    return (f"<details><summary>Configuration {escape(run.results.get('configuration_hash', ''))}</summary>"
            f"<pre>{escape(command)}</pre><pre>{escape(json.dumps(run.configuration, indent=2))}</pre></details>")


def comparison(runs):
    """One column per run: what they differ in, and what came out."""
    rows = [(escape(path), *(escape(value) for value in values)) for path, values in tables.differences(runs).items()]
    columns = [dict(tables.summary(run)) for run in runs]
    rows += [(escape(what), *(escape(column.get(what, "-")) for column in columns)) for what in columns[0]]
    names = dict.fromkeys(name for run in runs for name in run.results.get("quantities") or {})
    rows += [(escape(name.replace("_", " ")), *(tables.amount(run.number(f"quantities.{name}")) for run in runs))
             for name in names]
    return table(rows, ("", *(run.name for run in runs)))
