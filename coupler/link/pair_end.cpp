// SPDX-License-Identifier: GPL-3.0-or-later
// Both ends in one file: each message is sent and received side by side.
#include "coupler/link/pair_end.hpp"

#include <stdexcept>
#include <utility>

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

bool PairEnd::writes() const {
  return number_ == plan_.windows || !goes_on_ || output_due(number_, plan_.window, plan_.output_interval);
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

FluidEnd::Start FluidEnd::start(const CellValues<double>& open_shares) {
  link_.send(open_shares);
  Start start;
  start.particles = link_.receive<BulkParticles>();
  start.report = link_.receive_record<ParticleReport>();
  return start;
}
void ParticleEnd::start(const CellValues<BulkParticles>& particles, const ParticleReport& report) {
  link_.send(particles);
  link_.send_record(report);
}

// A window.

void FluidEnd::window(const FluidMessage& fluid, const std::function<void()>& advance,
                      const std::function<void(ParticleMessage)>& take) {
  require(plan_.gradients, fluid.gradients);
  require(plan_.interface, fluid.interface);
  link_.send(fluid.means);
  if (plan_.gradients) link_.send(*fluid.gradients);
  if (plan_.interface) link_.send(*fluid.interface);

  const auto receive = [&] {
    ParticleMessage particles;
    particles.sums = link_.receive<BulkParticles>();
    if (plan_.interface) particles.droplets = link_.receive<Droplet>();
    take(std::move(particles));
  };
  if (plan_.schedule == Schedule::staggered) {
    receive();  // they have done this window
    advance();
  } else {
    link_.deliver();  // they do this window now, the fluid with what they did in the last
    advance();
    receive();
  }
}
FluidMessage ParticleEnd::fluid() {
  FluidMessage fluid;
  fluid.means = link_.receive<BulkFluid>();
  if (plan_.gradients) fluid.gradients = link_.receive<BulkFluidGradients>();
  if (plan_.interface) fluid.interface = link_.receive<BulkInterface>();
  return fluid;
}
void ParticleEnd::send(const ParticleMessage& particles) {
  require(plan_.interface, particles.droplets);
  link_.send(particles.sums);
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
