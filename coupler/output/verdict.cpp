// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace demvof {
namespace {

constexpr auto smaller_steps =
    "What to try: smaller time steps (maxCo in controlDict, coupling.window, the script's timestep).";
constexpr double warned_of = 0.1;  // of a limit
constexpr double most_of_everything = 1e-3;
constexpr double absurd_speed = 1000;  // m/s: no flow of incompressible fluids

/// Weighs one number against its limit. That it is no number is beyond every limit.
/// explained: the section that explains the warning.
void weigh(Verdict& verdict, const std::string& key, double value, double limit, const std::string& said,
           const char* explained) {
  if (!(value <= limit) && !verdict.failure)
    verdict.failure = fmt::format("{} ({}: {:g})", said, key, limit);
  else if (!(value <= warned_of * limit))
    verdict.warnings.push_back(said + " " + explained);
}

/// Momentum of everything, which has no limit: meshes of unequal cells open it by themselves.
void weigh_everything(Verdict& verdict, const RunResults& results) {
  constexpr double at_rest = 1e-15;  // kg m/s: round-off against round-off
  if (!results.momentum || results.momentum->judged() == 0 || results.momentum->scale() < at_rest) return;
  const Vec3& errors = results.momentum->worst();
  const double worst = std::max({errors.x, errors.y, errors.z});
  if (worst <= most_of_everything) return;
  verdict.warnings.push_back(fmt::format(
      "momentum.error is {:.2g}: the momentum of fluid and particles together changed by more than "
      "the impulses from outside that are known. Cells that are no equal hexahedra, outer correctors "
      "that do not converge, a patch where the void fraction is given, boundary conditions with "
      "forces of their own (docs/warnings.md, Momentum that came or went)",
      worst));
}

}  // namespace

Verdict judge(const RunResults& results, const LimitParameters& limits, const Fastest& fastest,
              bool exchange_closes) {
  Verdict verdict;
  const auto& errors = results.conservation;
  const char* books = "(docs/warnings.md, Momentum that came or went)";
  if (exchange_closes)
    weigh(verdict, "limits.books", errors.exchange, limits.books,
          fmt::format("conservation.exchange is {:.2g}: the momentum that passed between particles and fluid "
                      "does not add up. {}",
                      errors.exchange, smaller_steps),
          books);
  weigh(
      verdict, "limits.books", errors.momentum, limits.books,
      fmt::format("conservation.momentum is {:.2g}: the particles' momentum changed by more than the forces "
                  "on them. What to try: a script without commands that change particles beside forces (fix "
                  "adapt of sizes, velocity, set); else smaller time steps.",
                  errors.momentum),
      books);
  if (exchange_closes) weigh_everything(verdict, results);
  const char* volume = "(docs/warnings.md, Volume that came or went)";
  weigh(
      verdict, "limits.volume", errors.solid_volume, limits.volume,
      fmt::format("conservation.solid_volume is {:.2g}: volume came or went between particles, bulk grid and "
                  "mesh. What to try: coupling.mapping.to_fine: conservative, a bulk grid inside the mesh",
                  errors.solid_volume),
      volume);
  weigh(verdict, "limits.volume", errors.liquid_volume, limits.volume,
        fmt::format("conservation.liquid_volume is {:.2g}: volume came or went, if not through an open "
                    "boundary, then wrongly",
                    errors.liquid_volume),
        volume);
  weigh(verdict, "limits.courant", fastest.courant, limits.courant,
        fmt::format("the fluid crossed up to {:.3g} cells in a step: what is that fast is not resolved in "
                    "time. {}",
                    fastest.courant, smaller_steps),
        "(docs/warnings.md, Courant number)");
  weigh(verdict, "an incompressible fluid, m/s", fastest.speed, absurd_speed,
        fmt::format("the fluid reached {:.3g} m/s. {}", fastest.speed, smaller_steps),
        "(docs/warnings.md, Fast fluid)");
  const long all = results.particles.initial + results.particles.inserted, lost = results.particles.lost;
  const double share = all > 0 ? static_cast<double>(lost) / static_cast<double>(all) : 0;
  const std::string said = fmt::format(
      "{} of {} particles were lost: they left the box where the script has no outlet. If they "
      "should not: a smaller timestep in the script, stiffer contacts, walls where the box ends",
      lost, all);
  const char* lost_particles = "(docs/warnings.md, Lost particles)";
  weigh(verdict, "limits.lost_particles", share, limits.lost_particles, said, lost_particles);
  if (lost > 0 && share <= warned_of * limits.lost_particles)
    verdict.warnings.push_back(said + " " + lost_particles);
  return verdict;
}

std::string find_nonsense(const std::vector<std::pair<std::string, double>>& quantities) {
  for (const auto& [name, value] : quantities)
    if (!std::isfinite(value))
      return fmt::format(
          "{} is not a number any more: the flow or the particles had left what is physical.\n{}", name,
          smaller_steps);
  return "";
}

}  // namespace demvof
