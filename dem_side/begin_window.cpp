// SPDX-License-Identifier: GPL-3.0-or-later
// What the particles are told at the start of a window: the fluids at their places, and the surface.

#include <fmt/format.h>

#include "coupler/base/errors.hpp"
#include "dem_side/forces.hpp"

namespace demvof {
namespace {

// The own wake is that of a point force when it is spread over at least a diameter.
void require_spread(const WakeWidth& width, double diameter) {
  if (width(diameter) >= diameter) return;
  throw InputError(fmt::format(
      "forces.own_wake: averaging spreads a particle's force over {:.3g} m in the velocity that it feels, "
      "which "
      "must be a diameter ({:.3g} m) at least: use wider bulk cells or a wider kernel, or leave own_wake out",
      width(diameter), diameter));
}

/// CarriedRow::alone. A force that is left over by a fluid is felt outside of it, too.
double alone_in(const CarriedRow& row) {
  if (row.waited > 0 || norm(row.surface.normal) > 0 || row.feels(0) == row.feels(1)) return 0;
  const int k = row.feels(0) ? 0 : 1;
  return row.share(k) == 1 && (static_cast<int>(row.owed) & ~(1 << k)) == 0 ? 1 + k : 0;
}

}  // namespace

void FluidForces::take_out_own_wake(const WakeWidth& width, double largest_diameter) {
  require_spread(width, largest_diameter);
  own_wake_width_ = width;
}

void FluidForces::begin_window(const FluidsAtParticles& fluids, double window) {
  const ParticleArrays particles = dem_.particles();
  const bool two = static_cast<bool>(fluids.surface);
  double* const* rows = dem_.particle_rows(rows_name);
  double* const* gradients = gradient_rows();
  for (int i = 0; i < particles.count; ++i) {
    if (particles.in_clump(i) && dem_.held(particles.mask[i]))  // one that came later
      throw InputError(fmt::format(
          "the script holds particle {} of a clump (fix freeze, or move), and LIGGGHTS moves clumps as if it "
          "did not: give that fix a group of spheres that belong to no clump",
          particles.id[i]));
    if (own_wake_width_) require_spread(*own_wake_width_, particles.drag_diameter(i));
    const double volume = particles.volume(i);
    CarriedRow& row = carried_by(rows, i);
    // Of the window that left something over.
    const double waited = row.waited, beta[] = {mean_drag_factor(row, 0), mean_drag_factor(row, 1)};
    row = {};
    for (int k = 0; k < (two ? 2 : 1); ++k) {
      const FluidAtParticle here = fluids.fluid[k](i);
      CarriedFluid& fluid = row.fluid[k];
      fluid.velocity = here.velocity;
      fluid.density = here.density;
      fluid.viscosity = here.viscosity;
      fluid.void_fraction = here.void_fraction;
      if (parameters_.pressure_gradient) fluid.pressure_force = -volume * here.pressure_gradient;
      fluid.left_over_force = beta[k] / window * here.left_over_rate;
      row.told += here.density > 0 ? 1 << k : 0;
      row.owed += norm(fluid.left_over_force) > 0 ? 1 << k : 0;
      if (gradients)
        carried_by<CarriedGradientsRow>(gradients, i).fluid[k] = {
            volume * here.gradients.stress_force, here.gradients.acceleration, here.gradients.vorticity, {}};
    }
    if (two) {
      row.surface = carried_surface(fluids.surface(i), row.fluid[0].velocity);
      for (int k = 0; k < 2; ++k)  // told of one fluid only: all of it is there
        if (row.fluid[k].density == 0 && row.fluid[1 - k].density > 0) row.surface = {k == 0 ? 1.0 : 0.0, {}};
    }
    row.waited = waited;
    row.known = 1;
    row.alone = alone_in(row);
  }
  begun_ = true;
  window_ = window;
  steps_ = 0;
  force_sums_ = {};
  drag_count_ = lift_count_ = spin_lift_count_ = {};
  if (torque_) torque_->begin_window();
  if (history_) history_->begin_window();
  if (lubrication_) lubrication_->begin_window();
}

void FluidForces::tell_sizes(int k, const std::vector<SizeMix>& sizes) {
  double* const* rows = dem_.particle_rows(rows_name);
  for (std::size_t i = 0; i < sizes.size(); ++i)
    carried_by(rows, static_cast<int>(i)).fluid[k].sizes = sizes[i];
}

void FluidForces::see_surface(const std::function<SeenSurface(int)>& surface) {
  double* const* rows = dem_.particle_rows(rows_name);
  for (int i = 0, count = dem_.particles().count; i < count; ++i) {
    CarriedRow& row = carried_by(rows, i);
    if (row.waits()) row.surface = carried_surface(surface(i), {});
  }
}

}  // namespace demvof
