// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes a ledger's entry (ledger.hpp) of what the two sides report about a window.

#include <algorithm>
#include <cmath>
#include <optional>

#include "coupler/exchange/ledger.hpp"
#include "coupler/exchange/momentum_books.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/exchange/particle_report.hpp"

namespace demvof {

/// What the fluid side reports about a window; sums over all cells and ranks.
struct FluidReport {
  Vec3 explicit_impulse, implicit_impulse;  // that the fluid received, N s
  Vec3 kept_left_over;  // of windows before, that the particles could not be told in this one, N s
  std::optional<double> fine_solid_volume;  // as mapped to the mesh, m3; without porosity nothing is
  double liquid_volume = 0;                 // at the end of the window, m3
  double liquid_in = 0;                     // through the boundary in the window, m3
  double replaced_liquid = 0;               // in place of particles since the start of the run, m3
  Vec3 replacement_impulse;                 // that came with it since then, N s
  Vec3 momentum;                            // at the end of the window, kg m/s
  OutsideImpulses outside;                  // those that the fluid side sees
  Vec3 seen_pressure;      // what the particles were given with the pressure gradient they were told, N s
  Vec3 owed_pressure;      // what its pressure left to them and they have not been given, at the window's end
  Vec3 returned_pressure;  // of that, what went back to the fluid with the explicit impulse
  double returned_turnover = 0;  // sum over the bulk cells of its size, N s
};

class Books {
 public:
  /// What lives from one run to the one that continues it.
  struct State {
    Vec3 pending;              // received by one side, not yet by the other, N s
    Vec3 unplaced;             // of this, what found no particle at all
    double liquid_volume = 0;  // what there should be, m3
    Vec3 owed_pressure;        // FluidReport's
  };
  Books(ExchangeScheme scheme, Schedule schedule, const Vec3& particle_momentum, const Vec3& fluid_momentum,
        const State& state)
      : scheme_(scheme),
        schedule_(schedule),
        pending_(state.pending),
        unplaced_(state.unplaced),
        owed_pressure_(state.owed_pressure),
        ledger_(particle_momentum, {}, state.liquid_volume, state.pending),
        momentum_(particle_momentum + fluid_momentum + state.pending + state.owed_pressure) {}
  State state() const { return {pending_, unplaced_, ledger_.liquid_volume(), owed_pressure_}; }

  /// Enters a window of a run without particles.
  void window(const FluidReport& fluid) { enter(fluid, {}); }

  /// Enters a window. Momentum is that of the particles: drag, left-over, pressure, contacts and gravity must
  /// add up to its change (docs/outputs.md says what this covers).
  void window(const FluidReport& fluid, const ParticleReport& particles) {
    WindowBalance balance;
    const bool some_went = particles.left + particles.lost != gone_;
    balance.particles_changed = some_went || particles.inserted != came_;
    came_ = particles.inserted;
    gone_ = particles.left + particles.lost;
    balance.drag_to_particles = some_went ? particles.drag_impulse_bulk : particles.drag_impulse;
    balance.left_over_to_particles = particles.left_over_given;
    balance.explicit_to_fluid = fluid.explicit_impulse - fluid.returned_pressure;
    balance.implicit_to_fluid = fluid.implicit_impulse;
    balance.turnover = fluid.returned_turnover;
    unplaced_ += particles.left_over_unplaced;
    if (hands_back_left_over(scheme_))
      balance.pending = unplaced_ - fluid.implicit_impulse + fluid.kept_left_over;
    if (schedule_ == Schedule::concurrent && pays_drag_impulse(scheme_))
      balance.pending -= balance.drag_to_particles;  // the fluid's next window pays it
    // The fluid gets the drag of those that are still there. What one that left received in its last window,
    // and what it was still owed, has gone with it.
    if (some_went) {
      balance.left_over_to_particles = pending_ - balance.pending - balance.drag_to_particles -
                                       balance.explicit_to_fluid - balance.implicit_to_fluid;
      gone_impulse_ += norm(particles.drag_impulse - balance.drag_to_particles) +
                       norm(balance.left_over_to_particles - particles.left_over_given);
    }
    balance.particle_momentum = particles.momentum;
    balance.moving = moving(particles);
    balance.external = particles.drag_impulse + particles.left_over_given + particles.pressure_impulse +
                       particles.stress_impulse + particles.constant_impulse + particles.contact_impulse +
                       particles.gravity_impulse - particles.held_impulse + (balance.pending - pending_);
    pending_ = balance.pending;
    for (const Vec3& impulse : {particles.drag_impulse, particles.pressure_impulse, particles.gravity_impulse,
                                particles.contact_impulse, particles.held_impulse})
      balance.gross_impulse = std::max(balance.gross_impulse, norm(impulse));
    close_momentum(fluid, particles, balance.particles_changed);
    balance.bulk_solid_volume = particles.solid_volume_bulk;
    balance.particle_volume = particles.solid_volume - particles.replaced_volume;
    // With the concurrent schedule the mesh has the particles of the window before.
    const std::optional<double> on_mesh =
        schedule_ == Schedule::concurrent ? volume_before_ : std::optional(balance.particle_volume);
    volume_before_ = balance.particle_volume;
    if (fluid.fine_solid_volume && on_mesh) balance.fine_solid_error = *fluid.fine_solid_volume - *on_mesh;
    enter(fluid, balance);
  }

  /// Largest of each error so far.
  const ConservationErrors& worst() const { return ledger_.worst(); }
  /// Of everything, since the start.
  const MomentumBooks& momentum() const { return momentum_; }
  Vec3 pending() const { return pending_ + owed_pressure_; }
  /// Impulse that went with particles in the windows in which they left, N s.
  double gone_impulse() const { return gone_impulse_; }

 private:
  void close_momentum(const FluidReport& fluid, const ParticleReport& particles, bool changed) {
    OutsideImpulses outside = fluid.outside;
    outside.replacement = fluid.replacement_impulse - replacement_impulse_;
    replacement_impulse_ = fluid.replacement_impulse;
    outside.particle_weight = particles.gravity_impulse;
    outside.contacts = particles.contact_impulse;
    outside.held = -particles.held_impulse;
    outside.stress = particles.stress_impulse;
    outside.constant = particles.constant_impulse;
    outside.pressure_lag = particles.pressure_impulse - fluid.seen_pressure;
    owed_pressure_ = fluid.owed_pressure;
    momentum_.close(fluid.momentum + particles.momentum + pending_ + owed_pressure_, outside, changed,
                    moving(particles));
  }
  /// At least the sum of m |v|, whatever the directions: sqrt(2 E m), kg m/s.
  static double moving(const ParticleReport& particles) {
    return std::sqrt(2 * particles.kinetic_energy * particles.mass);
  }
  void enter(const FluidReport& fluid, WindowBalance balance) {
    balance.liquid_volume = fluid.liquid_volume;
    balance.liquid_in = fluid.liquid_in + fluid.replaced_liquid - replaced_liquid_;
    replaced_liquid_ = fluid.replaced_liquid;
    ledger_.close(balance);
  }

  ExchangeScheme scheme_;
  Schedule schedule_;
  Vec3 pending_, unplaced_, owed_pressure_;
  double came_ = 0, gone_ = 0;  // particles inserted; left and lost; up to the last window
  double replaced_liquid_ = 0;  // m3
  Vec3 replacement_impulse_;
  double gone_impulse_ = 0;
  std::optional<double> volume_before_;  // of the particles, a window ago, m3
  Ledger ledger_;
  MomentumBooks momentum_;
};

}  // namespace demvof
