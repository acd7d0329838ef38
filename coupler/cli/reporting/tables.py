# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of runs as tables: for the page, for the terminal, as CSV."""
import csv


def amount(value, unit=""):
    """A number for people: 4 digits, or all of a whole number."""
    if value is None:
        return "-"
    text = f"{value:d}" if isinstance(value, int) else f"{value:.4g}"
    return f"{text} {unit}".strip()


def size(value):
    """Bytes for people."""
    return "-" if value is None else f"{value / 1e6:.0f} MB"


def duration(seconds):
    """Wall time for people."""
    if seconds is None:
        return "-"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes:02d} min"
    return f"{minutes} min {rest:02d} s" if minutes else f"{seconds:.3g} s"


def summary(run):
    """[(what, value)] about one run."""
    number = run.number
    end = run.setting("coupling.end_time") or run.progress.get("end_time")
    rows = [("status", run.status), ("simulated time", f"{amount(run.last_time, 's')} of {amount(end, 's')}")]
    if not run.results:
        return rows
    cells = [number("cells.fine_min"), number("cells.fine_max")]
    fine = amount(cells[0]) if cells[0] == cells[1] else f"{amount(cells[0])} to {amount(cells[1])}"
    machine = run.results.get("machine") or {}
    if number("continued_from"):
        rows.append(("continued from", f"{amount(number('continued_from'), 's')}; what follows is since then"))
    rows += [
        ("wall time", duration(number("wall_seconds.total"))),
        ("fine cells", fine),
        ("bulk cells", f"{amount(number('cells.bulk'))}, active at most {amount(number('cells.bulk_active_max'))}"),
        ("particles", f"{amount(number('particles.initial'))} at the start, {amount(number('particles.final'))} at the "
                      f"end, {amount(number('particles.lost'))} lost"),
        ("steps", f"{amount(number('steps.windows'))} windows, {amount(number('steps.fluid'))} fluid, "
                  f"{amount(number('steps.particles'))} DEM"),
        ("ranks", f"{amount(number('ranks.fluid'))} fluid, {amount(number('ranks.particles'))} particles"),
        ("peak memory", f"{size(number('peak_memory_bytes.fluid'))} fluid, "
                        f"{size(number('peak_memory_bytes.particles'))} particles"),
    ]
    if number("window.longest"):
        rows.append(("windows", f"{amount(number('window.shortest'), 's')} to {amount(number('window.longest'), 's')}, "
                                f"{amount(number('window.over'))} above the tolerance"))
    if number("relaxation.cells"):
        rows.append(("told a relaxed fluid", f"{amount(number('relaxation.cells'))} bulk cells times windows, factor down "
                                             f"to {amount(number('relaxation.smallest'))}"))
    if number("exchanged.bytes") and number("steps.windows"):
        rows.append(("exchanged", f"{number('exchanged.bytes') / number('steps.windows') / 1e3:.4g} kB per window"))
    rows.append(("machine", f"{machine.get('cpu', 'unknown')}, {machine.get('cores', '?')} cores"))
    rows.append(("demvof", str(run.results.get("version", "unknown"))))
    return rows


def headline(run):
    """A run in one sentence: how far, how long, how well its books close."""
    said = f"{amount(run.last_time, 's')} simulated"
    if run.number("wall_seconds.total"):
        said += f" in {duration(run.number('wall_seconds.total'))}"
    worst = [(name, run.number(f"conservation.{name}")) for name in ("liquid_volume", "solid_volume", "exchange", "momentum")]
    everything = [error for error in (run.results.get("momentum") or {}).get("error") or [] if error is not None]
    worst = [(name + " of particles" * (name == "momentum"), error) for name, error in worst]
    worst += [("momentum of everything", max(everything))] if everything else []
    kept = [f"{name.replace('_', ' ')} {error:.0e}" for name, error in worst if error is not None]
    warnings = len(run.results.get("warnings") or [])
    said += "; conserved to " + ", ".join(kept) if kept else ""
    return said + (f"; {warnings} warning{'s' if warnings > 1 else ''}" if warnings else "") + "."


def conservation(run):
    """[(what, worst relative error)]."""
    words = [("exchange", "impulse given by particles = received by fluid + pending"), ("momentum", "impulses on the particles = change of their momentum"),
             ("solid_volume", "solid volume on the bulk grid = volume of the particles"),
             ("liquid_volume", "liquid volume = liquid volume at the start")]
    return [(text, run.number(f"conservation.{key}")) for key, text in words]


def costs(run):
    """[(what, seconds, share of the total)]: where rank 0 of each side spent the wall time."""
    total = run.number("wall_seconds.total")
    if not total:
        return []
    parts = [("fluid", run.number("wall_seconds.fluid")), ("particles", run.number("wall_seconds.particles")),
             ("averaging, mapping, exchange", run.number("wall_seconds.exchange"))]
    known = sum(seconds or 0 for _, seconds in parts)
    parts.append(("output, start and end", max(0.0, total - known)))
    return [(name, seconds, (seconds or 0) / total) for name, seconds in parts]


def text(runs):
    """The table for the terminal."""
    lines = []
    for run in runs:
        lines += [str(run.folder)] if len(runs) > 1 else []
        lines += [f"{what:<22}{value}" for what, value in summary(run)]
        for what, error in conservation(run):
            if error is not None:
                lines.append(f"{what}: relative error {error:.1e}")
        lines.append("")
    return "\n".join(lines).rstrip() + "\n"


def flat(value, prefix=""):
    """Nested dictionaries as path -> plain value; lists as their text."""
    if isinstance(value, dict):
        return {path: leaf for key, inner in value.items() for path, leaf in flat(inner, f"{prefix}{key}.").items()}
    return {prefix.rstrip("."): value}


def differences(runs):
    """What the configurations differ in: path -> one value per run."""
    settings = [flat(run.configuration) for run in runs]
    paths = dict.fromkeys(path for setting in settings for path in setting)
    columns = {path: [setting.get(path, "-") for setting in settings] for path in paths}
    known = [i for i, run in enumerate(runs) if run.configuration]  # others would differ in everything
    return {path: values for path, values in columns.items() if any(values[i] != values[known[0]] for i in known)}


def write_csv(runs, path):
    """One row per run: its folder, its status, what its configuration differs in, every number of results.json."""
    differing = differences(runs)
    left_out = {"status", "configuration", "scene", "warnings", "failure", "command"}
    numbers = [flat({key: value for key, value in run.results.items() if key not in left_out}) for run in runs]
    names = list(dict.fromkeys(name for row in numbers for name in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["run", "status", *differing, *names])
        for i, run in enumerate(runs):
            settings = [values[i] for values in differing.values()]
            writer.writerow([run.folder, run.status, *settings, *(numbers[i].get(name, "") for name in names)])
