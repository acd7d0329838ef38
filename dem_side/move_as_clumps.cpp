// SPDX-License-Identifier: GPL-3.0-or-later
// The spheres of a clump have its acceleration: what acts on any of them acts on each by its share of the
// inertia, and one that touches something holds all of them.

#include "dem_side/forces.hpp"

namespace demvof {

void FluidForces::move_as_clumps(DemStep& step, std::vector<Found>& all) {
  const ParticleArrays& particles = step.particles;
  struct Clump {
    Vec3 others;
    double inertia = 0;
    bool touches = false;
  };
  std::vector<Clump> clumps;
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.in_clump(i)) continue;
    const auto index = static_cast<std::size_t>(particles.of_clump[i].clump);
    if (index >= clumps.size()) clumps.resize(index + 1);
    Clump& clump = clumps[index];
    clump.others += all[i].others;
    clump.inertia += particles.mass[i] + all[i].added;
    clump.touches = clump.touches || all[i].touches;
  }
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.in_clump(i)) continue;
    const Clump& clump = clumps[static_cast<std::size_t>(particles.of_clump[i].clump)];
    all[i].others = (particles.mass[i] + all[i].added) / clump.inertia * clump.others;
    carried_by(step.rows, i).contacts.touching += clump.touches && !all[i].touches;
  }
}

}  // namespace demvof
