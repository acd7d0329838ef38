// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/case_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "coupler/base/printable.hpp"
#include "coupler/config/enum_names.hpp"
#include "coupler/config/keys.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

/// The checks' view of the case: what was given, what is wrong already, and a place for more.
struct Checks {
  const CaseParameters& c;
  const std::map<std::string, Source>& sources;
  Mistakes& mistakes;

  /// All these keys are given, and none of them is wrong.
  bool sound(const std::vector<std::string>& keys) const {
    return std::all_of(keys.begin(), keys.end(), [&](const std::string& key) {
      return sources.count(key) &&
             std::none_of(mistakes.begin(), mistakes.end(), [&](const Mistake& m) { return m.key == key; });
    });
  }
  void add(const std::string& key, const std::string& text) const {
    mistakes.push_back({sources.at(key), key, text});
  }

  void files() const;
  void ranges() const;
  void bulk_grid() const;
  void times() const;
  void adaptive_window() const;
  void order() const;
  void interchange() const;
  void films() const;
  void scene() const;
};

void Checks::files() const {
  if (sound({"fluid.case"})) {
    const fs::path folder = beside_case_file(c, c.fluid.case_folder);
    std::error_code none;  // a name may be too long for the system to ask
    if (!fs::is_directory(folder, none))
      add("fluid.case", fmt::format("{}: there is no folder {}", c.fluid.case_folder, folder.string()));
    else if (!fs::is_regular_file(folder / "system" / "controlDict", none))
      add("fluid.case", fmt::format("{} is no OpenFOAM case: there is no {}", c.fluid.case_folder,
                                    (folder / "system" / "controlDict").string()));
  }
  if (sound({"particles.script"})) {
    const fs::path script = beside_case_file(c, c.particles->script);
    std::error_code none;
    if (!fs::is_regular_file(script, none))
      add("particles.script", fmt::format("{}: there is no file {}", c.particles->script, script.string()));
  }
}

/// Numbers that no run can mean, and that would overflow on the way.
void Checks::ranges() const {
  struct Range {
    const char* key;
    double smallest, largest;  // of magnitudes that are not 0
  };
  static constexpr Range reasonable[] = {{"coupling.end_time", 1e-12, 1e9},
                                         {"coupling.window", 1e-12, 1e9},
                                         {"coupling.window.tolerance", 1e-12, 1e6},
                                         {"coupling.window.shortest", 1e-12, 1e9},
                                         {"coupling.window.longest", 1e-12, 1e9},
                                         {"coupling.time_out", 1e-3, 1e9},
                                         {"coupling.interchange_speed", 1e-12, 1e6},
                                         {"coupling.averaging.width", 1e-12, 1e6},
                                         {"coupling.averaging.bandwidth", 1e-12, 1e6},
                                         {"coupling.averaging.maximum_solid_fraction", 1e-3, 1},
                                         {"bulk_grid.lower", 0, 1e6},
                                         {"bulk_grid.upper", 0, 1e6},
                                         {"output.interval", 1e-12, 1e9},
                                         {"output.history_interval", 1e-12, 1e9}};
  for (const auto& [name, smallest, largest] : reasonable) {
    if (!sound({name})) continue;
    const Key& key = *find_key(name);
    const Json given = key.get(c);
    for (const Json& value : given.is_array() ? given : Json::array({given}))
      if (const double size = std::abs(value.get<double>());
          size != 0 && !(smallest <= size && size <= largest)) {
        add(name, fmt::format("{} is beyond reason: magnitudes from {} to {} ({})", value.get<double>(),
                              smallest, largest, key.rule.unit));
        break;
      }
  }
  constexpr double most_cells = 1e9;
  if (!sound({"bulk_grid.cells"})) return;
  const auto& n = c.bulk_grid->cells;
  const double cells = static_cast<double>(n[0]) * n[1] * n[2];
  if (cells > most_cells)
    add("bulk_grid.cells",
        fmt::format("{:g} cells in all; give at most {:g}, of 2 to 4 particle diameters each", cells,
                    most_cells));
}

void Checks::bulk_grid() const {
  if (sound({"particles"}) && !sources.count("bulk_grid"))
    add("particles", "particles need a section bulk_grid: {lower, upper, cells}");
  if (!sound({"bulk_grid.lower", "bulk_grid.upper"})) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = c.bulk_grid->lower[axis], upper = c.bulk_grid->upper[axis];
    if (!(lower < upper))
      add("bulk_grid.upper",
          fmt::format("{} in direction {} is not above bulk_grid.lower, {} (m)", upper, "xyz"[axis], lower));
  }
}

void Checks::adaptive_window() const {
  const AdaptiveWindow& window = *c.coupling.adaptive_window;
  const std::string longest = "coupling.window.longest", shortest = "coupling.window.shortest";
  if (sound({longest, shortest}) && window.longest < window.shortest)
    add(longest, fmt::format("{} s is less than shortest, {} s", window.longest, window.shortest));
  if (sound({"coupling.end_time", shortest}) && c.coupling.end_time < window.shortest)
    add("coupling.end_time",
        fmt::format("{} s is less than {}, {} s", c.coupling.end_time, shortest, window.shortest));
  if (sound({"coupling.schedule"}) && c.coupling.schedule == Schedule::concurrent)
    add("coupling.schedule",
        "concurrent needs windows of one length, a number for coupling.window: the fluid feels in each what "
        "the "
        "particles did in the one before, and in a shorter one their impulse would be a larger force");
}

