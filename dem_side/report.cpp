// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupler/base/mpi_check.hpp"
#include "coupler/output/machine.hpp"
#include "dem_side/soft_contacts.hpp"

namespace demvof {
namespace {

// Sums over particles and cells; plain doubles, so that one reduction does for all of them.
struct Sums {
  double count = 0, waiting_for_fluid = 0, outside_fluid = 0;
  double mass = 0, solid_volume = 0, solid_volume_bulk = 0, replaced_volume = 0;
  double kinetic_energy = 0, potential_energy = 0;
  WindowImpulses impulses;
  Vec3 drag_impulse_bulk, unplaced_left_over;
  double touching = 0, on_soft_springs = 0;
  double peak_memory_bytes = 0;
};
struct Extremes {
  double front[3];
  double max_speed = 0;
  double holding_window = 0, stiffness_rate = 0;  // of soft contacts
};

void reduce(double* values, std::size_t bytes, MPI_Op operation, MPI_Comm world) {
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(bytes / sizeof(double)), MPI_DOUBLE,
                          operation, world),
            "MPI_Allreduce");
}

void count_closures(const FluidForces& forces, MPI_Comm world, ParticleReport& report) {
  std::size_t next = 0;
  for (const auto& [name, count] : forces.closures())
    report.closures.at(next++) = {count.evaluations, count.outside};
  reduce(&report.closures[0].evaluations, sizeof(report.closures), MPI_SUM, world);
}

}  // namespace

Vec3 half_step_momentum(const Dem& dem) {
  const ParticleArrays particles = dem.particles();
  Vec3 momentum;
  for (int i = 0; i < particles.count; ++i)
    if (dem.integrates(i)) {
      const bool clump = particles.in_clump(i);
      const double mass = particles.mass[i];
      momentum += mass * (clump ? particles.of_clump[i].velocity : vec3(particles.velocity[i]));
      if (!dem.stream(i).carries) momentum += 0.5 * dem.time_step() * vec3(particles.force[i]);
      if (clump && dem.has_weight(particles.mask[i]))  // which LIGGGHTS gives the whole
        momentum += 0.5 * dem.time_step() * mass * dem.script_gravity();
    }
  reduce(&momentum.x, sizeof(Vec3), MPI_SUM, dem.world());
  return momentum;
}

Report::Report(const Dem& dem)
    : dem_(dem),
      contact_stiffness_(dem.contact_stiffness()),
      count_(dem.census().whole),
      inserted_before_(dem.inserted()),
      left_before_(dem.taken_out()) {}

// A particle that is gone and that no outlet of the script has taken has slipped through a wall or left the
// box.
void Report::count_changes(long now) {
  const long inserted = dem_.inserted() - inserted_before_, left = dem_.taken_out() - left_before_;
  const long gone = count_ + (inserted - inserted_) - now;
  lost_ += gone - (left - left_);
  left_ = left;
  inserted_ = inserted;
  count_ = now;
}

