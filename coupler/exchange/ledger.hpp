// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Books of one run: does what one side gave arrive at the other, and is anything made or lost?
//
//   exchange   J + L + F_e + F_i + (P_n+1 - P_n) = 0                per window
//   momentum   m_s + m_f + P - sum of I = constant                  between windows in which particles come
//   or go solid      volume on the bulk grid, and on the fine mesh, = volume of the particles    per window
//   liquid     volume - sum of what came in = constant              from the start
//
// J    impulse that the particles received as drag in the window, N s
// L    impulse that the particles received as left-over of the window before, N s
// F_e  impulse that the fluid received by the explicit part of the exchange, N s
// F_i  and by its implicit part, N s
// P    pending: received by one side, still owed to the other, N s. After a window the sum of
//      -F_i  with conservative_implicit: owed to the particles
//      -J    with the concurrent schedule, except semi_implicit: owed to the fluid
//      what could be handed to nobody so far
// m_s, m_f   momentum of particles and fluid, kg m/s
// I    impulse from outside: gravity, walls, contacts with walls, pressure at the boundary, N s
//
// With conservative_implicit F_e = -J, L = P_n and P_n+1 = -F_i, so that the first sum is zero cell by cell;
// concurrent, with R returned to the fluid, F_e = R - J of the window before and L = -R - F_i of it.
// semi_implicit leaves J + F_i open: the books show how much.

#include <algorithm>
#include <cmath>
#include <optional>

#include "coupler/base/vec3.hpp"

namespace demvof {

/// What one window moved; sums over all particles, cells and ranks.
struct WindowBalance {
  Vec3 drag_to_particles, left_over_to_particles;  // J, L
  Vec3 explicit_to_fluid, implicit_to_fluid;       // F_e, F_i
  Vec3 pending;                                    // P at the end of the window
  double turnover = 0;  // sum over the bulk cells of impulses that may cancel in the sums above: the
                        // relative error is relative to this, too
  Vec3 particle_momentum, fluid_momentum;  // m_s, m_f at the end of the window
  Vec3 external;                           // I of the window
  double gross_impulse = 0;                // largest of its parts, N s
  double moving = 0;                       // of the particles, whose momenta may cancel in m_s, kg m/s
  bool particles_changed = false;          // some came or went, with momentum of their own
  double bulk_solid_volume = 0, particle_volume = 0;  // at the end of the window, m3
  std::optional<double> fine_solid_error;  // on the fine mesh, where it is put there, less what should be, m3
  double liquid_volume = 0;                // at the end of the window, m3
  double liquid_in = 0;  // came in through the boundary or replaced particles in the window, m3
};

/// Relative errors, -.
struct ConservationErrors {
  double exchange = 0;  // |sum| / (largest of |J|, |L|, |F_e + F_i|, |P_n|, |P_n+1|, turnover)
  double momentum = 0;  // |drift from the start| / (largest |m_s| + |m_f|, sqrt(2 E m) of the particles, or
                        // |sum of I|, up to now, or sum of the largest parts of I: a bed at rest is judged by
                        // its weight, one that turns about its middle by its motion)
  double solid_volume = 0;   // larger of |bulk - particles|, |fine - particles| / particles
  double liquid_volume = 0;  // |drift from the start| / (start + sum of what came in)
};

class Ledger {
 public:
  /// State at the start. pending: of a run that is continued, N s.
  Ledger(const Vec3& particle_momentum, const Vec3& fluid_momentum, double liquid_volume,
         const Vec3& pending = {})
      : start_momentum_(particle_momentum + fluid_momentum + pending),
        pending_(pending),
        momentum_scale_(norm(particle_momentum) + norm(fluid_momentum)),
        liquid_(liquid_volume) {}

  /// Enters a window; its errors.
  ConservationErrors close(const WindowBalance& window) {
    ConservationErrors errors;
    const Vec3 to_fluid = window.explicit_to_fluid + window.implicit_to_fluid;
    const Vec3 open =
        window.drag_to_particles + window.left_over_to_particles + to_fluid + (window.pending - pending_);
    errors.exchange = relative(
        norm(open), std::max({norm(window.drag_to_particles), norm(window.left_over_to_particles),
                              norm(to_fluid), norm(pending_), norm(window.pending), window.turnover}));
    pending_ = window.pending;

    external_ += window.external;
    const Vec3 drift =
        window.particle_momentum + window.fluid_momentum + pending_ - external_ - start_momentum_;
    gross_impulse_ += window.gross_impulse;
    momentum_scale_ = std::max({momentum_scale_, norm(window.particle_momentum) + norm(window.fluid_momentum),
                                norm(external_), gross_impulse_, window.moving});
    if (window.particles_changed)
      start_momentum_ += drift;  // what they brought or took
    else
      errors.momentum = relative(norm(drift), momentum_scale_);

    const double on_bulk = std::abs(window.bulk_solid_volume - window.particle_volume);
    const double on_fine = std::abs(window.fine_solid_error.value_or(0));
    errors.solid_volume = relative(std::max(on_bulk, on_fine), window.particle_volume);
    liquid_ += window.liquid_in;
    errors.liquid_volume = relative(std::abs(window.liquid_volume - liquid_), liquid_);

    worst_.exchange = std::max(worst_.exchange, errors.exchange);
    worst_.momentum = std::max(worst_.momentum, errors.momentum);
    worst_.solid_volume = std::max(worst_.solid_volume, errors.solid_volume);
    worst_.liquid_volume = std::max(worst_.liquid_volume, errors.liquid_volume);
    return errors;
  }

  /// What liquid there should be, m3.
  double liquid_volume() const { return liquid_; }

  /// Largest of each error over the windows entered.
  const ConservationErrors& worst() const { return worst_; }

 private:
  static double relative(double error, double size) {
    if (error == 0) return 0;
    const double ratio = error / size;
    return ratio >= 0 ? ratio : HUGE_VAL;  // what is not a number must not get lost in a maximum
  }

  Vec3 start_momentum_, external_, pending_;
  double momentum_scale_;     // kg m/s
  double gross_impulse_ = 0;  // N s
  double liquid_;             // what there should be, m3
  ConservationErrors worst_;
};

}  // namespace demvof
