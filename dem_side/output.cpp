// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/output.hpp"

namespace demvof {
namespace {

ParticleFrame particle_frame(const Dem& dem, const FluidForces& forces, double window) {
  const ParticleArrays particles = dem.particles();
  double* const* fluid_force = dem.added_forces();
  const Vec3 gravity = dem.script_gravity();
  ParticleFrame frame;
  for (int i = 0; i < particles.count; ++i) {
    Vec3 contact;
    if (dem.integrates(i) && !dem.stream(i).carries) {
      contact = vec3(particles.force[i]) - vec3(fluid_force[i]);
      if (dem.has_weight(particles.mask[i]) && !particles.in_clump(i)) contact -= particles.mass[i] * gravity;
    }
    frame.id.push_back(particles.id[i]);
    frame.position.push_back(vec3(particles.position[i]));
    frame.velocity.push_back(vec3(particles.velocity[i]));
    frame.spin.push_back(vec3(particles.spin[i]));
    frame.radius.push_back(particles.radius[i]);
    frame.drag_force.push_back(forces.drag_impulse(i) / window);
    frame.pressure_force.push_back(forces.pressure_force(i));
    frame.contact_force.push_back(contact);
  }
  return frame;
}

// Void fraction and drag are those of the end of the window, both fluids together; the fluid, where there are
// two the liquid, that of its start: cells that became active in between show none.
CellValues<BulkFrame> bulk_frame(const BulkGrid& grid, double window, const Averaging& averaging,
                                 const std::vector<CellValues<BulkFluid>>& fluids) {
  const CellValues<double> solid = averaging.solid_volume();
  CellValues<BulkFrame> frame{solid.cells, std::vector<BulkFrame>(solid.cells.size())};
  for (std::size_t i = 0; i < frame.cells.size(); ++i) {
    BulkFrame& here = frame.values[i];
    here.void_fraction = 1 - solid.values[i] / grid.cell_volume();
    for (int k = averaging.fluids() - 1; k >= 0; --k) {
      if (const BulkParticles* particles = find(averaging.in(k).deposited(), frame.cells[i]))
        here.drag -= particles->drag_impulse / (window * grid.cell_volume());
      const BulkFluid* cell = k < static_cast<int>(fluids.size()) ? find(fluids[k], frame.cells[i]) : nullptr;
      if (!cell) continue;
      here.fluid_velocity = cell->velocity;
      here.pressure_gradient = cell->pressure_gradient;
    }
  }
  return frame;
}

}  // namespace

Output::Output(const Dem& dem, const BulkGrid& grid, const std::filesystem::path& folder,
               std::optional<double> continued_from)
    : dem_(dem),
      grid_(grid),
      particles_(dem.world(), folder, continued_from),
      bulk_(dem.world(), grid, folder, continued_from) {
  if (dem.has_surfaces()) surfaces_.emplace(dem.world(), folder, continued_from);
}

void Output::write(double time, double window, const FluidForces& forces, const Averaging& averaging,
                   const std::vector<CellValues<BulkFluid>>& fluids) {
  particles_.write(time, particle_frame(dem_, forces, window));
  if (surfaces_) surfaces_->write(time, dem_.surface_corners());
  bulk_.write(time, bulk_frame(grid_, window, averaging, fluids));
}

}  // namespace demvof