ParticleReport Report::window(const FluidForces& forces, const Averaging& averaging, double replaced_volume,
                              const WallSeconds& seconds) {
  const ParticleArrays particles = dem_.particles();
  const Vec3 gravity = dem_.gravity();
  constexpr double lowest = std::numeric_limits<double>::lowest();

  Sums sums;
  Extremes extremes{{lowest, lowest, lowest}};
  sums.count = static_cast<double>(dem_.whole_particles());
  for (int i = 0; i < particles.count; ++i) {
    const double mass = particles.mass[i];
    const Vec3 position = vec3(particles.position[i]), velocity = vec3(particles.velocity[i]);
    sums.mass += mass;
    if (!averaging.outside(i)) sums.solid_volume += particles.volume(i);
    sums.kinetic_energy += 0.5 * mass * dot(velocity, velocity);
    sums.potential_energy -= mass * dot(gravity, position);
    for (int axis = 0; axis < 3; ++axis)
      extremes.front[axis] = std::max(extremes.front[axis], position[axis] + particles.radius[i]);
    extremes.max_speed = std::max(extremes.max_speed, norm(velocity));
  }
  for (int k = 0; k < averaging.fluids(); ++k)
    for (const BulkParticles& cell : averaging.in(k).deposited().values) {
      sums.solid_volume_bulk += cell.solid_volume;
      sums.drag_impulse_bulk += cell.drag_impulse;
    }
  const SoftContacts soft = count_soft_contacts(dem_, forces, contact_stiffness_);
  sums.touching = soft.touching;
  sums.on_soft_springs = soft.soft;
  extremes.holding_window = soft.holding_window;
  extremes.stiffness_rate = soft.rate;
  sums.replaced_volume = replaced_volume;
  sums.impulses = forces.impulses();
  sums.outside_fluid = static_cast<double>(averaging.outside());
  sums.waiting_for_fluid = static_cast<double>(forces.waiting_for_fluid());
  sums.unplaced_left_over = averaging.unplaced_left_over();
  sums.peak_memory_bytes = static_cast<double>(peak_memory_bytes());
  reduce(&sums.count, sizeof(Sums), MPI_SUM, dem_.world());
  reduce(extremes.front, sizeof(Extremes), MPI_MAX, dem_.world());
  count_changes(std::lround(sums.count));

  ParticleReport report;
  report.count = static_cast<double>(count_);
  report.inserted = static_cast<double>(inserted_);
  report.left = static_cast<double>(left_);
  report.lost = static_cast<double>(lost_);
  report.waiting_for_fluid = std::max(sums.waiting_for_fluid - outside_before_, 0.0);
  report.outside_fluid = sums.outside_fluid;
  outside_before_ = sums.outside_fluid;
  report.touching = sums.touching;
  report.on_soft_springs = sums.on_soft_springs;
  report.holding_window = extremes.holding_window;
  if (extremes.stiffness_rate > 0) report.mild_window = stiff_in_a_window / extremes.stiffness_rate;
  report.mass = sums.mass;
  report.solid_volume = sums.solid_volume;
  report.solid_volume_bulk = sums.solid_volume_bulk;
  report.replaced_volume = sums.replaced_volume;
  report.kinetic_energy = sums.kinetic_energy;
  report.potential_energy = sums.potential_energy;
  report.max_speed = extremes.max_speed;
  report.solid_front = {extremes.front[0], extremes.front[1], extremes.front[2]};
  report.momentum = half_step_momentum(dem_);
  report.drag_impulse = sums.impulses.drag;
  report.pressure_impulse = sums.impulses.pressure;
  report.left_over_given = sums.impulses.left_over;
  report.stress_impulse = sums.impulses.stress;
  report.constant_impulse = sums.impulses.constant;
  report.held_impulse = sums.impulses.held;
  report.contact_impulse = sums.impulses.contact;
  report.gravity_impulse = sums.impulses.gravity;
  report.drag_impulse_bulk = sums.drag_impulse_bulk;
  report.left_over_unplaced = sums.unplaced_left_over;
  const SolidRelief relief = averaging.relief();
  report.relieved_cells = static_cast<double>(relief.cells);
  report.relieved_volume = relief.volume;
  report.unplaced_volume = relief.not_placed;
  report.steps = forces.steps();
  report.dem_seconds = seconds.dem;
  report.averaging_seconds = seconds.averaging;
  report.exchange_seconds = seconds.exchange;
  report.waiting_seconds = seconds.waiting;
  report.peak_memory_bytes = sums.peak_memory_bytes;
  count_closures(forces, dem_.world(), report);
  if (const auto own = forces.spin_impulses()) {
    SpinImpulses all = *own;
    reduce(&all.fluid.x, sizeof(all), MPI_SUM, dem_.world());
    report.spin_momentum = half_step_spin(dem_);
    report.torque_impulse = all.fluid;
    report.contact_torque_impulse = all.contact;
  }
  return report;
}

}  // namespace demvof
