// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Momentum of everything: fluid, particles, and what one side has received and still owes to the other,
//
//   m_f + m_s + P - sum of I = constant
//
// I are the impulses from outside, each of them measured where it acts (docs/theory.md, The books). The error
// is relative to the largest of them and of the momentum, whatever its direction: a bed at rest is judged by
// its weight, one that turns about its middle by its motion.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "coupler/base/vec3.hpp"

namespace demvof {

/// Impulses of a window, or of a run, on fluid and particles together, N s.
struct OutsideImpulses {
  Vec3 fluid_weight, particle_weight;
  Vec3 boundary_pressure;  // of the fluid's boundary, on fluid and particles: total pressure
  Vec3 boundary_shear;     // viscous, on the fluid
  Vec3 carried_in;         // with fluid that flows through the boundary
  Vec3 surface_tension;    // what its model exerts in sum on the fluid; 0 for closed surfaces
  Vec3 sources;            // of fvOptions, on the fluid
  Vec3 replacement;        // with drops that replace particles
  Vec3 contacts;           // on particles that forces move: of walls and held particles; among each other 0
  Vec3 held;               // what the fluid gave to particles that no force moves went to what holds them
  Vec3 stress;             // viscous stress and capillary force on particles
  Vec3 constant;           // the case file's force on particles
  Vec3 smeared_weight;     // of fluid that particles displace where fine cells hold both fluids
  Vec3 pressure_lag;  // pressure on the particles less what the fluid gave them with the gradient it told

  OutsideImpulses& operator+=(const OutsideImpulses& other) {
    for (const auto& [name, part] : parts) this->*part += other.*part;
    return *this;
  }
  Vec3 sum() const {
    Vec3 sum;
    for (const auto& [name, part] : parts) sum += this->*part;
    return sum;
  }

  /// Names as in results.json.
  static const std::array<std::pair<const char*, Vec3 OutsideImpulses::*>, 14> parts;
};

inline constexpr std::array<std::pair<const char*, Vec3 OutsideImpulses::*>, 14> OutsideImpulses::parts = {
    {{"fluid_weight", &OutsideImpulses::fluid_weight},
     {"particle_weight", &OutsideImpulses::particle_weight},
     {"boundary_pressure", &OutsideImpulses::boundary_pressure},
     {"boundary_shear", &OutsideImpulses::boundary_shear},
     {"carried_in", &OutsideImpulses::carried_in},
     {"surface_tension", &OutsideImpulses::surface_tension},
     {"sources", &OutsideImpulses::sources},
     {"replacement", &OutsideImpulses::replacement},
     {"contacts", &OutsideImpulses::contacts},
     {"held", &OutsideImpulses::held},
     {"stress", &OutsideImpulses::stress},
     {"constant", &OutsideImpulses::constant},
     {"smeared_weight", &OutsideImpulses::smeared_weight},
     {"pressure_lag", &OutsideImpulses::pressure_lag}}};

class MomentumBooks {
 public:
  /// total: m_f + m_s + P at the start.
  explicit MomentumBooks(const Vec3& total) : start_(total) {}

  /// Enters a window. changed: particles came or went with momentum of their own: it is not judged. moving:
  /// size of the particles' momenta, which may cancel in the total, kg m/s.
  void close(const Vec3& total, const OutsideImpulses& impulses, bool changed, double moving = 0) {
    impulses_ += impulses;
    const Vec3 drift = total - impulses_.sum() - start_;
    scale_ = std::max({scale_, norm(total), moving});
    for (const auto& [name, part] : OutsideImpulses::parts) scale_ = std::max(scale_, norm(impulses_.*part));
    ++windows_;
    if (changed) {
      start_ += drift;
      return;
    }
    ++judged_;
    for (int axis = 0; axis < 3; ++axis) {
      const double error = drift[axis] == 0 ? 0 : std::abs(drift[axis]) / scale_;
      worst_[axis] = error >= 0 ? std::max(worst_[axis], error) : HUGE_VAL;
    }
  }

  /// Worst relative error of each component so far, -.
  const Vec3& worst() const { return worst_; }
  /// What that is relative to, kg m/s.
  double scale() const { return scale_; }
  /// Sums over the run, N s.
  const OutsideImpulses& impulses() const { return impulses_; }
  long windows() const { return windows_; }
  long judged() const { return judged_; }

 private:
  Vec3 start_, worst_;
  OutsideImpulses impulses_;
  double scale_ = 0;  // kg m/s
  long windows_ = 0, judged_ = 0;
};

}  // namespace demvof
