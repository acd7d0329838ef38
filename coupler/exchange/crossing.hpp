// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// When a particle that crosses the interface is replaced by a drop of liquid (paper, section 5.2).
//
//   (u_int - v).n_int > delta_C                                                                   [43]
//
//   u_int  velocity of the interface, m/s          n_int    its normal, into the phase of the particle
//   v      velocity of the particle, m/s           delta_C  coupling.interchange_speed, m/s
//
// The paper asks this of particles "in a part of the domain interested by the presence of the
// interface". Here that is: the interface lies in the particle's bulk cells, and its surface reaches the
// interface within the window at the present closing speed.

#include <cmath>

#include "coupler/base/vec3.hpp"

namespace demvof {

enum class PhaseInterchange {
  porous,
  volume_adding,
  replacement,
  none
};  // how particles cross the interface

/// The interface in a bulk cell: sums over its fine cells, with their area |grad alpha| V as weight.
/// All zero: the cell holds none.
struct BulkInterface {
  double area = 0;  // m2
  Vec3 position;    // area x place, m3
  Vec3 velocity;    // area x velocity of the fluid, m3/s
  Vec3 gradient;    // sum of V grad alpha, m2: points into the liquid
};

/// seen: the interface in the particle's bulk cells, with any positive weights. window: s.
inline bool hits_interface(const BulkInterface& seen, const Vec3& position, const Vec3& velocity,
                           double radius, double window, double least_speed) {
  const double size = norm(seen.gradient);
  if (!(seen.area > 0 && size > 0)) return false;
  Vec3 normal = seen.gradient / -size;  // into the gas
  double distance = dot(position - seen.position / seen.area, normal);
  if (distance < 0) {  // the particle is in the liquid
    normal = -normal;
    distance = -distance;
  }
  const double closing = dot(seen.velocity / seen.area - velocity, normal);
  return closing > least_speed && distance <= radius + closing * window;
}

/// A particle that becomes liquid on the fine mesh, or takes its place back, at the start of a window.
/// Travels as a row of doubles.
struct Droplet {
  Vec3 position, velocity;  // of the drop, m, m/s
  double radius = 0;        // m
  double sign = 1;          // +1: it becomes liquid; -1: it takes its place back
};

}  // namespace demvof
