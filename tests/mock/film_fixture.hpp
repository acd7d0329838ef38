// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Scenes of some spheres with films between them, and what becomes of each.

#include <fmt/format.h>

#include <algorithm>

#include "dem_side/forces.hpp"
#include "tests/mock/dem_fixture.hpp"

namespace demvof_test {

using demvof::FluidAtParticle;
using demvof::FluidForces;
using demvof::ForceParameters;
using demvof::LubricationParameters;

inline ForceParameters films_alone(const LubricationParameters& films = {}) {
  ForceParameters parameters;
  parameters.drag = demvof::DragLaw::none;
  parameters.pressure_gradient = false;
  parameters.lubrication = films;
  return parameters;
}

struct Sphere {
  Vec3 at, velocity;
  double diameter = bead_diameter, density = bead_density;
  double mass() const { return density * pi / 6 * diameter * diameter * diameter; }
};

inline std::string box_of(const std::vector<Sphere>& spheres, double time_step,
                          const std::string& boundary = "f f f") {
  std::string script = empty_box(1, boundary);
  script.replace(script.find("neighbor 0.001"), 14, "neighbor 2e-5");  // far less than a film's width
  script += fmt::format("timestep {:.17g}\n", time_step);
  for (const Sphere& sphere : spheres)
    script += fmt::format("create_atoms 1 single {:.17g} {:.17g} {:.17g} units box\n", sphere.at.x,
                          sphere.at.y, sphere.at.z);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto& [at, v, diameter, density] = spheres[i];
    script += fmt::format("set atom {} diameter {:.17g} density {:.17g} vx {:.17g} vy {:.17g} vz {:.17g}\n",
                          i + 1, diameter, density, v.x, v.y, v.z);
  }
  return script;
}

/// All particles in the order of their ids, on all ranks; velocity: of the half step to come.
struct State {
  std::vector<Vec3> at, velocity;
};
inline State state(const demvof::Dem& dem) {
  const auto particles = dem.particles();
  int largest = 0;
  for (int i = 0; i < particles.count; ++i) largest = std::max(largest, particles.id[i]);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, dem.world());
  State all{std::vector<Vec3>(largest), std::vector<Vec3>(largest)};
  for (int i = 0; i < particles.count; ++i) {
    all.at[particles.id[i] - 1] = demvof::vec3(particles.position[i]);
    all.velocity[particles.id[i] - 1] =
        demvof::vec3(particles.velocity[i]) +
        0.5 * dem.time_step() / particles.mass[i] * demvof::vec3(particles.force[i]);
  }
  for (auto* values : {&all.at, &all.velocity})
    MPI_Allreduce(MPI_IN_PLACE, &values->data()->x, 3 * largest, MPI_DOUBLE, MPI_SUM, dem.world());
  return all;
}

inline FluidAtParticle liquid(double viscosity, double density = 1e-30) {
  FluidAtParticle fluid;
  fluid.density = density;
  fluid.viscosity = viscosity;
  return fluid;
}

inline void begin(demvof::Dem& dem, FluidForces& forces, const FluidAtParticle& fluid, double window = 1e-3) {
  forces.begin_window(std::vector<FluidAtParticle>(dem.particles().count, fluid), window);
}
inline void start(demvof::Dem& dem, FluidForces& forces, const FluidAtParticle& fluid) {
  dem.set_up();
  begin(dem, forces, fluid);
  forces.first_half_step();
}

inline double films_counted(const FluidForces& forces, const demvof::Dem& dem, bool outside = false) {
  const demvof::ClosureCount count = forces.closures().back().second;
  double sum = outside ? count.outside : count.evaluations;
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, dem.world());
  return sum;
}

}  // namespace demvof_test
