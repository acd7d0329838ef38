// SPDX-License-Identifier: GPL-3.0-or-later
// Both ends in one file: each message is sent and received side by side.
#include "coupler/link/pair_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "coupler/exchange/window_rule.hpp"
#include "coupler/link/fluid_end.hpp"
#include "coupler/link/output_due.hpp"
#include "coupler/link/particle_end.hpp"

namespace demvof {
namespace {

template <class T>
void require(bool planned, const std::optional<T>& message) {
  if (message.has_value() != planned) throw std::logic_error("PairEnd: a message against the plan");
}

}  // namespace

double PairEnd::time_of_step(long step) const {
  return std::stod(fmt::format("{:.15g}", static_cast<double>(step) * plan_.steps.length));
}

bool PairEnd::writes() const {
  return done() || !goes_on_ || output_due(begin_time(), end_time(), plan_.output_interval);
}

// The start.

void FluidEnd::send_plan(const WindowPlan& plan) {
  start_with(plan);
  link_.send_record(plan);
}
const WindowPlan& ParticleEnd::receive_plan() {
  start_with(link_.receive_record<WindowPlan>());
  return plan_;
}

FluidEnd::Start FluidEnd::start(const Openings& openings, const CellValues<BulkSurface>& surface) {
  link_.send(openings.shares);
  link_.send(openings.walls);
  if (plan_.fluids > 1) link_.send(surface);
  Start start;
  for (int k = 0; k < plan_.fluids; ++k) start.particles.push_back(link_.receive<BulkParticles>());
  start.report = link_.receive_record<ParticleReport>();
  return start;
}
Openings ParticleEnd::openings() {
  Openings openings;
  openings.shares = link_.receive<double>();
  openings.walls = link_.receive<BulkWalls>();
  return openings;
}
void ParticleEnd::start(const std::vector<CellValues<BulkParticles>>& particles,
                        const ParticleReport& report) {
  require_one_per_fluid(particles);
  for (const CellValues<BulkParticles>& in_fluid : particles) link_.send(in_fluid);
  link_.send_record(report);
}

// A window.

void FluidEnd::set_steps(long wanted) {
  long until = plan_.steps.whole_run;
  if (plan_.output_interval > 0)
    until = std::min(until, next_output_step(first_step_, plan_.steps.length, plan_.output_interval));
  steps_ = equal_part(until - first_step_, wanted);
}

void FluidEnd::window(const FluidMessage& fluid, const std::function<void()>& advance,
                      const std::function<void(ParticleMessage)>& take) {
  require_one_per_fluid(fluid.means);
  if (plan_.gradients) require_one_per_fluid(fluid.gradients);
  require(plan_.interface, fluid.interface);
  require(plan_.mesh_moves, fluid.openings);
  if (plan_.own_lengths()) link_.send_record(steps_);
  if (plan_.mesh_moves) {
    link_.send(fluid.openings->shares);
    link_.send(fluid.openings->walls);
  }
  if (plan_.fluids > 1) link_.send(fluid.surface);
  for (const CellValues<BulkFluid>& means : fluid.means) link_.send(means);
  for (int k = 0; k < plan_.fluids && plan_.gradients; ++k) link_.send(fluid.gradients[k]);
  if (plan_.interface) link_.send(*fluid.interface);

  const auto receive = [&] {
    ParticleMessage particles;
    for (int k = 0; k < plan_.fluids; ++k) particles.sums.push_back(link_.receive<BulkParticles>());
    if (plan_.interface) particles.droplets = link_.receive<Droplet>();
    take(std::move(particles));
  };
  if (plan_.schedule == Schedule::staggered) {
    receive();  // they have done this window
    advance();
  } else {
    link_.deliver();            // they do this window now, the fluid with what they did in the last
    if (is_first()) receive();  // what they expect: nothing was done before
    advance();
    receive();
  }
}
FluidMessage ParticleEnd::fluid() {
  FluidMessage fluid;
  if (plan_.own_lengths()) steps_ = link_.receive_record<long>();
  if (plan_.mesh_moves) fluid.openings = openings();
  if (plan_.fluids > 1) fluid.surface = link_.receive<BulkSurface>();
  for (int k = 0; k < plan_.fluids; ++k) fluid.means.push_back(link_.receive<BulkFluid>());
  for (int k = 0; k < plan_.fluids && plan_.gradients; ++k)
    fluid.gradients.push_back(link_.receive<BulkFluidGradients>());
  if (plan_.interface) fluid.interface = link_.receive<BulkInterface>();
  return fluid;
}
void ParticleEnd::send(const ParticleMessage& particles) {
  require(plan_.interface, particles.droplets);
  require_one_per_fluid(particles.sums);
  for (const CellValues<BulkParticles>& in_fluid : particles.sums) link_.send(in_fluid);
  if (plan_.interface) link_.send(*particles.droplets);
}

ParticleReport FluidEnd::close_window() {
  const auto report = link_.receive_record<ParticleReport>();
  agree();
  return report;
}
void ParticleEnd::close_window(const ParticleReport& report) {
  link_.send_record(report);
  agree();
}

}  // namespace demvof
