// SPDX-License-Identifier: GPL-3.0-or-later
// A stand-in for dem_side: a bed with prescribed rows, a slab of the bulk grid between two heights that holds
// the same solid fraction and drag per volume everywhere and rises with a given velocity, whatever the fluid
// does. It plays the particles' part of the window protocol with the real foam_side and books what it
// receives. Usage: mock_particles case.yaml [options below].

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "coupler/base/mpi_check.hpp"
#include "coupler/config/read_case.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/link/handshake_items.hpp"
#include "coupler/link/main_guard.hpp"
#include "coupler/link/particle_end.hpp"
#include "coupler/output/machine.hpp"
#include "coupler/output/state_frame.hpp"

namespace {

using namespace demvof;

struct Options {
  std::string case_file;
  std::vector<std::string> overrides;  // --set, as given to foam_side
  std::vector<double> bed{0, 0};       // z at the start, m
  double solid_fraction = 0.4;         // -
  double drag = 0;                     // of the bed, per volume, kg/(m3 s)
  double velocity = 0;                 // upward, m/s
  std::vector<double> gravity{0, 0, 0};
  std::vector<bool> periodic{false, false, false};
  std::string goes_on_in;  // folder of the run that foam_side continues; empty: none
};

/// The bed on the bulk grid.
class Bed {
 public:
  Bed(const Options& options, const BulkGrid& grid, const BulkPartition& partition, MPI_Comm comm)
      : options_(options), grid_(grid), comm_(comm) {
    int rank;
    check_mpi(MPI_Comm_rank(comm, &rank), "MPI_Comm_rank");
    cells_ = partition.cells(rank);
  }

  /// Its rows at a time (s), at rest so far.
  CellValues<BulkParticles> at(double time) const {
    CellValues<BulkParticles> rows;
    const double rise = options_.velocity * time;
    for (const CellId cell : cells_) {
      const double low = grid_.cell_lower(grid_.ijk(cell)).z, high = low + grid_.spacing().z;
      const double inside = std::min(high, options_.bed[1] + rise) - std::max(low, options_.bed[0] + rise);
      if (inside <= 0) continue;
      const double volume = inside / grid_.spacing().z * grid_.cell_volume();
      BulkParticles row;
      row.solid_volume = options_.solid_fraction * volume;
      row.drag_factor = row.drag_response = options_.drag * volume;
      row.drag_weighted_velocity = row.drag_factor * velocity();
      row.solid_flux = row.solid_volume * velocity();
      rows.cells.push_back(cell);
      rows.values.push_back(row);
    }
    return rows;
  }

  /// Lets the fluid act for a window on rows that at() made. A cell that the fluid was not told about feels
  /// the mean of the others.
  void feel(const CellValues<BulkFluid>& fluid, double window, CellValues<BulkParticles>& rows) const {
    Vec3 mean;
    for (const BulkFluid& cell : fluid.values) mean += cell.velocity;
    mean = sum(mean) / std::max(1.0, sum(Vec3{double(fluid.cells.size()), 0, 0}).x);
    for (std::size_t i = 0; i < rows.cells.size(); ++i) {
      BulkParticles& row = rows.values[i];
      const BulkFluid* cell = find(fluid, rows.cells[i]);
      const Vec3 felt = cell ? cell->velocity : mean;
      row.drag_impulse = window * row.drag_factor * (felt - velocity());
      row.response_weighted_velocity = row.drag_response * felt;
    }
  }

  /// What it expects of the fluid before it has done anything: as feel(), but owed to it.
  void expect(const CellValues<BulkFluid>& fluid, double window, CellValues<BulkParticles>& rows) const {
    feel(fluid, window, rows);
    for (BulkParticles& row : rows.values) {
      row.response_weighted_velocity -= row.drag_impulse / window;
      row.drag_impulse = {};
    }
  }

  /// What it received in a window that began with `before`, and what it is now.
  ParticleReport report(const CellValues<BulkParticles>& before, const CellValues<BulkFluid>& fluid,
                        const CellValues<BulkParticles>& now, double window) const {
    ParticleReport report;
    for (const BulkParticles& row : now.values) {
      report.solid_volume += row.solid_volume;
      report.drag_impulse += row.drag_impulse;
    }
    for (std::size_t i = 0; i < fluid.cells.size(); ++i) {
      const BulkParticles* row = find(before, fluid.cells[i]);
      if (row) report.pressure_impulse -= window * row->solid_volume * fluid.values[i].pressure_gradient;
      (row && row->drag_factor > 0 ? report.left_over_given : report.left_over_unplaced) +=
          fluid.values[i].left_over;
    }
    report.solid_volume = sum(Vec3{report.solid_volume, 0, 0}).x;
    report.solid_volume_bulk = report.solid_volume;
    report.drag_impulse = report.drag_impulse_bulk = sum(report.drag_impulse);
    report.pressure_impulse = sum(report.pressure_impulse);
    report.left_over_given = sum(report.left_over_given);
    report.left_over_unplaced = sum(report.left_over_unplaced);
    report.held_impulse = report.drag_impulse + report.pressure_impulse + report.left_over_given;
    report.count = 1;
    return report;
  }

