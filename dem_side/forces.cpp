// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/forces.hpp"

#include <fmt/format.h>

#include <cassert>
#include <type_traits>

#include "coupler/base/errors.hpp"
#include "coupler/closures/drag.hpp"
#include "coupler/closures/lift.hpp"
#include "coupler/closures/own_wake.hpp"
#include "coupler/config/enum_names.hpp"
#include "dem_side/implicit_drag.hpp"

namespace demvof {
namespace {

constexpr const char* rows_name = "demvof_fluid";
constexpr const char* gradient_rows_name = "demvof_fluid_gradients";

// LIGGGHTS keeps and moves the rows; Carried names the doubles in one of them.
template <class Carried = CarriedFluid>
Carried& carried_by(double* const* rows, int i) {
  static_assert(std::is_standard_layout_v<Carried> && alignof(Carried) == alignof(double));
  return *reinterpret_cast<Carried*>(rows[i]);
}

// A law as the particle loop has it: inlined, chosen once.
using DragFunction = double(double diameter, double density, double viscosity, double slip, double eps);
template <DragFunction* law>
struct DragClosure {
  DragRange range;
  double factor(const CarriedFluid& fluid, double diameter, double slip, ClosureCount& count) const {
    const double eps = fluid.void_fraction;
    const double reynolds = superficial_reynolds(diameter, fluid.density, fluid.viscosity, slip, eps);
    ++count.evaluations;
    count.outside += !range.contains(reynolds, eps);
    return law(diameter, fluid.density, fluid.viscosity, slip, eps);
  }
};
struct NoDrag {
  double factor(const CarriedFluid&, double, double, ClosureCount&) const { return 0; }
};

// Drag factor for the slip that is seen when the drag follows the slip without the particle's own wake, which
// is slip / (1 - psi); psi at that slip, which one repetition finds.
template <class Drag>
double without_own_wake(const Drag& law, const CarriedFluid& fluid, double diameter, double slip,
                        double width, ClosureCount& count) {
  const auto ratio = [&](double beta, double true_slip) {
    return 1 / (1 - own_wake_share(beta, fluid.density, fluid.viscosity, true_slip, width));
  };
  ClosureCount first_guess;
  const double true_slip = slip * ratio(law.factor(fluid, diameter, slip, first_guess), slip);
  const double beta = law.factor(fluid, diameter, true_slip, count);
  return beta * ratio(beta, true_slip);
}

// Relative change of the slip over which the drag's slope is taken.
constexpr double tangent_step = 1e-3;

// Gravity is added by LIGGGHTS as the same product of the same numbers, so that what is left of a
// particle that touches nothing is zero or a last bit of its weight.
bool touches(const Vec3& contact, const Vec3& weight) {
  return dot(contact, contact) > 1e-20 * dot(weight, weight);
}

constexpr Vec3 WindowImpulses::*window_impulses[] = {
    &WindowImpulses::drag, &WindowImpulses::pressure, &WindowImpulses::left_over, &WindowImpulses::stress,
    &WindowImpulses::held, &WindowImpulses::contact,  &WindowImpulses::gravity,   &WindowImpulses::constant};

// The own wake is that of a point force when it is spread over at least a diameter.
void require_spread(const WakeWidth& width, double diameter) {
  if (width(diameter) >= diameter) return;
  throw InputError(fmt::format(
      "forces.own_wake: averaging spreads a particle's force over {:.3g} m in the velocity that it feels, "
      "which "
      "must be a diameter ({:.3g} m) at least: use wider bulk cells or a wider kernel, or leave own_wake out",
      width(diameter), diameter));
}

void store(double* components, const Vec3& vector) {
  components[0] = vector.x;
  components[1] = vector.y;
  components[2] = vector.z;
}

}  // namespace

FluidForces::FluidForces(Dem& dem, const ForceParameters& parameters) : dem_(dem), parameters_(parameters) {
  dem_.add_particle_rows(rows_name, row_width<CarriedFluid>());
  if (need_gradients(parameters)) dem_.add_particle_rows(gradient_rows_name, row_width<CarriedGradients>());
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
      attach(DragClosure<beetstra>{beetstra_range});
      break;
    case DragLaw::rong:
      attach(DragClosure<rong>{rong_range});
      break;
  }
}

