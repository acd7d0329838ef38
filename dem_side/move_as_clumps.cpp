// SPDX-License-Identifier: GPL-3.0-or-later
// The spheres of a clump have one acceleration: what acts on any of them moves the whole, with the drag of
// all of them, of which each has its own slip's and its part of the change during the step. One that touches
// something holds all of them.

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
    Found whole;
    double mass = 0;
  };
  std::vector<Clump> clumps;
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.in_clump(i)) continue;
    const auto index = static_cast<std::size_t>(particles.of_clump[i].clump);
    if (index >= clumps.size()) clumps.resize(index + 1);
    Clump& clump = clumps[index];
    const Found& sphere = all[i];
    clump.mass += particles.mass[i];
    clump.whole.moves = sphere.moves;
    clump.whole.touches = clump.whole.touches || sphere.touches;
    clump.whole.beta += sphere.beta;
    clump.whole.added += sphere.added;
    clump.whole.pull += sphere.pull;
    clump.whole.others += sphere.others;
  }
  for (Clump& clump : clumps) {
    Found& whole = clump.whole;
    whole.mean_drag = whole.drag(clump.mass, step.length);
    if (whole.moves) whole.acceleration = (whole.mean_drag + whole.others) / (clump.mass + whole.added);
  }
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.in_clump(i)) continue;
    const Found& whole = clumps[static_cast<std::size_t>(particles.of_clump[i].clump)].whole;
    Found& sphere = all[i];
    sphere.mean_drag = sphere.pull;
    if (whole.beta > 0) sphere.mean_drag += sphere.beta / whole.beta * (whole.mean_drag - whole.pull);
    sphere.acceleration = whole.acceleration;
    carried_by(step.rows, i).contacts.touching += whole.touches && !sphere.touches;
  }
}

}  // namespace demvof