void Checks::times() const {
  if (c.coupling.adaptive_window) {
    adaptive_window();
  } else if (sound({"coupling.end_time", "coupling.window"})) {
    const double end_time = c.coupling.end_time, window = c.coupling.window;
    const double windows = end_time / window;
    constexpr double tolerance = 1e-9;  // relative: the round-off of decimal input
    constexpr double most_windows = 1e12;
    if (windows > most_windows)
      add("coupling.window",
          fmt::format("{} s is less than end_time, {} s, over {:g}: so many windows have no end", window,
                      end_time, most_windows));
    else if (windows < 1 - tolerance)
      add("coupling.end_time", fmt::format("{} s is less than coupling.window, {} s", end_time, window));
    else if (std::abs(windows - std::round(windows)) > tolerance * windows)
      add("coupling.end_time",
          fmt::format("{} s is {:.9g} windows of {} s; give a whole number of windows, e.g. {:.12g}",
                      end_time, windows, window, std::max(1.0, std::round(windows)) * window));
  }
}

void Checks::order() const {
  if (!sound({"coupling.order"}) || c.coupling.order == 1) return;
  if (c.coupling.schedule == Schedule::concurrent)
    add("coupling.order",
        "2 needs coupling.schedule: staggered: a fluid that gets in a window what the particles did in the "
        "one "
        "before is of order 1 whatever they are told");
  if (c.coupling.exchange != ExchangeScheme::conservative_implicit)
    add("coupling.order",
        "2 needs coupling.exchange: conservative_implicit, which foresees the particles' answer");
}

void Checks::interchange() const {
  const PhaseInterchange how = c.coupling.phase_interchange;
  const bool liquid_particles =
      how == PhaseInterchange::volume_adding || how == PhaseInterchange::replacement;
  if (sound({"coupling.phase_interchange"}) && liquid_particles) {
    if (c.coupling.schedule == Schedule::concurrent)
      add("coupling.phase_interchange",
          name_of(how) + " needs coupling.schedule: staggered, the fluid in the window of its particles");
    const AveragingParameters& averaging = c.coupling.averaging;
    if (how == PhaseInterchange::replacement && averaging.kernel == Kernel::diffusion)
      add("coupling.phase_interchange",
          "replacement needs a kernel that knows what one particle displaces: any but diffusion");
    if (how == PhaseInterchange::volume_adding && c.fluid.refinement)
      add("coupling.phase_interchange",
          "volume_adding needs a mesh that stays as it is: no fluid.refinement");
    if (how == PhaseInterchange::replacement && c.fluid.refinement && !c.fluid.refinement->particles)
      add("coupling.phase_interchange",
          "replacement needs fine cells wherever a particle may become liquid: fluid.refinement.particles: "
          "true");
  }
  const std::string key = "coupling.interchange_speed";
  if (!sound({key, "coupling.window", "bulk_grid.lower", "bulk_grid.upper", "bulk_grid.cells"})) return;
  double spacing = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    spacing =
        std::min(spacing, (c.bulk_grid->upper[axis] - c.bulk_grid->lower[axis]) / c.bulk_grid->cells[axis]);
  if (!(c.coupling.longest_window() > 0)) return;
  const double largest = spacing / c.coupling.longest_window();
  if (c.coupling.interchange_speed > largest)
    add(key, fmt::format("{} m/s is above {:.6g} m/s, a bulk cell in a window: give 0 to {:.6g}",
                         c.coupling.interchange_speed, largest, largest));
}

void Checks::films() const {
  if (!c.forces.lubrication) return;
  const auto& [cut_off, roughness, suction] = *c.forces.lubrication;
  if (roughness < cut_off) return;
  for (const char* name : {"forces.lubrication.roughness", "forces.lubrication.cut_off"})
    if (sound({name}))
      return add(name,
                 fmt::format("films act between roughness, {}, and cut_off, {}: the second has to be above "
                             "the first",
                             roughness, cut_off));
}

void Checks::scene() const {
  if (sound({"scene.particles"}) && c.scene.particles == Switch::on && !c.particles)
    add("scene.particles", "on is impossible: the case has no section particles");
  const bool particles = c.particles && c.scene.particles != Switch::off;
  if (sound({"scene.porosity"}) && c.scene.porosity == Switch::on && !particles)
    add("scene.porosity", "on is impossible without particles");
}

}  // namespace

std::string report(Mistakes mistakes) {
  std::stable_sort(mistakes.begin(), mistakes.end(),
                   [](const Mistake& a, const Mistake& b) { return a.source.line < b.source.line; });
  constexpr std::size_t most_lines = 50;
  const std::size_t left_out = mistakes.size() > most_lines ? mistakes.size() - most_lines : 0;
  mistakes.resize(mistakes.size() - left_out);
  std::string text;
  for (const Mistake& m : mistakes) {
    if (!text.empty()) text += '\n';
    text += m.source.name;
    if (m.source.line > 0 && m.source.line != Source::override_line)
      text += fmt::format(":{}", m.source.line);
    text += (m.key.empty() ? ": " : ": " + cut(printable(m.key), 200) + ": ") + cut(printable(m.text), 2000);
  }
  if (left_out > 0) text += fmt::format("\n... and {} more mistakes", left_out);
  return text;
}

void check_case(const CaseParameters& parameters, const std::map<std::string, Source>& sources,
                Mistakes& mistakes) {
  const Checks checks{parameters, sources, mistakes};
  checks.files();
  checks.ranges();
  checks.bulk_grid();
  checks.times();
  checks.order();
  checks.interchange();
  checks.films();
  checks.scene();
}

}  // namespace demvof