void FluidForces::take_out_own_wake(const WakeWidth& width, double largest_diameter) {
  require_spread(width, largest_diameter);
  own_wake_width_ = width;
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

double FluidForces::mean_drag_factor(const CarriedFluid& fluid) const {
  return steps_ > 0 ? fluid.drag_factor_sum / steps_ : 0;
}

double FluidForces::mean_drag_tangent(const CarriedFluid& fluid) const {
  return fluid.drag_exponent * mean_drag_factor(fluid);
}

void FluidForces::go_on_from(double window, int steps) {
  window_ = window;
  steps_ = steps;
}

void FluidForces::begin_window(const std::vector<FluidAtParticle>& fluid, double window) {
  const ParticleArrays particles = dem_.particles();
  assert(static_cast<int>(fluid.size()) == particles.count);
  double* const* rows = dem_.particle_rows(rows_name);
  double* const* gradient_rows =
      need_gradients(parameters_) ? dem_.particle_rows(gradient_rows_name) : nullptr;
  for (int i = 0; i < particles.count; ++i) {
    const FluidAtParticle& here = fluid[i];
    if (own_wake_width_) require_spread(*own_wake_width_, 2 * particles.radius[i]);
    const double volume = sphere_volume(particles.radius[i]);
    const double beta = mean_drag_factor(carried_by(rows, i));  // of the window that left something over
    CarriedFluid carried;
    carried.velocity = here.velocity;
    carried.density = here.density;
    carried.viscosity = here.viscosity;
    carried.void_fraction = here.void_fraction;
    if (parameters_.pressure_gradient) carried.pressure_force = -volume * here.pressure_gradient;
    carried.left_over_force = beta / window * here.left_over_rate;
    carried_by(rows, i) = carried;
    if (gradient_rows)
      carried_by<CarriedGradients>(gradient_rows, i) = {
          volume * here.gradients.stress_force, here.gradients.acceleration, here.gradients.vorticity, {}};
  }
  begun_ = true;
  window_ = window;
  steps_ = 0;
  force_sums_ = {};
  drag_count_ = lift_count_ = {};
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

template <bool with_gradients, class Drag>
void FluidForces::add_forces(const Drag& drag_law, const ParticleArrays& particles, double* const* external) {
  const Vec3 constant = parameters_.constant;
  if (!begun_) {  // Dem::set_up(): the forces before the first step, without fluid
    for (int i = 0; i < particles.count; ++i)
      store(external[i], dem_.moves(particles.mask[i]) ? constant : Vec3{});
    return;
  }
  const double step = dem_.time_step();
  const Vec3 gravity = dem_.gravity();
  double* const* rows = dem_.particle_rows(rows_name);
  double* const* gradient_rows = with_gradients ? dem_.particle_rows(gradient_rows_name) : nullptr;
  WindowImpulses sums;  // of this step alone: fewer numbers in one sum, less round-off
  for (int i = 0; i < particles.count; ++i) {
    CarriedFluid& fluid = carried_by(rows, i);
    const double mass = particles.mass[i], diameter = 2 * particles.radius[i];
    const bool moves = dem_.moves(particles.mask[i]);
    const Vec3 weight = dem_.has_weight(particles.mask[i]) ? mass * gravity : Vec3{};
    const Vec3 contact = vec3(particles.force[i]) - weight;
    fluid.contact_steps += touches(contact, weight);
    if (moves) {
      fluid.contact_impulse += step * contact;
      sums.contact += contact;
      sums.gravity += weight;
      sums.constant += constant;
    }
    store(external[i], moves ? constant : Vec3{});
    if (fluid.density == 0) continue;

    const Vec3 slip = fluid.velocity - vec3(particles.velocity[i]);
    const auto factor = [&](double speed, ClosureCount& count) {
      return own_wake_width_
                 ? without_own_wake(drag_law, fluid, diameter, speed, (*own_wake_width_)(diameter), count)
                 : drag_law.factor(fluid, diameter, speed, count);
    };
    const double beta = factor(norm(slip), drag_count_);
    if (steps_ == 0) {
      ClosureCount further;
      fluid.drag_exponent =
          drag_exponent(beta, factor((1 + tangent_step) * norm(slip), further), tangent_step);
    }
    Vec3 steady = fluid.pressure_force + fluid.left_over_force;
    Vec3 given;  // by the exchange: its reaction goes to the fluid
    if constexpr (with_gradients) {
      CarriedGradients& gradients = carried_by<CarriedGradients>(gradient_rows, i);
      const double added = added_mass(fluid, particles.radius[i]);
      const Vec3 across = lift(fluid, gradients, diameter, slip);
      steady += gradients.stress_force;
      sums.stress += gradients.stress_force;
      Vec3 drag = beta * slip, acceleration;
      if (moves) {
        const Vec3 others = contact + weight + constant + steady + across + added * gradients.acceleration;
        drag = implicit_drag(beta, slip, others, mass + added, step);
        acceleration = (drag + others) / (mass + added);
      }
      const Vec3 other = across + added * (gradients.acceleration - acceleration);
      gradients.other_impulse += step * other;
      given = drag + other;
    } else {
      const Vec3 others = contact + weight + constant + steady;
      given = moves ? implicit_drag(beta, slip, others, mass, step) : beta * slip;
    }
    fluid.drag_factor_sum += beta;
    fluid.drag_impulse += step * given;
    sums.drag += given;
    sums.pressure += fluid.pressure_force;
    sums.left_over += fluid.left_over_force;
    if (moves)
      store(external[i], given + steady + constant);
    else
      sums.held += given + steady;
  }
  for (Vec3 WindowImpulses::*part : window_impulses) force_sums_.*part += sums.*part;
  ++steps_;
}

std::vector<BulkParticles> FluidForces::contributions() const {
  const ParticleArrays particles = dem_.particles();
  std::vector<BulkParticles> contributions(particles.count);
  double* const* rows = dem_.particle_rows(rows_name);
  double* const* gradient_rows =
      need_gradients(parameters_) ? dem_.particle_rows(gradient_rows_name) : nullptr;
  for (int i = 0; i < particles.count; ++i) {
    const CarriedFluid& fluid = carried_by(rows, i);
    const double beta = mean_drag_factor(fluid), tangent = mean_drag_tangent(fluid);
    const double held = dem_.moves(particles.mask[i]) && steps_ > 0 ? fluid.contact_steps / steps_ : 1;
    const double added = added_mass(fluid, particles.radius[i]);
    const double response = drag_response(tangent, particles.mass[i], window_, held, added);
    BulkParticles& here = contributions[i];
    here.solid_volume = sphere_volume(particles.radius[i]);
    if (dem_.moves(particles.mask[i])) {
      const double inertia = particles.mass[i] + added;
      const double theta = inertial_share(tangent, inertia, window_);
      // Added mass: grad p and rho Du/Dt push alike.
      const double push = (1 + parameters_.added_mass) * here.solid_volume / inertia;
      here.pressure_mobility = theta * here.solid_volume * push;
      here.following_volume = (1 - theta) * here.solid_volume;
    }
    here.drag_impulse = fluid.drag_impulse;
    here.drag_factor = beta;
    here.drag_response = response;
    here.drag_weighted_velocity = beta * vec3(particles.velocity[i]);
    if (gradient_rows && window_ > 0)
      here.drag_weighted_velocity -= carried_by<CarriedGradients>(gradient_rows, i).other_impulse / window_;
    here.response_weighted_velocity = response * fluid.velocity;
  }
  return contributions;
}

std::vector<Support> FluidForces::support() const {
  const ParticleArrays particles = dem_.particles();
  std::vector<Support> support(particles.count);
  double* const* rows = dem_.particle_rows(rows_name);
  double* const* gradient_rows =
      need_gradients(parameters_) ? dem_.particle_rows(gradient_rows_name) : nullptr;
  for (int i = 0; i < particles.count; ++i) {
    const CarriedFluid& fluid = carried_by(rows, i);
    const bool moves = dem_.moves(particles.mask[i]);
    Vec3 others = fluid.pressure_force + fluid.left_over_force;
    if (gradient_rows) others += carried_by<CarriedGradients>(gradient_rows, i).stress_force;
    if (moves) others += parameters_.constant;
    if (dem_.has_weight(particles.mask[i])) others += particles.mass[i] * dem_.gravity();
    const double tangent = mean_drag_tangent(fluid), added = added_mass(fluid, particles.radius[i]);
    support[i] = {fluid.contact_impulse, fluid.drag_impulse, window_ * others,
                  drag_response(tangent, particles.mass[i], window_, moves ? 0 : 1, added)};
  }
  return support;
}

const CarriedFluid& FluidForces::carried(int i) const {
  return carried_by(dem_.particle_rows(rows_name), i);
}

std::vector<std::pair<std::string, ClosureCount>> FluidForces::closures() const {
  std::vector<std::pair<std::string, ClosureCount>> closures;
  if (parameters_.drag != DragLaw::none) closures.emplace_back(name_of(parameters_.drag), drag_count_);
  if (parameters_.lift != LiftLaw::none) closures.emplace_back(name_of(parameters_.lift), lift_count_);
  return closures;
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
  for (int i = 0; i < count; ++i) waiting += carried_by(rows, i).density == 0;
  return waiting;
}

}  // namespace demvof
