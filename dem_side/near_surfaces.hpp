// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/base/vec3.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace demvof {

/// LIGGGHTS's own list of particles that are near each other, not copied; valid until the next DEM step. A
/// pair of two local particles stands in it once. One of a local particle and a ghost, which is another
/// rank's or an image behind a periodic boundary, is seen from the local one; its other half is in the list
/// of the ghost's owner.
struct NearPairs {
  int rows = 0;
  const int* particle = nullptr;        // of each row
  const int* partners = nullptr;        // how many it has, by particle
  const int* const* partner = nullptr;  // which, by particle; from ParticleArrays::count on they are ghosts
};

/// A sphere beside a wall.
struct NearWall {
  int particle = 0;
  double gap = 0;  // m, negative: overlap
  Vec3 towards;    // the wall, unit vector
  Vec3 velocity;   // of the wall where it is nearest, m/s
};

/// Makes LIGGGHTS's lists, from its next set-up on, hold everything that is nearer to a particle than so many
/// of its radii. Throws InputError when there is no list of pairs, or one that is not seen from both sides.
void reach_further(LAMMPS_NS::LAMMPS& liggghts, double radii);

/// None where the script has no pair_style that lists them.
NearPairs near_pairs(const LAMMPS_NS::LAMMPS& liggghts);

/// Local particles nearer than so many of their radii to granular walls (fix wall/gran): planes, cylinders,
/// and of each triangulated surface the nearest triangle. In the order of the script.
std::vector<NearWall> near_walls(LAMMPS_NS::LAMMPS& liggghts, double radii);

}  // namespace demvof
