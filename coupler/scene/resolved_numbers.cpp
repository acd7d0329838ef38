// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/scene/resolved_numbers.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace demvof {

std::string numbers_table(const ResolvedNumbers& n) {
  std::string table;
  const auto row = [&table](const std::string& label, const std::string& value) {
    table += fmt::format("{:<12}  {}\n", label, value);
  };
  if (n.windows > 0) row("windows", fmt::format("{} of {:.4g} s", n.windows, n.window));
  if (n.longest_window > 0)
    row("windows", fmt::format("of {:.4g} to {:.4g} s, as their error allows", n.window, n.longest_window));
  const auto limits = [&row](const std::vector<std::pair<const char*, double>>& times, double step) {
    std::string line;
    for (const auto& [name, time] : times)
      if (time > 0)
        line += fmt::format("{}{:.2g} of {} ({:.3g} s)", line.empty() ? "" : ", ", step / time, name, time);
    if (!line.empty()) row("", line);
  };
  if (n.fluid_steps > 0) {
    row("fluid steps",
        fmt::format("{} of {:.4g} s in the first window (k)", n.fluid_steps, n.fluid_time_step));
    limits({{"the Courant limit", n.courant_step},
            {"maxDeltaT", n.longest_step},
            {"a capillary wave", n.capillary_step}},
           n.fluid_time_step);
  }
  if (n.dem_steps > 0) {
    row("DEM steps", fmt::format("{} of {:.4g} s in {} window (n)", n.dem_steps, n.dem_time_step,
                                 n.longest_window > 0 ? "the first" : "each"));
    limits({{"a collision", n.collision_time},
            {"a Rayleigh wave", n.rayleigh_time},
            {"drag m/beta", n.drag_time}},
           n.dem_time_step);
  }
  row("fine cells", fmt::format("{} at the start", n.fine_cells));
  if (n.particles > 0) {
    const double diameter = n.max_diameter;
    row("bulk cells",
        fmt::format("{}, {:.3g} particle diameters wide", n.bulk_cells, n.bulk_spacing / diameter));
    row("particles",
        n.min_diameter < diameter
            ? fmt::format("{} at the start, {:.4g} to {:.4g} m", n.particles, n.min_diameter, diameter)
            : fmt::format("{} at the start, {:.4g} m", n.particles, diameter));
  }
  return table;
}

}  // namespace demvof
