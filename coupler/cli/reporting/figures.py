# SPDX-License-Identifier: GPL-3.0-or-later
"""The report's figures; each function returns a matplotlib figure, or None when there is nothing to draw."""
import functools
import math

import matplotlib

matplotlib.use("Agg")
import numpy  # noqa: E402
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection  # noqa: E402
from matplotlib.colors import LinearSegmentedColormap, Normalize  # noqa: E402
from matplotlib.text import Text  # noqa: E402, F401 (page.image asks for the size of the smallest)

from reporting import fields  # noqa: E402
from reporting.run import read_reference  # noqa: E402

pyplot.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
                        "grid.color": "#e2e6ea", "grid.linewidth": 0.8, "axes.axisbelow": True,
                        "legend.frameon": False, "legend.fontsize": 9, "lines.linewidth": 1.6,
                        "figure.max_open_warning": 0})
COLOURS = ["#1f6fb2", "#d9641e", "#3a9a5b", "#8a55b4", "#5b6670", "#c23b58"]
WATER = LinearSegmentedColormap.from_list("water", ["#f7fafc", "#a9cdea"])
SPEED = pyplot.get_cmap("inferno")
SIZE = (4.2, 3.0)  # inches; shown 360 px wide or wider: 9 points are 10.7 px there

# Quantities that belong in one figure: (title, names, kind of axis). Of a constant only its change is worth a look.
LINEAR, LOGARITHMIC, CHANGE = "linear", "logarithmic", "change"
GROUPS = [
    ("Energy", ["mechanical_energy", "potential_energy", "kinetic_energy", "particle_potential_energy",
                "particle_kinetic_energy"], LINEAR),
    ("Kinetic over initial potential energy of the fluids", ["kinetic_energy_ratio"], LINEAR),
    ("Integral of u.u", ["velocity_squared_integral", "velocity_squared_integral_liquid",
                         "velocity_squared_integral_gas", "velocity_squared_integral_x"], LOGARITHMIC),
    ("Largest fluid speed", ["max_speed"], LINEAR),
    ("Where the largest speed is", ["max_speed_x", "max_speed_y", "max_speed_z"], LINEAR),
    ("Integral of p squared", ["pressure_squared_integral"], LOGARITHMIC),
    ("Fronts", ["liquid_front", "solid_front"], LINEAR),
    ("Mean level", ["mean_level"], LINEAR),
    ("Liquid volume, relative change", ["liquid_volume"], CHANGE),
    ("Liquid held in interface cells", ["liquid_in_interface_cells"], LINEAR),
    ("Solid volume on the mesh, relative change", ["solid_volume_mesh"], CHANGE),
    ("Particles", ["particles"], LINEAR),
    ("Momentum of the fluids", ["fluid_momentum_x", "fluid_momentum_y", "fluid_momentum_z"], LINEAR),
    ("Momentum of the particles", ["particle_momentum_x", "particle_momentum_y", "particle_momentum_z"], LINEAR),
    ("Momentum owed between them", ["pending_momentum_x", "pending_momentum_y", "pending_momentum_z"], LINEAR),
]
WINDOWS = [  # what is decided from window to window
    ("Length of the windows", ["window"], LOGARITHMIC),
    ("Error of the windows over what is allowed", ["window_error"], LOGARITHMIC),
    ("Bulk cells averaged and exchanged", ["active_bulk_cells"], LINEAR),
    ("Smallest relaxation factor of what particles are told", ["smallest_relaxation"], LINEAR),
    ("Fine cells", ["fine_cells"], LINEAR),
]


def picture_times(run, available):
    """Which of the times with fields are shown: those asked for, else begin, four between, end."""
    if not available:
        return []
    wanted = run.setting("output.pictures") or list(numpy.linspace(available[0], available[-1], 6))
    last = run.last_time if run.last_time is not None else available[-1]
    chosen = {min(available, key=lambda t: abs(t - time)) for time in wanted if time <= last * (1 + 1e-9)}
    return sorted(chosen)


@functools.cache
def shown_times(run):
    """picture_times of what the run left. Throws RuntimeError when there is nothing at all."""
    times = picture_times(run, fields.read(run.folder))
    if not times:
        raise RuntimeError("the run left no time folders")
    return times


def read_sections(run):
    """The mid-plane at the times shown, {time: Section}; the largest speed of a particle in them (None without
    particles); the reasons why a time is missing. Throws RuntimeError when there is nothing at all."""
    times = shown_times(run)
    sections, reasons = {}, []
    for time in times:
        try:
            sections[time] = fields.read(run.folder, time)
        except RuntimeError as error:  # a time folder that the run did not finish
            reasons.append(str(error))
    if not sections:
        raise RuntimeError("; ".join(reasons))
    fastest = max((section.speeds.max() for section in sections.values() if len(section.speeds)), default=None)
    return sections, fastest, reasons


def pictures(run):
    """The surface and the particles on the mid-plane: [(time, figure)], a line that says what is shown, and what
    could not be."""
    sections, fastest, reasons = read_sections(run)
    some = next(iter(sections.values()))
    caption = (f"Cut through the middle ({some.normal} = {some.position:.4g} m). Blue: liquid fraction; line: where it "
               "is 0.5.")
    if fastest is not None:
        caption += (" Discs: particles within one diameter of the plane; dark to bright: speed from 0 to "
                    f"{fastest:.3g} m/s.")
    return [(time, picture(section, fastest)) for time, section in sections.items()], caption, reasons


