// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "coupler/base/mpi_check.hpp"
#include "coupler/output/machine.hpp"

namespace demvof {
namespace {

// Sums over particles and cells; plain doubles, so that one reduction does for all of them.
struct Sums {
  double count = 0, waiting_for_fluid = 0, outside_bulk_grid = 0;
  double mass = 0, solid_volume = 0, solid_volume_bulk = 0, replaced_volume = 0;
  double kinetic_energy = 0, potential_energy = 0;
  WindowImpulses impulses;
  Vec3 drag_impulse_bulk, unplaced_left_over;
  double peak_memory_bytes = 0;
};
struct Extremes {
  double front[3];
  double max_speed = 0;
};

void reduce(double* values, std::size_t bytes, MPI_Op operation, MPI_Comm world) {
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(bytes / sizeof(double)), MPI_DOUBLE,
                          operation, world),
            "MPI_Allreduce");
}

nlohmann::json array(const Vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::json closures(const FluidForces& forces, MPI_Comm world) {
  nlohmann::json counts = nlohmann::json::object();
  for (auto& [name, count] : forces.closures()) {
    ClosureCount sum = count;
    reduce(&sum.evaluations, sizeof(sum), MPI_SUM, world);
    counts[name] = {{"evaluations", std::lround(sum.evaluations)}, {"outside", std::lround(sum.outside)}};
  }
  return counts;
}

}  // namespace

Vec3 half_step_momentum(const Dem& dem) {
  const ParticleArrays particles = dem.particles();
  Vec3 momentum;
  for (int i = 0; i < particles.count; ++i)
    if (dem.moves(particles.mask[i]))
      momentum +=
          particles.mass[i] * vec3(particles.velocity[i]) + 0.5 * dem.time_step() * vec3(particles.force[i]);
  reduce(&momentum.x, sizeof(Vec3), MPI_SUM, dem.world());
  return momentum;
}

Report::Report(const Dem& dem)
    : dem_(dem),
      count_(dem.census().count),
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

std::string Report::window(const FluidForces& forces, const Averaging& averaging, double replaced_volume,
                           const WallSeconds& seconds) {
  const ParticleArrays particles = dem_.particles();
  const Vec3 gravity = dem_.gravity();
  constexpr double lowest = std::numeric_limits<double>::lowest();

  Sums sums;
  Extremes extremes{{lowest, lowest, lowest}, 0};
  sums.count = particles.count;
  for (int i = 0; i < particles.count; ++i) {
    const double mass = particles.mass[i];
    const Vec3 position = vec3(particles.position[i]), velocity = vec3(particles.velocity[i]);
    sums.mass += mass;
    sums.solid_volume += sphere_volume(particles.radius[i]);
    sums.kinetic_energy += 0.5 * mass * dot(velocity, velocity);
    sums.potential_energy -= mass * dot(gravity, position);
    for (int axis = 0; axis < 3; ++axis)
      extremes.front[axis] = std::max(extremes.front[axis], position[axis] + particles.radius[i]);
    extremes.max_speed = std::max(extremes.max_speed, norm(velocity));
  }
  for (const BulkParticles& cell : averaging.deposited().values) {
    sums.solid_volume_bulk += cell.solid_volume;
    sums.drag_impulse_bulk += cell.drag_impulse;
  }
  sums.replaced_volume = replaced_volume;
  sums.impulses = forces.impulses();
  sums.waiting_for_fluid = static_cast<double>(forces.waiting_for_fluid());
  sums.outside_bulk_grid = static_cast<double>(averaging.outside());
  sums.unplaced_left_over = averaging.unplaced_left_over();
  sums.peak_memory_bytes = static_cast<double>(peak_memory_bytes());
  reduce(&sums.count, sizeof(Sums), MPI_SUM, dem_.world());
  reduce(extremes.front, sizeof(Extremes), MPI_MAX, dem_.world());
  count_changes(std::lround(sums.count));

  nlohmann::json report = {
      {"count", count_},
      {"inserted", inserted_},
      {"left", left_},
      {"lost", lost_},
      {"waiting_for_fluid", std::lround(sums.waiting_for_fluid)},
      {"outside_bulk_grid", std::lround(sums.outside_bulk_grid)},
      {"mass", sums.mass},
      {"solid_volume", sums.solid_volume},
      {"solid_volume_bulk", sums.solid_volume_bulk},
      {"replaced_volume", sums.replaced_volume},
      {"kinetic_energy", sums.kinetic_energy},
      {"potential_energy", sums.potential_energy},
      {"max_speed", extremes.max_speed},
      {"momentum", array(half_step_momentum(dem_))},
      {"drag_impulse", array(sums.impulses.drag)},
      {"drag_impulse_bulk", array(sums.drag_impulse_bulk)},
      {"pressure_impulse", array(sums.impulses.pressure)},
      {"left_over_given", array(sums.impulses.left_over)},
      {"left_over_unplaced", array(sums.unplaced_left_over)},
      {"stress_impulse", array(sums.impulses.stress)},
      {"constant_impulse", array(sums.impulses.constant)},
      {"contact_impulse", array(sums.impulses.contact)},
      {"gravity_impulse", array(sums.impulses.gravity)},
      {"held_impulse", array(sums.impulses.held)},
      {"closures", closures(forces, dem_.world())},
      {"relieved_cells", averaging.relief().cells},
      {"relieved_volume", averaging.relief().volume},
      {"unplaced_volume", averaging.relief().not_placed},
      {"steps", forces.steps()},
      {"seconds",
       {{"dem", seconds.dem},
        {"averaging", seconds.averaging},
        {"exchange", seconds.exchange},
        {"waiting", seconds.waiting}}},
      {"peak_memory_bytes", sums.peak_memory_bytes},
  };
  if (count_ > 0) report["solid_front"] = extremes.front;
  return report.dump();
}

}  // namespace demvof
