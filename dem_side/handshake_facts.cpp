// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/handshake_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "coupler/base/errors.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/first_look.hpp"
#include "dem_side/report.hpp"

namespace demvof {
namespace {

/// Those that walls of the fluid have to go along with: "name (style)".
std::vector<std::string> surfaces_of_both(const std::vector<MovedSurface>& moved,
                                          const std::vector<std::string>& unseen) {
  std::vector<std::string> names, both;
  for (const auto& [fix, style] : moved) {
    names.push_back(fix);
    if (std::find(unseen.begin(), unseen.end(), fix) == unseen.end())
      both.push_back(fmt::format("{} ({})", fix, style));
  }
  for (const std::string& fix : unseen)
    if (std::find(names.begin(), names.end(), fix) == names.end())
      throw InputError(
          fmt::format("particles.unseen_surfaces: {}: no fix of this name moves a surface of the script{}{}",
                      fix, names.empty() ? "" : "; it has ", fmt::join(names, ", ")));
  return both;
}

}  // namespace

std::string handshake_facts(const Dem& dem, const FluidForces& forces, double largest_solid_fraction,
                            const std::vector<std::string>& unseen_surfaces, int ranks) {
  std::vector<std::string> closures;  // in the order of ParticleReport::closures
  for (const auto& [name, count] : forces.closures()) closures.push_back(name);

  const ParticleCensus census = dem.census();
  const ContactTimes contacts = dem.contact_times();
  const Vec3 momentum = half_step_momentum(dem);
  return nlohmann::json{{"particle_count", census.whole},
                        {"min_diameter", census.min_diameter},
                        {"max_diameter", census.max_diameter},
                        {"solid_volume", census.solid_volume},
                        {"inserts_particles", dem.inserts_particles()},
                        {"moved_surfaces", surfaces_of_both(dem.moved_surfaces(), unseen_surfaces)},
                        {"time_step", dem.time_step()},
                        {"periodic", dem.domain().periodic},
                        {"collision_time", contacts.collision},
                        {"rayleigh_time", contacts.rayleigh},
                        {"lightest_response", census.lightest_response},
                        {"lightest_particle", census.lowest_density},
                        {"largest_solid_fraction", largest_solid_fraction},
                        {"closures", closures},
                        {"momentum", {momentum.x, momentum.y, momentum.z}},
                        {"first_look", first_look(dem)},
                        {"ranks", ranks}}
      .dump();
}

}  // namespace demvof
