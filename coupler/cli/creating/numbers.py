# SPDX-License-Identifier: GPL-3.0-or-later
"""Bulk grid, window and forces: from what `demvof check` says of mesh and particles.

  bulk cells   3 diameters of the largest particle, at least as wide as a fine cell
  window       no longer than the fluid's step may be (maxDeltaT, Courant and capillary limits of the start), and than a
               tenth of the time in which something that fell through the box crosses a bulk cell; whole DEM steps
  forces       drag that knows the void fraction where there is a bed, else that of a single sphere; the pressure gradient;
               added mass where a particle is lighter than the liquid
"""
import dataclasses
import math
import re

WIDTH = 3.0  # of a bulk cell in diameters
CROSSING = 0.1  # of the time in which a bulk cell is crossed


@dataclasses.dataclass(frozen=True)
class Numbers:
    diameter: float = 0.0       # of the largest particle, m; 0: not known yet
    dem_step: float = 0.0       # s; 0: not known yet
    fluid_step: float = 0.0     # the longest, s; 0: not known
    drag: str = "schiller_naumann"
    added_mass: bool = False
    # Chosen:
    cells: tuple = (1, 1, 1)
    window_steps: int = 0       # DEM steps in a window
    window: float = 1e-4        # s
    windows: int = 1            # in the run


def widest_fine_cell(fluid):
    return (math.prod(b - a for a, b in zip(fluid.lower, fluid.upper)) / fluid.cells) ** (1 / 3)


def times_in(said, label):
    """Every "(x s)" behind the label."""
    return [float(value) for value in re.findall(rf"of {label} \(([-+.\deE]+) s\)", said)]


def asked(said, numbers):
    """The numbers with what check has said."""
    found = {}
    particles = re.search(r"^particles +\d+ at the start, (?:\S+ to )?(\S+) m$", said, re.MULTILINE)
    if particles:
        found["diameter"] = float(particles[1])
    step = (re.search(r"whole number of DEM steps of (\S+) s", said)
            or re.search(r"^DEM steps +\d+ of (\S+) s", said, re.MULTILINE))
    if step:
        found["dem_step"] = float(step[1])
    limits = [time for label in ("the Courant limit", "maxDeltaT", "a capillary wave") for time in times_in(said, label)]
    if limits:
        found["fluid_step"] = min(limits)
    law = re.search(r"laws that know it are (\w+)", said)
    if law:
        found["drag"] = law[1]
    if "without added_mass" in said:
        found["added_mass"] = True
    return dataclasses.replace(numbers, **found)


def choose(fluid, numbers):
    """The same with cells and window for what is known."""
    extents = [b - a for a, b in zip(fluid.lower, fluid.upper)]
    if numbers.diameter > 0:
        width = max(WIDTH * numbers.diameter, widest_fine_cell(fluid))
        cells = tuple(max(1, math.floor(extent / width + 1e-9)) for extent in extents)
    else:
        cells = tuple(max(1, round(extent / widest_fine_cell(fluid))) for extent in extents)
    spacing = min(extent / n for extent, n in zip(extents, cells))
    fastest = math.sqrt(2 * max(fluid.gravity, 1e-3) * max(extents))
    longest = min([CROSSING * spacing / fastest] + [time for time in [numbers.fluid_step] if time > 0])
    end_time = fluid.end_time if fluid.end_time > 0 else 1.0
    if numbers.dem_step > 0:
        steps = max(1, math.floor(longest / numbers.dem_step * (1 + 1e-9)))
        window = float(f"{steps * numbers.dem_step:.9g}")
    else:
        steps, window = 0, float(f"{longest:.1e}")
    return dataclasses.replace(numbers, cells=cells, window_steps=steps, window=window,
                               windows=max(1, round(end_time / window)))
