// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/forces.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "coupler/closures/lift.hpp"
#include "coupler/closures/spin_lift.hpp"
#include "coupler/config/enum_names.hpp"
#include "dem_side/drag_closures.hpp"
#include "dem_side/implicit_drag.hpp"

namespace demvof {
namespace {

// Relative change of the slip over which the drag's slope is taken.
constexpr double tangent_step = 1e-3;
// Relative change of the slip within which its drag factor follows the slope: with n between 1 and 2 it is
// good to 3e-6.
constexpr double near_slip = 5e-3;

// Gravity is added by LIGGGHTS as the same product of the same numbers, so that what is left of a
// particle that touches nothing is zero or a last bit of its weight.
bool touches(const Vec3& contact, const Vec3& weight) {
  return dot(contact, contact) > 1e-20 * dot(weight, weight);
}

constexpr Vec3 WindowImpulses::*window_impulses[] = {
    &WindowImpulses::drag, &WindowImpulses::pressure, &WindowImpulses::left_over, &WindowImpulses::stress,
    &WindowImpulses::held, &WindowImpulses::contact,  &WindowImpulses::gravity,   &WindowImpulses::constant};

void store(double* components, const Vec3& vector) {
  components[0] = vector.x;
  components[1] = vector.y;
  components[2] = vector.z;
}

}  // namespace

FluidForces::FluidForces(Dem& dem, const ForceParameters& parameters) : dem_(dem), parameters_(parameters) {
  dem_.add_particle_rows(rows_name, row_width<CarriedRow>());
  if (need_gradients(parameters))
    dem_.add_particle_rows(gradient_rows_name, row_width<CarriedGradientsRow>());
  if (parameters.torque) torque_.emplace(dem_);
  if (parameters.history) history_.emplace(dem_);
  switch (parameters.drag) {
    case DragLaw::none:
      attach(NoDrag{});
      break;
    case DragLaw::schiller_naumann:
      attach(DragClosure<schiller_naumann>{schiller_naumann_range});
      break;
    case DragLaw::gidaspow:
      attach(DragClosure<gidaspow>{gidaspow_range});
      break;
    case DragLaw::di_felice:
      attach(DragClosure<di_felice>{di_felice_range});
      break;
    case DragLaw::koch_hill:
      attach(DragClosure<koch_hill>{koch_hill_range});
      break;
    case DragLaw::beetstra:
      attach(BeetstraOfSizes{});
      break;
    case DragLaw::rong:
      attach(DragClosure<rong>{rong_range});
      break;
  }
}

/// beta of a fluid all around it, evaluated where the slip has changed; at the window's first step the drag's
/// exponent is noted as well.
template <class Drag>
double FluidForces::drag_factor(const Drag& law, CarriedFluid& fluid, double diameter, double slip) {
  const auto factor = [&](double speed, ClosureCount& count) {
    return own_wake_width_
               ? without_own_wake(law, fluid, diameter, speed, (*own_wake_width_)(diameter), count)
               : law.factor(fluid, diameter, speed, count);
  };
  LocalDrag& drag = fluid.drag;
  const auto find_exponent = [&] {
    ClosureCount further;
    drag.exponent = drag_exponent(drag.factor, factor((1 + tangent_step) * drag.slip, further), tangent_step);
  };
  if (drag.slip > 0 && std::abs(slip - drag.slip) <= near_slip * drag.slip) {
    if (drag.exponent == 0) find_exponent();
    return drag.at(slip);
  }
  drag = {factor(slip, drag_count_), slip, 0};
  if (fluid.drag_factor_sum == 0) {
    find_exponent();
    fluid.drag_exponent = drag.exponent;
  }
  return drag.factor;
}

template <class Drag>
void FluidForces::attach(const Drag& drag_law) {
  if (need_gradients(parameters_))
    dem_.attach([this, drag_law](const ParticleArrays& particles, double* const* external) {
      add_forces<true>(drag_law, particles, external);
    });
  else
    dem_.attach([this, drag_law](const ParticleArrays& particles, double* const* external) {
      add_forces<false>(drag_law, particles, external);
    });
}

double FluidForces::mean_drag_factor(const CarriedRow& row, int k) {
  return row.contacts.evaluations > 0 ? row.fluid[k].drag_factor_sum / row.contacts.evaluations : 0;
}

double FluidForces::mean_drag_tangent(const CarriedRow& row, int k) {
  return row.fluid[k].drag_exponent * mean_drag_factor(row, k);
}

bool FluidForces::moved_by_forces(int i) const {
  return dem_.moves(dem_.particles().mask[i]) && !dem_.stream(i).carries;
}

double FluidForces::held_share(const CarriedRow& row, int i) const {
  const CarriedContacts& contacts = row.contacts;
  return moved_by_forces(i) && contacts.evaluations > 0 ? contacts.touching / contacts.evaluations : 1;
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

Vec3 FluidForces::lift(const CarriedFluid& fluid, const CarriedGradients& gradients, double diameter,
                       const Vec3& slip) {
  if (parameters_.lift == LiftLaw::none) return {};
  const double speed = norm(slip), vorticity = norm(gradients.vorticity);
  const double reynolds = fluid.density * speed * diameter / fluid.viscosity;
  const bool inside =
      speed > 0 && saffman_mei_range.contains(reynolds, shear_over_slip(diameter, speed, vorticity));
  ++lift_count_.evaluations;
  lift_count_.outside += !inside;
  return saffman_mei(diameter, fluid.density, fluid.viscosity, slip, gradients.vorticity);
}

Vec3 FluidForces::spin_lift(const CarriedFluid& fluid, const CarriedGradients& gradients, double diameter,
                            const Vec3& spin, const Vec3& slip) {
  if (parameters_.spin_lift == SpinLiftLaw::none) return {};
  const bool creeping = parameters_.spin_lift == SpinLiftLaw::rubinow_keller;
  const SpinLiftRange& range = creeping ? rubinow_keller_range : oesterle_bui_dinh_range;
  const Vec3 rotation = 0.5 * gradients.vorticity - spin;
  const double speed = norm(slip);
  const double reynolds = fluid.density * speed * diameter / fluid.viscosity;
  const double over_slip = speed > 0 ? spin_over_slip(diameter, speed, norm(rotation)) : 0;
  ++spin_lift_count_.evaluations;
  spin_lift_count_.outside += !range.contains(reynolds, over_slip);
  const double factor = creeping ? 1 : oesterle_bui_dinh(reynolds, over_slip);
  return spin_lift_force(diameter, fluid.density, factor, rotation, slip);
}

template <bool with_gradients, class Drag>
void FluidForces::add_forces(const Drag& drag_law, const ParticleArrays& particles, double* const* external) {
  const Vec3 constant = parameters_.constant;
  if (!begun_) {  // Dem::set_up(): the forces before the first step, without fluid
    for (int i = 0; i < particles.count; ++i)
      store(external[i], dem_.moves(particles.mask[i]) ? constant : Vec3{});
    return;
  }
  const double step = half_step_ ? dem_.time_step() / 2 : dem_.time_step();
  const Vec3 gravity = dem_.gravity(), of_script = dem_.script_gravity();
  double* const* rows = dem_.particle_rows(rows_name);
  double* const* all_gradients = with_gradients ? gradient_rows() : nullptr;
  // Spins begin with the torques of set-up, and what a particle remembers is of whole steps.
  FluidTorque* const torque = torque_ && !half_step_ ? &*torque_ : nullptr;
  HistoryForce* const history = history_ && !half_step_ ? &*history_ : nullptr;
  if (history) history->begin_step();
  WindowImpulses sums;  // of this step alone: fewer numbers in one sum, less round-off
  for (int i = 0; i < particles.count; ++i) {
    CarriedRow& row = carried_by(rows, i);
    const double mass = particles.mass[i], radius = particles.radius[i];
    const Vec3 velocity = vec3(particles.velocity[i]);
    const Dem::Stream stream = dem_.stream(i);
    const bool released = stream.releases && !half_step_;  // set-up is after the release
    const bool moves = dem_.moves(particles.mask[i]) && !stream.carries && !released;
    if (released) sums.held -= mass / step * stream.change;
    const bool heavy = dem_.has_weight(particles.mask[i]);
    const Vec3 weight = heavy ? mass * gravity : Vec3{};
    const Vec3 weight_of_script = heavy ? mass * of_script : Vec3{};  // LIGGGHTS has added it
    const Vec3 own = constant + (weight - weight_of_script);          // what is to be added without any fluid
    const Vec3 contact = vec3(particles.force[i]) - weight_of_script;
    row.contacts.touching += touches(contact, weight_of_script);
    ++row.contacts.evaluations;
    if (!half_step_) row.path += step * velocity;  // that of the half step: what the position has moved with
    if (moves && !half_step_) {                    // Dem::set_up() has given half a step of these
      row.contacts.impulse += step * contact;
      sums.contact += contact;
      sums.gravity += weight;
      sums.constant += constant;
    } else if (moves) {
      sums.gravity += weight - weight_of_script;
    }
    store(external[i], moves ? own : Vec3{});
    if (row.waits()) {
      if (moves && row.known == 0) row.waited += step;
      if (torque) torque->act(particles, i, {});
      continue;
    }
    if (half_step_ && !moves) {  // what it gets in whole steps is all that it gets
      for (int k = 0; k < 2; ++k)
        if (row.feels(k))
          row.fluid[k].drag_factor_sum += row.share(k) * drag_factor(drag_law, row.fluid[k], 2 * radius,
                                                                     norm(row.fluid[k].velocity - velocity));
      continue;
    }
    const double wetted = half_step_ ? 0 : move_surface(row.surface, velocity, radius, step);
    struct Part {  // in one fluid
      double beta = 0, added = 0;
      Vec3 slip, across, overdue;
    } parts[2];
    const double late = half_step_ ? 0 : std::min(1.0, row.waited / step);
    row.waited -= late * step;
    FluidTorque::Grip grip;
    double beta = 0, added = 0;
    Vec3 pull, steady, accelerated;  // sums of beta slip, of what is constant in the step, of m_a Du/Dt
    for (int k = 0; k < 2; ++k) {
      CarriedFluid& fluid = row.fluid[k];
      if (static_cast<int>(row.owed) >> k & 1) {
        steady += fluid.left_over_force;
        sums.left_over += fluid.left_over_force;
      }
      if (!row.feels(k)) continue;
      Part& part = parts[k];
      const double share = row.share(k);
      part.slip = fluid.velocity - velocity;
      part.beta = share * drag_factor(drag_law, fluid, 2 * radius, norm(part.slip));
      fluid.drag_factor_sum += part.beta;
      steady += share * fluid.pressure_force;
      sums.pressure += share * fluid.pressure_force;
      part.overdue = late * share * fluid.pressure_force;
      if constexpr (with_gradients) {
        const CarriedGradients& gradients = carried_by<CarriedGradientsRow>(all_gradients, i).fluid[k];
        part.added = added_mass(row, k, radius);
        part.across = share * (lift(fluid, gradients, 2 * radius, part.slip) +
                               spin_lift(fluid, gradients, 2 * radius, vec3(particles.spin[i]), part.slip));
        if (torque)
          torque->add_fluid(grip, particles, i, share, fluid.density, fluid.viscosity, gradients.vorticity);
        if (history && k == 0) {
          const HistoryForce::Memory past =
              history->recall(i, 2 * radius, fluid.density, fluid.viscosity, norm(part.slip));
          part.across += past.force;
          part.added += share * past.inertia;
        }
        steady += share * gradients.stress_force;
        sums.stress += share * gradients.stress_force;
        part.overdue += late * (share * gradients.stress_force +
                                part.added * (gradients.acceleration - 1 / mass * weight));
        accelerated += part.added * gradients.acceleration;
        if (k == 0 && wetted > 0)
          part.beta += parameters_.added_mass * (fluid.density - row.fluid[1].density) *
                       sphere_volume(radius) * wetted / step;
      }
      beta += part.beta;
      added += part.added;
      pull += part.beta * part.slip;
    }
    if (torque) torque->act(particles, i, grip);
    if (history && !row.feels(0)) history->forget(i);
    Vec3 drag = pull, acceleration;
    if (moves) {
      const Vec3 others = contact + weight + constant + steady + parts[0].across + parts[1].across +
                          accelerated + parts[0].overdue + parts[1].overdue;
      if (beta > 0) drag = implicit_drag(beta, pull / beta, others, mass + added, step);
      acceleration = (drag + others) / (mass + added);
    }
    Vec3 given;  // by the exchange: its reaction goes to the fluid
    for (int k = 0; k < 2; ++k) {
      if (!row.feels(k)) continue;
      const Part& part = parts[k];
      // Both fluids see the same mean velocity of the step.
      Vec3 of_fluid = part.beta == beta ? drag : part.beta * (part.slip + (drag - pull) / beta);
      of_fluid += part.overdue;
      if constexpr (with_gradients) {
        CarriedGradients& gradients = carried_by<CarriedGradientsRow>(all_gradients, i).fluid[k];
        if (history && k == 0)
          history->remember(i, row.share(0), part.slip, gradients.acceleration - acceleration);
        const Vec3 other = part.across + part.added * (gradients.acceleration - acceleration);
        gradients.other_impulse += step * (other + part.overdue);
        of_fluid += other;
      }
      row.fluid[k].drag_impulse += step * of_fluid;
      given += of_fluid;
    }
    sums.drag += given;
    if (moves)
      store(external[i], given + steady + own);
    else
      sums.held += given + steady;
  }
  for (Vec3 WindowImpulses::*part : window_impulses)
    force_sums_.*part += step / dem_.time_step() * (sums.*part);
  steps_ += !half_step_;
}

const CarriedRow& FluidForces::carried(int i) const {
  return carried_by(dem_.particle_rows(rows_name), i);
}

Vec3 FluidForces::pressure_force(int i) const {
  const CarriedRow& row = carried(i);
  return row.share(0) * row.fluid[0].pressure_force + row.share(1) * row.fluid[1].pressure_force;
}

Vec3 FluidForces::drag_impulse(int i) const {
  return carried(i).fluid[0].drag_impulse + carried(i).fluid[1].drag_impulse;
}

std::vector<std::pair<std::string, ClosureCount>> FluidForces::closures() const {
  std::vector<std::pair<std::string, ClosureCount>> closures;
  if (parameters_.drag != DragLaw::none) closures.emplace_back(name_of(parameters_.drag), drag_count_);
  if (parameters_.lift != LiftLaw::none) closures.emplace_back(name_of(parameters_.lift), lift_count_);
  if (parameters_.spin_lift != SpinLiftLaw::none)
    closures.emplace_back(name_of(parameters_.spin_lift), spin_lift_count_);
  if (torque_) closures.emplace_back("torque", torque_->count());
  if (history_) closures.emplace_back("history", history_->count());
  return closures;
}

std::optional<SpinImpulses> FluidForces::spin_impulses() const {
  return torque_ ? std::optional(torque_->impulses()) : std::nullopt;
}

WindowImpulses FluidForces::impulses() const {
  WindowImpulses impulses = force_sums_;
  for (Vec3 WindowImpulses::*part : window_impulses) impulses.*part *= dem_.time_step();
  return impulses;
}

long FluidForces::waiting_for_fluid() const {
  const int count = dem_.particles().count;
  double* const* rows = dem_.particle_rows(rows_name);
  long waiting = 0;
  for (int i = 0; i < count; ++i) waiting += carried_by(rows, i).waits();
  return waiting;
}

}  // namespace demvof
