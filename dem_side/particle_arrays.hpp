// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/base/sphere.hpp"
#include "coupler/base/vec3.hpp"
#include "coupler/transfer/spheres.hpp"
#include "dem_side/clumps.hpp"

namespace demvof {

/// LIGGGHTS's own arrays of this rank's particles, not copied; valid until the next DEM step. Places, radii
/// and ids of ghosts stand behind them.
struct ParticleArrays {
  int count = 0;
  double* const* position = nullptr;        // m
  double* const* velocity = nullptr;        // m/s, at the same time as the position
  double* const* force = nullptr;           // N; during a step: what has been added up so far
  const double* const* spin = nullptr;      // rad/s, at the same time as the velocity
  double* const* torque = nullptr;          // N m; as the force
  const double* radius = nullptr;           // m
  const double* mass = nullptr;             // kg; of a sphere of a clump its share
  const int* id = nullptr;                  // unique over all ranks
  const int* mask = nullptr;                // LIGGGHTS group bits
  const SphereOfClump* of_clump = nullptr;  // nullptr: there are no clumps
  const RigidBody* clumps = nullptr;        // by SphereOfClump::clump
  const Vec3* off_centre = nullptr;         // Clumps::Spheres

  bool in_clump(int i) const { return of_clump && of_clump[i].clump >= 0; }
  double volume(int i) const { return of_clump ? of_clump[i].volume : sphere_volume(radius[i]); }  // m3
  /// Of the sphere whose drag it has a share of, m; and that share, -.
  double drag_diameter(int i) const { return of_clump ? of_clump[i].diameter : 2 * radius[i]; }
  double drag_share(int i) const { return of_clump ? of_clump[i].share : 1; }
  /// With which it slips, m/s.
  Vec3 own_velocity(int i) const {
    return in_clump(i) ? of_clump[i].own_velocity : Vec3{velocity[i][0], velocity[i][1], velocity[i][2]};
  }
};

inline Vec3 vec3(const double* components) {
  return {components[0], components[1], components[2]};
}

/// LIGGGHTS's rows of coordinates follow each other.
inline Spheres spheres(const ParticleArrays& particles) {
  const int count = particles.count;
  return {count, count > 0 ? reinterpret_cast<const Vec3*>(particles.position[0]) : nullptr,
          particles.radius};
}
/// Of what displaces the fluid as a whole: a sphere, or one of its clump's volume, m.
inline std::vector<double> whole_radii(const ParticleArrays& particles) {
  std::vector<double> result(particles.count);
  for (int i = 0; i < particles.count; ++i) result[i] = 0.5 * particles.drag_diameter(i);
  return result;
}

}  // namespace demvof
