// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/base/vec3.hpp"
#include "dem_side/rigid_drag.hpp"

namespace LAMMPS_NS {
class FixMultisphere;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace demvof {

/// A sphere of a clump: it acts on the fluid, and is moved by it, as its share of the whole.
///
///   V_i = s_i V,  m_i = s_i M,  s_i = (1 + b.r_i) w_i v_i / sum of w v     V, M: volume and mass of the
///   clump
///
/// v_i: volume of the sphere; w_i: LIGGGHTS's weight of what overlaps, where it has one; r_i: from the
/// clump's centre of mass, b such that sum of s_i r_i = 0. Buoyancy and drag of a clump that moves without
/// turning so have no moment, as a homogeneous body's buoyancy has none. Across a row of spheres, or a plane,
/// no shares do that, and LIGGGHTS finds centres by chance: there the fluid acts at r_i - sum of s_j r_j. The
/// drag is that of the sphere of the clump's volume; it damps the turning by the spheres' own velocities.
struct SphereOfClump {
  int clump = -1;       // index on this rank; -1: a sphere by itself
  double share = 1;     // s_i, -
  double volume = 0;    // V_i, m3
  double diameter = 0;  // of a sphere of the clump's volume, m
  Vec3 velocity;        // of the clump's centre of mass, m/s
  Vec3 arm;             // from there to where the fluid acts on the sphere, m
  Vec3 own_velocity;    // there, m/s
};

/// The clumps of LIGGGHTS's fix multisphere.
class Clumps {
 public:
  explicit Clumps(LAMMPS_NS::LAMMPS& liggghts);

  /// There is a fix multisphere.
  explicit operator bool() const { return fix_ != nullptr; }
  bool has(int i) const;  // local particle
  long count() const;     // of this rank
  /// As LIGGGHTS has them at present: per local particle, and valid until the next call.
  struct Spheres {
    const SphereOfClump* of_clump;
    const double* mass;       // m_i; of a sphere by itself its own, kg
    const RigidBody* bodies;  // by SphereOfClump::clump
    const Vec3* off_centre;   // sum of s_i r_i of each, m
  };
  Spheres spheres();
  /// Sums the forces on the spheres again: those on the clumps are what the next step moves with.
  void renew_forces();

 private:
  void balance();
  void find_bodies();
  Vec3 from_centre(int i) const;  // of its clump to sphere i, m

  LAMMPS_NS::LAMMPS& liggghts_;
  LAMMPS_NS::FixMultisphere* fix_;
  std::vector<SphereOfClump> spheres_;
  std::vector<double> masses_, weighted_volumes_;
  std::vector<RigidBody> bodies_;
  std::vector<Vec3> off_centre_;
};

}  // namespace demvof
