// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/soft_contacts.hpp"

#include <algorithm>

namespace demvof {
namespace {

/// A over the window, 1/s.
double stiffness_rate(const FluidForces& forces, int i, double volume) {
  const CarriedRow& row = forces.carried(i);
  double rate = 0;
  for (int k = 0; k < 2; ++k) {
    const CarriedFluid& fluid = row.fluid[k];
    if (row.feels(k))
      rate = std::max(rate, forces.drag_tangent(i, k) * (1 - fluid.void_fraction) /
                                (fluid.density * fluid.void_fraction * row.share(k) * volume));
  }
  return rate;
}

}  // namespace

SoftContacts count_soft_contacts(const Dem& dem, const FluidForces& forces,
                                 const ContactStiffness& stiffness) {
  const ParticleArrays particles = dem.particles();
  const double window = forces.window();
  SoftContacts found;
  for (int i = 0; window > 0 && i < particles.count; ++i) {
    if (forces.touching_share(i) < 0.5) continue;
    ++found.touching;
    const double load = norm(forces.carried(i).contacts.impulse) / window;
    const auto spring = stiffness.tangential(dem.type(i), particles.radius[i], particles.mass[i], load);
    const double tangent = forces.drag_tangent(i, 0) + forces.drag_tangent(i, 1);
    const double rate = stiffness_rate(forces, i, particles.volume(i));
    if (!spring || *spring * window >= 2 * tangent || rate * window <= stiff_in_a_window) continue;
    ++found.soft;
    found.holding_window = std::max(found.holding_window, 2 * tangent / *spring);
    found.rate = std::max(found.rate, rate);
  }
  return found;
}

}  // namespace demvof