 private:
  Vec3 velocity() const { return {0, 0, options_.velocity}; }
  Vec3 sum(Vec3 part) const {
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, &part, 3, MPI_DOUBLE, MPI_SUM, comm_), "MPI_Allreduce");
    return part;
  }

  const Options& options_;
  BulkGrid grid_;
  MPI_Comm comm_;
  std::vector<CellId> cells_;  // of this rank
};

std::string facts(const Options& options, double solid_volume, double step, const OwnWorld& world) {
  return nlohmann::json{{"particle_count", 1},
                        {"min_diameter", 1e-3},
                        {"max_diameter", 1e-3},
                        {"solid_volume", solid_volume},
                        {"inserts_particles", false},
                        {"time_step", step},
                        {"periodic", options.periodic},
                        {"collision_time", 0},
                        {"rayleigh_time", 0},
                        {"lightest_response", 0},
                        {"largest_solid_fraction", options.solid_fraction},
                        {"closures", nlohmann::json::array()},
                        {"momentum", {0, 0, 0}},
                        {"ranks", world.size()}}
      .dump();
}

int play(const Options& options, OwnWorld& world) {
  const CaseParameters parameters = read_case(options.case_file, options.overrides);
  const BulkGridParameters& box = *parameters.bulk_grid;
  const BulkGrid grid(box.lower, box.upper, box.cells);
  ParticleEnd link(world, grid.cells(), parameters.coupling.time_out);
  const Bed bed(options, grid, link.mine(), world.comm());
  const std::vector<double>& g = options.gravity;
  CellValues<BulkParticles> rows = bed.at(0);
  const double solid_volume = bed.report({}, {}, rows, 0).solid_volume;
  std::string state = "no";
  if (!options.goes_on_in.empty())
    state = read_restart_point(options.goes_on_in, {}, state_frame(parameters, parameters.fluid.ranks),
                               parameters.coupling.end_time)
                .checksum;
  const auto& adaptive = parameters.coupling.adaptive_window;
  const double step = adaptive ? adaptive->shortest : parameters.coupling.window;
  link.handshake(handshake_items(version(), configuration_hash(parameters), {g[0], g[1], g[2]}, {}, state),
                 facts(options, solid_volume, step, world));
  const WindowPlan& plan = link.receive_plan();

  link.openings();
  rows = bed.at(link.end_time());
  // The bed is wetted by the liquid alone: the stand-in is for one fluid, and for surfaces that it does not
  // touch.
  const auto in_liquid = [&plan](const CellValues<BulkParticles>& bed_rows) {
    std::vector<CellValues<BulkParticles>> by_fluid(plan.fluids);
    by_fluid[0] = bed_rows;
    return by_fluid;
  };
  if (plan.fluids > 1) link.surface();
  link.start(in_liquid(rows), bed.report({}, {}, rows, 0));
  while (link.next_window()) {
    const FluidMessage fluid = link.fluid();
    CellValues<BulkParticles> next = bed.at(link.end_time());
    if (plan.schedule == Schedule::concurrent && link.is_first()) {
      CellValues<BulkParticles> expected = rows;
      bed.expect(fluid.means[0], link.window_length(), expected);
      ParticleMessage message{in_liquid(expected), {}};
      if (plan.interface) message.droplets.emplace();
      link.send(message);
    }
    bed.feel(fluid.means[0], link.window_length(), next);
    ParticleMessage done{in_liquid(next), {}};
    if (plan.interface) done.droplets.emplace();
    link.send(done);
    link.close_window(bed.report(rows, fluid.means[0], next, link.window_length()));
    rows = std::move(next);
    if (link.writes()) link.both_have_written();
  }
  link.close();
  return exit_done;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("A bed with prescribed rows in place of dem_side.", "mock_particles");
  app.add_option("case", options.case_file)->required();
  app.add_option("--set", options.overrides)->expected(1)->take_all();
  app.add_option("--bed", options.bed)->expected(2);
  app.add_option("--solid-fraction", options.solid_fraction);
  app.add_option("--drag", options.drag);
  app.add_option("--velocity", options.velocity);
  app.add_option("--gravity", options.gravity)->expected(3);
  app.add_option("--periodic", options.periodic)->expected(3);
  app.add_option("--continue", options.goes_on_in);
  CLI11_PARSE(app, argc, argv);
  OwnWorld world(argc, argv, Side::particles);
  return guarded_main(world, [&] { return play(options, world); });
}
