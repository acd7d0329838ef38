// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/forces.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "dem_side/act_on_lone.hpp"
#include "dem_side/drag_closures.hpp"
#include "dem_side/implicit_drag.hpp"

namespace demvof {
namespace {}  // namespace

FluidForces::FluidForces(Dem& dem, const ForceParameters& parameters) : dem_(dem), parameters_(parameters) {
  if (dem_.has_clumps()) require_known_for_clumps(parameters);
  dem_.add_particle_rows(rows_name, row_width<CarriedRow>());
  if (need_gradients(parameters))
    dem_.add_particle_rows(gradient_rows_name, row_width<CarriedGradientsRow>());
  if (parameters.torque) torque_.emplace(dem_);
  if (parameters.history) history_.emplace(dem_);
  if (parameters.lubrication) lubrication_.emplace(dem_, *parameters.lubrication);
  switch (parameters.drag) {
    case DragLaw::none:
      attach(NoDrag{});
      break;
    case DragLaw::schiller_naumann:
      attach(DragClosure{[](auto... of) { return schiller_naumann(of...); }, schiller_naumann_range});
      break;
    case DragLaw::gidaspow:
      attach(DragClosure{[](auto... of) { return gidaspow(of...); }, gidaspow_range});
      break;
    case DragLaw::di_felice:
      attach(DragClosure{[](auto... of) { return di_felice(of...); }, di_felice_range});
      break;
    case DragLaw::koch_hill:
      attach(DragClosure{[](auto... of) { return koch_hill(of...); }, koch_hill_range});
      break;
    case DragLaw::beetstra:
      attach(BeetstraOfSizes{});
      break;
    case DragLaw::rong:
      attach(DragClosure{[](auto... of) { return rong(of...); }, rong_range});
      break;
  }
}

/// At the window's first step the drag's exponent is noted as well.
template <class Drag>
[[gnu::noinline]] double FluidForces::new_drag_factor(const Drag& law, CarriedFluid& fluid, double diameter,
                                                      double slip) {
  const auto factor = [&](const auto& speed) -> Series {
    return own_wake_width_
               ? without_own_wake(law, fluid, diameter, speed, (*own_wake_width_)(diameter), drag_count_)
               : law.factor(fluid, diameter, speed, drag_count_);
  };
  LocalDrag& drag = fluid.drag;
  drag = {slip > 0 ? factor(Series::of_variable(slip)) : factor(slip), 1 / slip};
  drag.factor.reach = std::min(drag.factor.reach, LocalDrag::near_slip);
  if (fluid.drag_factor_sum == 0) fluid.drag_exponent = drag_exponent(drag.factor);
  return drag.factor.term[0];
}

template <class Drag>
void FluidForces::attach(const Drag& drag_law) {
  if (need_gradients(parameters_))
    dem_.attach([this, drag_law](const ParticleArrays& particles, double* const* added) {
      add_forces<true>(drag_law, particles, added);
    });
  else
    dem_.attach([this, drag_law](const ParticleArrays& particles, double* const* added) {
      add_forces<false>(drag_law, particles, added);
    });
}

void FluidForces::first_half_step() {
  half_step_ = true;
  dem_.renew_added_forces();
  half_step_ = false;
}

void FluidForces::go_on_from(double window, int steps) {
  window_ = window;
  steps_ = steps;
}

double* const* FluidForces::gradient_rows() const {
  return need_gradients(parameters_) ? dem_.particle_rows(gradient_rows_name) : nullptr;
}

template <bool with_gradients, class Drag>
void FluidForces::add_forces(const Drag& drag_law, const ParticleArrays& particles, double* const* added) {
  DemStep step{particles, half_step_ ? dem_.time_step() / 2 : dem_.time_step()};
  step.added = added;
  if (!begun_) {  // Dem::set_up(): the forces before the first step, without fluid
    for (int i = 0; i < particles.count; ++i)
      step.give(i, dem_.integrates(i) ? parameters_.constant : Vec3{});
    return;
  }
  step.gravity = dem_.gravity();
  step.of_script = dem_.script_gravity();
  step.rows = dem_.particle_rows(rows_name);
  step.gradients = with_gradients ? gradient_rows() : nullptr;
  // Spins begin with the torques of set-up, and what a particle remembers is of whole steps.
  step.torque = torque_ && !half_step_ ? &*torque_ : nullptr;
  step.history = history_ && !half_step_ ? &*history_ : nullptr;
  if (step.history) step.history->begin_step();
  if (lubrication_ || dem_.has_clumps()) {
    std::vector<Found> all;
    std::vector<Vec3> given;
    for (int i = 0; i < particles.count; ++i) all.push_back(find_forces<with_gradients>(drag_law, step, i));
    if (lubrication_) bear_films(step, all);
    for (int i = 0; i < particles.count; ++i) move_alone<with_gradients>(step, i, all[i]);
    if (dem_.has_clumps()) move_as_clumps(step, all);
    for (int i = 0; i < particles.count; ++i) {
      given.push_back(force_on<with_gradients>(step, i, all[i]));
      step.give(i, given.back());
    }
    if (dem_.has_clumps()) turn_clumps(particles, given);
  } else if (with_gradients || half_step_ || dem_.has_stream()) {
    for (int i = 0; i < particles.count; ++i) act_on_any<with_gradients>(drag_law, step, i);
  } else {
    have_wide ? act_on_lone_wide(drag_law, step) : act_on_lone(drag_law, step);
  }
  for (Vec3 WindowImpulses::*part : WindowImpulses::parts)
    force_sums_.*part += step.length / dem_.time_step() * (step.sums.*part);
  steps_ += !half_step_;
}

template <bool with_gradients, class Drag>
[[gnu::noinline]] void FluidForces::act_on_any(const Drag& drag_law, DemStep& step, int i) {
  Found found = find_forces<with_gradients>(drag_law, step, i);
  move_alone<with_gradients>(step, i, found);
  step.give(i, force_on<with_gradients>(step, i, found));
}

// The loop over particles waits for nothing if these become part of it.
template <bool with_gradients, class Drag>
[[gnu::always_inline]] inline FluidForces::Found FluidForces::find_forces(const Drag& drag_law, DemStep& step,
                                                                          int i) {
  const ParticleArrays& particles = step.particles;
  CarriedRow& row = carried_by(step.rows, i);
  const double mass = particles.mass[i], volume = particles.volume(i), length = step.length;
  const double diameter = particles.drag_diameter(i), drag_share = particles.drag_share(i);
  const Vec3 velocity = particles.own_velocity(i);
  const Dem::Stream stream = dem_.stream(i);
  const bool released = stream.releases && !half_step_;  // set-up is after the release
  Found found;
  const bool moves = found.moves = dem_.integrates(i) && !stream.carries && !released;
  if (released) step.sums.held -= mass / length * stream.change;
  const bool heavy = dem_.has_weight(particles.mask[i]);
  const Vec3 weight = heavy ? mass * step.gravity : Vec3{}, constant = parameters_.constant;
  const Vec3 weight_of_script = heavy ? mass * step.of_script : Vec3{};  // LIGGGHTS has added it
  const Vec3 contact = vec3(particles.force[i]) - (particles.in_clump(i) ? Vec3{} : weight_of_script);
  found.own = constant + (weight - weight_of_script);
  found.others = contact + weight + constant;
  found.touches = touches(dot(contact, contact), dot(weight_of_script, weight_of_script));
  row.contacts.touching += found.touches;
  ++row.contacts.evaluations;
  if (!half_step_)  // by the velocity of the half step: what the position has moved with
    row.path += length * vec3(particles.velocity[i]);
  if (moves && !half_step_) {  // Dem::set_up() has given half a step of these
    row.contacts.impulse += length * contact;
    step.sums.contact += contact;
    step.sums.gravity += weight;
    step.sums.constant += constant;
  } else if (moves) {
    step.sums.gravity += weight - weight_of_script;
  }
  if (row.waits()) {
    if (moves && row.known == 0) row.waited += length;
    if (step.torque) step.torque->act(particles, i, {});
    return found;
  }
  if (half_step_ && !moves) {  // what it gets in whole steps is all that it gets
    for (int k = 0; k < 2; ++k)
      if (row.feels(k))
        row.fluid[k].drag_factor_sum +=
            drag_share * row.share(k) *
            drag_factor(drag_law, row.fluid[k], diameter, norm(row.fluid[k].velocity - velocity));
    return found;
  }
  found.in_fluid = true;
  const double wetted = half_step_ ? 0 : move_surface(row.surface, velocity, particles.radius[i], length);
  const double late = half_step_ ? 0 : std::min(1.0, row.waited / length);
  row.waited -= late * length;
  FluidTorque::Grip grip;
  Vec3 accelerated;  // sum of m_a Du/Dt
  for (int k = 0; k < 2; ++k) {
    CarriedFluid& fluid = row.fluid[k];
    if (static_cast<int>(row.owed) >> k & 1) {
      found.steady += fluid.left_over_force;
      step.sums.left_over += fluid.left_over_force;
    }
    if (!row.feels(k)) continue;
    Found::Part part;
    const double share = row.share(k);
    part.slip = fluid.velocity - velocity;
    part.beta = drag_share * share * drag_factor(drag_law, fluid, diameter, norm(part.slip));
    fluid.drag_factor_sum += part.beta;
    found.steady += share * fluid.pressure_force;
    step.sums.pressure += share * fluid.pressure_force;
    part.overdue = late * share * fluid.pressure_force;
    if constexpr (with_gradients) {
      const CarriedGradients& gradients = carried_by<CarriedGradientsRow>(step.gradients, i).fluid[k];
      part.added = added_mass(row, k, volume);
      part.across = share * (lift(fluid, gradients, diameter, part.slip) +
                             spin_lift(fluid, gradients, diameter, vec3(particles.spin[i]), part.slip));
      if (step.torque)
        step.torque->add_fluid(grip, particles, i, share, fluid.density, fluid.viscosity,
                               gradients.vorticity);
      if (step.history && k == 0) {
        const HistoryForce::Memory past =
            step.history->recall(i, diameter, fluid.density, fluid.viscosity, norm(part.slip));
        part.across += past.force;
        part.added += share * past.inertia;
      }
      found.steady += share * gradients.stress_force;
      step.sums.stress += share * gradients.stress_force;
      part.overdue +=
          late * (share * gradients.stress_force + part.added * (gradients.acceleration - 1 / mass * weight));
      accelerated += part.added * gradients.acceleration;
      if (k == 0 && wetted > 0)
        part.beta +=
            parameters_.added_mass * (fluid.density - row.fluid[1].density) * volume * wetted / length;
    }
    found.beta += part.beta;
    found.added += part.added;
    found.pull += part.beta * part.slip;
    found.parts[k] = part;
  }
  if (step.torque) step.torque->act(particles, i, grip);
  if (step.history && !row.feels(0)) step.history->forget(i);
  found.others = found.others + found.steady + accelerated;
  for (const std::optional<Found::Part>& part : found.parts)
    if (part) found.others += part->across + part->overdue;
  return found;
}

template <bool with_gradients>
[[gnu::always_inline]] inline void FluidForces::move_alone(const DemStep& step, int i, Found& found) {
  const double mass = step.particles.mass[i];
  found.mean_drag = found.drag(mass, step.length);
  if (with_gradients && found.moves)
    found.acceleration = (found.mean_drag + found.others) / (mass + found.added);
}

template <bool with_gradients>
[[gnu::always_inline]] inline Vec3 FluidForces::force_on(DemStep& step, int i, const Found& found) {
  if (!found.in_fluid) return found.moves ? found.own : Vec3{};
  CarriedRow& row = carried_by(step.rows, i);
  Vec3 given;  // by the exchange: its reaction goes to the fluid
  for (int k = 0; k < 2; ++k) {
    if (!found.parts[k]) continue;
    const Found::Part& part = *found.parts[k];
    // Both fluids see the same mean velocity of the step.
    Vec3 of_fluid = part.beta == found.beta
                        ? found.mean_drag
                        : part.beta * (part.slip + (found.mean_drag - found.pull) / found.beta);
    of_fluid += part.overdue;
    if constexpr (with_gradients) {
      CarriedGradients& gradients = carried_by<CarriedGradientsRow>(step.gradients, i).fluid[k];
      if (step.history && k == 0)
        step.history->remember(i, row.share(0), part.slip, gradients.acceleration - found.acceleration);
      const Vec3 other = part.across + part.added * (gradients.acceleration - found.acceleration);
      gradients.other_impulse += step.length * (other + part.overdue);
      of_fluid += other;
    }
    row.fluid[k].drag_impulse += step.length * of_fluid;
    given += of_fluid;
  }
  step.sums.drag += given;
  if (found.moves) return given + found.steady + found.own;
  step.sums.held += given + found.steady;
  return {};
}

}  // namespace demvof