def panel_size(section, width):
    """Inches: the plane's shape, within reason."""
    size = section.upper - section.lower
    return width, min(2.2 * width, max(0.45 * width, width * size[1] / size[0]))


def picture(section, fastest):
    figure, axes = pyplot.subplots(figsize=panel_size(section, 3.2))
    draw(axes, section, fastest)
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.99)
    return figure


def strip(run):
    """All pictures of a run side by side, with their times."""
    sections, fastest, _ = read_sections(run)
    width, height = panel_size(next(iter(sections.values())), 2.0)
    figure, panels = pyplot.subplots(1, len(sections), figsize=(width * len(sections), height + 0.3), squeeze=False,
                                     layout="constrained")
    for axes, (time, section) in zip(panels[0], sections.items()):
        draw(axes, section, fastest)
        axes.set_title(f"{time:.2g} s", fontsize=10)
    return figure


def draw(axes, section, fastest):
    axes.add_collection(PolyCollection(section.polygons, array=section.liquid, cmap=WATER, norm=Normalize(0, 1),
                                       edgecolors="face", linewidths=0.2))
    axes.add_collection(LineCollection(section.surface, colors=COLOURS[0], linewidths=1.1))
    if len(section.radii):
        diameters = 2 * section.radii
        axes.add_collection(EllipseCollection(
            diameters, diameters, numpy.zeros(len(diameters)), units="xy", offsets=section.centres,
            offset_transform=axes.transData, array=section.speeds, cmap=SPEED, norm=Normalize(0, max(fastest, 1e-12)),
            edgecolors="#222222", linewidths=0.2))
    axes.set_xlim(section.lower[0], section.upper[0])
    axes.set_ylim(section.lower[1], section.upper[1])
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.add_patch(pyplot.Rectangle((0, 0), 1, 1, transform=axes.transAxes, fill=False, edgecolor="#8a949e"))


def fronts(runs):
    """Fronts against dimensionless time, T = t sqrt(2 g / a), a: the width of the column at the start."""
    figure, axes = pyplot.subplots(figsize=SIZE, layout="constrained")
    drawn = False
    for run in runs:
        gravity, start = numpy.linalg.norm(run.gravity), (run.setting("bulk_grid.lower") or [0.0])[0]
        liquid = run.history.get("liquid_front")
        if liquid is None or not len(liquid) or not gravity or not liquid[0] > start:
            continue
        a = liquid[0] - start
        label = f" ({run.name})" if len(runs) > 1 else ""
        for name, style in (("liquid_front", "-"), ("solid_front", "--")):
            if name in run.history:
                colour = COLOURS[runs.index(run) % len(COLOURS)] if len(runs) > 1 else COLOURS["ls".index(name[0])]
                axes.plot(run.times * math.sqrt(2 * gravity / a), (run.history[name] - start) / a, style, color=colour,
                          label=name.replace("_", " ") + label)
        drawn = True
    reference = runs[0].reference_files("*front*.csv")
    if not drawn:
        return None
    for path in reference:
        _, columns = read_reference(path)
        if {"T", "Z"} <= columns.keys():
            axes.plot(columns["T"], columns["Z"], "o", color="#222222", markersize=4, markerfacecolor="white",
                      label=path.stem.replace("_", " "))
            axes.set_xlim(0, 1.5 * columns["T"].max())
    axes.set_xlabel("t sqrt(2 g / a)")
    axes.set_ylabel("front / a")
    axes.legend()
    return figure


def histories(runs):
    """[(title, figure)]: what the runs recorded, but for WINDOWS."""
    known = {name for _, names, _ in GROUPS + WINDOWS for name in names}
    rest = [name for run in runs for name in run.history if name not in known and name != "time"]
    return grouped(runs, GROUPS + [(name.replace("_", " "), [name], LINEAR) for name in dict.fromkeys(rest)])


def grouped(runs, groups):
    """[(title, figure)]: quantities that belong together in one figure."""
    made = []
    for title, names, axis in groups:
        if len(runs) > 1:  # one quantity, several runs
            parts = [(name.replace("_", " "), [name]) for name in names]
        else:
            parts = [(title, names)]
        for part_title, part_names in parts:
            figure = history(runs, part_names, axis)
            if figure:
                made.append((part_title, figure))
    return made


def history(runs, names, axis):
    curves = [(run, name) for run in runs for name in names if len(run.history.get(name, [])) > 0]
    if not curves:
        return None
    figure, axes = pyplot.subplots(figsize=SIZE, layout="constrained")
    for i, (run, name) in enumerate(curves):
        label = run.name if len(runs) > 1 else name.replace("_", " ")
        values = run.history[name]
        if axis == CHANGE and values[0] != 0:
            values = values / values[0] - 1
        axes.plot(run.times, values, color=COLOURS[i % len(COLOURS)], label=label)
    unit = "-" if axis == CHANGE else curves[0][0].units.get(curves[0][1], "-")
    axes.set_xlabel("t [s]")
    axes.set_ylabel(f"[{unit}]" if unit != "-" else "")
    if axis == LOGARITHMIC and any((run.history[name] > 0).any() for run, name in curves):
        axes.set_yscale("log")
    if len(curves) > 1:
        axes.legend()
    return figure
