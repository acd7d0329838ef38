// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/base/sphere.hpp"
#include "coupler/base/vec3.hpp"

namespace demvof {

/// LIGGGHTS's own arrays of this rank's particles, not copied; valid until the next DEM step. Places, radii
/// and ids of ghosts stand behind them.
struct ParticleArrays {
  int count = 0;
  double* const* position = nullptr;    // m
  double* const* velocity = nullptr;    // m/s, at the same time as the position
  double* const* force = nullptr;       // N; during a step: what has been added up so far
  const double* const* spin = nullptr;  // rad/s, at the same time as the velocity
  double* const* torque = nullptr;      // N m; as the force
  const double* radius = nullptr;       // m
  const double* mass = nullptr;         // kg
  const int* id = nullptr;              // unique over all ranks
  const int* mask = nullptr;            // LIGGGHTS group bits
};

inline Vec3 vec3(const double* components) {
  return {components[0], components[1], components[2]};
}

inline std::vector<Vec3> positions(const ParticleArrays& particles) {
  std::vector<Vec3> result(particles.count);
  for (int i = 0; i < particles.count; ++i) result[i] = vec3(particles.position[i]);
  return result;
}
inline std::vector<double> radii(const ParticleArrays& particles) {
  return {particles.radius, particles.radius + particles.count};
}

}  // namespace demvof
