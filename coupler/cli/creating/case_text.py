# SPDX-License-Identifier: GPL-3.0-or-later
"""The case file that `demvof new` writes."""


def case_text(name, script_name, prepare, fluid, numbers):
    lower, upper = (", ".join(f"{value:.12g}" for value in corner) for corner in (fluid.lower, fluid.upper))
    spacing = min((b - a) / n for a, b, n in zip(fluid.lower, fluid.upper, numbers.cells))
    width = f"{spacing:.3g} m" + (f", {spacing / numbers.diameter:.2g} particle diameters" if numbers.diameter > 0 else "")
    of_run = numbers.windows * numbers.window
    # Outputs that fall on ends of windows.
    per_output = max(1, round((fluid.write_interval or of_run / 10) / numbers.window))
    added = ("  - added_mass: 0.5                   # they are lighter than the liquid" if numbers.added_mass
             else "# - added_mass: 0.5                   # needed for particles lighter than the liquid")
    limit = (f"the fluid's step at the start may be {numbers.fluid_step:.3g} s" if numbers.fluid_step > 0
             else "no limit of the fluid's step is known")
    return f"""# {name}: made by `demvof new`; every number here is a proposal. Check it: demvof check case.yaml
# SI units. Every key and its default: docs/case_file.md; how to choose: docs/howto_your_own_case.md.

fluid:
  case: fluid                           # a copy; the original is as it was
  prepare: [{', '.join(prepare)}]
  # ranks: 2

particles:
  script: particles/{script_name}
  # ranks: 2

bulk_grid:                              # the box of the mesh, in cells of {width}; 2 to 4 are right
  lower: [{lower}]
  upper: [{upper}]
  cells: [{', '.join(map(str, numbers.cells))}]

coupling:
  end_time: {of_run:.12g}                     # a whole number of windows; controlDict's endTime is {fluid.end_time:.9g} s
  window: {numbers.window:.9g}                       # {numbers.window_steps} DEM steps of {numbers.dem_step:.3g} s; {limit}.
                                        # Shorter where particles go faster than a tenth of a bulk cell in it.
                                        # Or as long as their error allows:
  # window: {{tolerance: 5.0e-3, shortest: {numbers.window:.9g}, longest: {8 * numbers.window:.9g}}}
  # schedule: concurrent                # both sides at the same time

forces:                                 # what is not named is off
  - drag: {numbers.drag}
  - pressure_gradient                   # buoyancy is in it
{added}
# - lift: saffman_mei
# - viscous_stress

output:
  interval: {per_output * numbers.window:.9g}                        # fields, particles, and states to continue from
  # pictures: [0, {of_run / 2:.4g}, {of_run:.4g}]       # times in report.html
"""
