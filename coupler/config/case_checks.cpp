// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/case_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "coupler/config/enum_names.hpp"
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
  void bulk_grid() const;
  void times() const;
  void interchange() const;
  void scene() const;
};

void Checks::files() const {
  if (sound({"fluid.case"})) {
    const fs::path folder = beside_case_file(c, c.fluid.case_folder);
    if (!fs::is_directory(folder))
      add("fluid.case", fmt::format("{}: there is no folder {}", c.fluid.case_folder, folder.string()));
    else if (!fs::is_regular_file(folder / "system" / "controlDict"))
      add("fluid.case", fmt::format("{} is no OpenFOAM case: there is no {}", c.fluid.case_folder,
                                    (folder / "system" / "controlDict").string()));
  }
  if (sound({"particles.script"})) {
    const fs::path script = beside_case_file(c, c.particles->script);
    if (!fs::is_regular_file(script))
      add("particles.script", fmt::format("{}: there is no file {}", c.particles->script, script.string()));
  }
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

void Checks::times() const {
  if (sound({"coupling.end_time", "coupling.window"})) {
    const double end_time = c.coupling.end_time, window = c.coupling.window;
    const double windows = end_time / window;
    constexpr double tolerance = 1e-9;  // relative: the round-off of decimal input
    if (windows < 1 - tolerance)
      add("coupling.end_time", fmt::format("{} s is less than coupling.window, {} s", end_time, window));
    else if (std::abs(windows - std::round(windows)) > tolerance * windows)
      add("coupling.end_time",
          fmt::format("{} s is {:.9g} windows of {} s; give a whole number of windows, e.g. {:.12g}",
                      end_time, windows, window, std::max(1.0, std::round(windows)) * window));
  }
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
  const double largest = spacing / c.coupling.window;
  if (c.coupling.interchange_speed > largest)
    add(key, fmt::format("{} m/s is above {:.6g} m/s, a bulk cell in a window: give 0 to {:.6g}",
                         c.coupling.interchange_speed, largest, largest));
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
  std::string text;
  for (const Mistake& m : mistakes) {
    if (!text.empty()) text += '\n';
    text += m.source.name;
    if (m.source.line > 0 && m.source.line != Source::override_line)
      text += fmt::format(":{}", m.source.line);
    text += (m.key.empty() ? ": " : ": " + m.key + ": ") + m.text;
  }
  return text;
}

void check_case(const CaseParameters& parameters, const std::map<std::string, Source>& sources,
                Mistakes& mistakes) {
  const Checks checks{parameters, sources, mistakes};
  checks.files();
  checks.bulk_grid();
  checks.times();
  checks.interchange();
  checks.scene();
}

}  // namespace demvof
