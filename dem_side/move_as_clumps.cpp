// SPDX-License-Identifier: GPL-3.0-or-later
// What acts on any sphere of a clump moves and turns the whole, with the drag and the added mass of all of
// them, each at its place (rigid_drag.hpp). One that touches something holds all of them.

#include <fmt/format.h>

#include "coupler/base/errors.hpp"
#include "dem_side/forces.hpp"

namespace demvof {

void FluidForces::require_known_for_clumps(const ForceParameters& parameters) {
  for (const auto& [named, force] : {std::pair(parameters.lift != LiftLaw::none, "lift"),
                                     {parameters.spin_lift != SpinLiftLaw::none, "spin_lift"},
                                     {parameters.torque, "torque"},
                                     {parameters.history, "history"},
                                     {parameters.lubrication.has_value(), "lubrication"}})
    if (named)
      throw InputError(fmt::format(
          "forces: {} is known for spheres alone, and the script has clumps (fix multisphere): leave it out",
          force));
}

void FluidForces::move_as_clumps(DemStep& step, std::vector<Found>& all) {
  const ParticleArrays& particles = step.particles;
  struct Clump {
    Matrix6 drag{}, added_mass{};
    Motion forces;
    bool touches = false;
    RigidStep does;
  };
  std::vector<Clump> clumps;
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.in_clump(i)) continue;
    const SphereOfClump& sphere = particles.of_clump[i];
    const auto index = static_cast<std::size_t>(sphere.clump);
    if (index >= clumps.size()) clumps.resize(index + 1);
    Clump& clump = clumps[index];
    const Found& found = all[i];
    clump.touches = clump.touches || found.touches;
    add_place(clump.drag, found.beta, sphere.arm);
    if (found.added > 0) add_place(clump.added_mass, found.added, sphere.arm);
    clump.forces.act(found.pull + found.others, sphere.arm);
    // LIGGGHTS lets contacts act at the sphere's centre. The weight has no moment with either.
    clump.forces.angular +=
        vec3(particles.torque[i]) + cross(particles.off_centre[index], vec3(particles.force[i]));
  }
  for (std::size_t n = 0; n < clumps.size(); ++n)
    clumps[n].does =
        rigid_step(particles.clumps[n], clumps[n].drag, clumps[n].added_mass, clumps[n].forces, step.length);
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.in_clump(i)) continue;
    const SphereOfClump& sphere = particles.of_clump[i];
    const Clump& clump = clumps[static_cast<std::size_t>(sphere.clump)];
    all[i].mean_drag = all[i].pull - all[i].beta * clump.does.mean_change.at(sphere.arm);
    all[i].acceleration = clump.does.acceleration.at(sphere.arm);
    carried_by(step.rows, i).contacts.touching += clump.touches && !all[i].touches;
  }
}

// LIGGGHTS turns a clump by what it gets at the spheres' centres.
void FluidForces::turn_clumps(const ParticleArrays& particles, const std::vector<Vec3>& given) {
  std::vector<Vec3> sums;
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.in_clump(i)) continue;
    const auto index = static_cast<std::size_t>(particles.of_clump[i].clump);
    if (index >= sums.size()) sums.resize(index + 1);
    sums[index] += given[i];
  }
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.in_clump(i)) continue;
    const SphereOfClump& sphere = particles.of_clump[i];
    const Vec3 torque = sphere.share * cross(particles.off_centre[sphere.clump], sums[sphere.clump]);
    for (int axis = 0; axis < 3; ++axis) particles.torque[i][axis] -= torque[axis];
  }
}

}  // namespace demvof
