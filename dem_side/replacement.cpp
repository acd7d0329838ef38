// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/replacement.hpp"

#include "coupler/base/sphere.hpp"
#include "coupler/grid/bring_to_owners.hpp"

namespace demvof {
namespace {

constexpr const char* rows_name = "demvof_replaced";  // 1: this particle is liquid on the fine mesh

}  // namespace

Replacement::Replacement(Dem& dem, double least_speed) : dem_(dem), least_speed_(least_speed) {
  dem_.add_particle_rows(rows_name, 1);
}

void Replacement::begin_window(const std::function<BulkInterface(int)>& seen_at,
                               const std::function<FluidAtParticle(int)>& liquid, double window) {
  const ParticleArrays particles = dem_.particles();
  double* const* rows = dem_.particle_rows(rows_name);
  decided_.clear();
  for (int i = 0; i < particles.count; ++i) {
    const Vec3 position = vec3(particles.position[i]), velocity = vec3(particles.velocity[i]);
    double& replaced = rows[i][0];
    const BulkInterface seen = seen_at(i);
    const bool changes =
        replaced > 0 ? seen.area == 0
                     : hits_interface(seen, position, velocity, particles.radius[i], window, least_speed_);
    if (!changes) continue;
    replaced = 1 - replaced;
    const double drop = liquid(i).density * sphere_volume(particles.radius[i]), mass = particles.mass[i];
    decided_.push_back(
        {position, mass / (mass + drop) * velocity, particles.radius[i], replaced > 0 ? 1.0 : -1.0});
  }
}

CellValues<Droplet> Replacement::droplets(const BulkGrid& grid, const BulkPartition& partition) const {
  CellValues<Droplet> mine{{}, decided_};
  for (const Droplet& droplet : decided_) mine.cells.push_back(grid.id(grid.locate(droplet.position)));
  return bring_to_owners(dem_.world(), partition, mine);
}

double Replacement::leave_out_replaced(int i, BulkParticles& contribution) const {
  if (dem_.particle_rows(rows_name)[i][0] == 0) return 0;
  const double volume = contribution.solid_volume;
  contribution.solid_volume = contribution.pressure_mobility = contribution.following_volume = 0;
  contribution.solid_flux = {};
  return volume;
}

}  // namespace demvof
