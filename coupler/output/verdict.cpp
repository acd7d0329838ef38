// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/verdict.hpp"

#include <fmt/format.h>

#include <cmath>

namespace demvof {
namespace {

// Exchange and momentum close to round-off in every run that is right; fixes of a script may take some of the
// particles' momentum. The volumes depend on meshes and, for the liquid, on what goes through open
// boundaries.
constexpr double worst_books = 0.01;                      // relative
constexpr double fast_courant = 5, absurd_courant = 100;  // cells per step

constexpr auto smaller_steps =
    "What to try: smaller time steps (maxCo in controlDict, coupling.window, the script's timestep).";

}  // namespace

Verdict judge(const RunResults& results, double largest_courant, bool exchange_closes) {
  Verdict verdict;
  const auto fail = [&verdict](const std::string& why) {
    if (!verdict.failure) verdict.failure = why;
  };
  if (const long lost = results.particles.lost; lost > 0)
    verdict.warnings.push_back(
        fmt::format("{} of {} particles were lost: they left the box where the script has no outlet. If they "
                    "should not: a "
                    "smaller timestep in the script, stiffer contacts, walls where the box ends "
                    "(docs/warnings.md, Lost particles)",
                    lost, results.particles.initial + results.particles.inserted));
  const auto& errors = results.conservation;
  if (exchange_closes && !(errors.exchange <= worst_books))
    fail(fmt::format(
        "conservation.exchange is {:.2g}: the momentum that passed between particles and fluid does not add "
        "up. {}",
        errors.exchange, smaller_steps));
  if (!(errors.momentum <= worst_books))
    fail(fmt::format(
        "conservation.momentum is {:.2g}: the particles' momentum changed by more than the forces on them. "
        "What to try: a script without commands that change particles beside forces (fix adapt of sizes, "
        "velocity, set); else smaller time steps.",
        errors.momentum));
  for (const auto& [name, error] :
       {std::pair("solid_volume", errors.solid_volume), std::pair("liquid_volume", errors.liquid_volume)})
    if (!(error <= worst_books))
      verdict.warnings.push_back(fmt::format(
          "conservation.{} is {:.2g}: volume came or went{} (docs/warnings.md, Volume that came or went)",
          name, error,
          std::string(name) == "liquid_volume" ? ", if not through an open boundary, then wrongly"
                                               : " between particles, bulk grid and mesh"));
  if (!(largest_courant <= fast_courant))
    verdict.warnings.push_back(
        fmt::format("the fluid crossed up to {:.3g} cells in a step: what is that fast is not resolved in "
                    "time (docs/warnings.md, Courant number)",
                    largest_courant));
  if (!(largest_courant <= absurd_courant))
    fail(fmt::format("the fluid crossed up to {:.3g} cells in a step: the flow had left what is physical. {}",
                     largest_courant, smaller_steps));
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
