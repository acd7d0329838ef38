// SPDX-License-Identifier: GPL-3.0-or-later
// What films do to the particles in a DEM step, once all else that acts on them is known.

#include "dem_side/forces.hpp"
#include "dem_side/implicit_drag.hpp"

namespace demvof {

void FluidForces::bear_films(DemStep& step, std::vector<Found>& all) {
  const ParticleArrays& particles = step.particles;
  std::vector<Lubrication::Body> bodies(all.size());
  for (int i = 0; i < particles.count; ++i) {
    const CarriedRow& row = carried_by(step.rows, i);
    const Found& found = all[i];
    const double mass = particles.mass[i], inertia = mass + found.added;
    Lubrication::Body& body = bodies[i];
    body.velocity = vec3(particles.velocity[i]);
    for (int k = 0; k < 2; ++k)
      if (row.feels(k)) body.viscosity += row.share(k) * row.fluid[k].viscosity;
    if (!found.moves) continue;
    body.velocity += step.length / inertia * (found.drag(mass, step.length) + found.others);
    body.mobility = mean_decay(found.beta * step.length / inertia) / inertia;
  }
  const std::vector<Vec3>& films = lubrication_->forces(particles, bodies, step.length);
  for (int i = 0; i < particles.count; ++i) {
    CarriedRow& row = carried_by(step.rows, i);
    if (!all[i].moves) continue;
    all[i].own += films[i];
    all[i].others += films[i];
    row.contacts.touching += !all[i].touches && norm(films[i]) > 0;
    row.contacts.impulse += step.length * films[i];
    step.sums.contact += films[i];
  }
}

}  // namespace demvof
