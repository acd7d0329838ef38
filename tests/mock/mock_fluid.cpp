// SPDX-License-Identifier: GPL-3.0-or-later
// A stand-in for foam_side: water that never answers, the same everywhere and at every time. It plays
// the fluid's part of the window protocol, hands impulses over as left-over, and checks in every window
// what the real dem_side sends and reports. Usage: mock_fluid case.yaml [options below]
//
// Exit code 0 when everything held; each broken expectation is one line on stderr and ends in 3.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "coupler/config/read_case.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/link/fluid_end.hpp"
#include "coupler/link/handshake_items.hpp"
#include "coupler/link/main_guard.hpp"
#include "coupler/output/machine.hpp"
#include "coupler/scene/plan_windows.hpp"

namespace {

using namespace demvof;
using nlohmann::json;

struct Options {
  std::string case_file;
  bool check = false;
  double gravity = 9.81;         // m/s2, downward, as stated in the handshake
  double left_over = 0;          // impulse per active cell and window, N s, downward
  double terminal_velocity = 0;  // expected of a single particle at the end, m/s
  double terminal_tolerance = 1e-3;
  std::string bulk_file;      // the last deposit, as text, one file per rank
  long killed_in_window = 0;  // by kill -9
  std::vector<long> steps{
      1};  // DEM steps of windows, where these have their own lengths; over and over again
};

Vec3 vec3(const json& array) {
  return {array.at(0), array.at(1), array.at(2)};
}

int failures = 0;
void expect(bool holds, const std::string& what) {
  if (holds) return;
  ++failures;
  if (failures <= 20) fmt::print(stderr, "mock_fluid: {}\n", what);
}
void expect_near(double value, double expected, double tolerance, const char* what, long window) {
  expect(std::abs(value - expected) <= tolerance,
         fmt::format("window {}: {} is {:.17g}, expected {:.17g} within {:.1e}", window, what, value,
                     expected, tolerance));
}
void expect_near(const Vec3& value, const Vec3& expected, double tolerance, const char* what, long window) {
  for (int axis = 0; axis < 3; ++axis) expect_near(value[axis], expected[axis], tolerance, what, window);
}

// Density 1000, viscosity 1e-3, at rest, hydrostatic.
CellValues<BulkFluid> still_water(const std::vector<CellId>& cells, const Options& options) {
  BulkFluid water;
  water.pressure_gradient = {0, 0, -1000 * options.gravity};
  water.density = 1000;
  water.viscosity = 1e-3;
  return {cells, std::vector<BulkFluid>(cells.size(), water)};
}

// Over all cells and ranks.
BulkParticles total(const CellValues<BulkParticles>& particles, const OwnWorld& world) {
  BulkParticles sum;
  for (const BulkParticles& cell : particles.values) {
    sum.solid_volume += cell.solid_volume;
    sum.drag_impulse += cell.drag_impulse;
  }
  MPI_Allreduce(MPI_IN_PLACE, &sum, row_width<BulkParticles>(), MPI_DOUBLE, MPI_SUM, world.comm());
  return sum;
}

void write_bulk(const std::string& file, const CellValues<BulkParticles>& particles) {
  std::ofstream text(file);
  for (std::size_t i = 0; i < particles.cells.size(); ++i) {
    const BulkParticles& cell = particles.values[i];
    text << fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", particles.cells[i], cell.solid_volume,
                        cell.drag_factor, cell.drag_response, cell.drag_impulse.z,
                        cell.drag_weighted_velocity.z);
  }
}

int play(const Options& options, OwnWorld& world) {
  const CaseParameters parameters = read_case(options.case_file);
  const BulkGrid grid(parameters.bulk_grid->lower, parameters.bulk_grid->upper, parameters.bulk_grid->cells);
  FluidEnd link(world, grid.cells(), parameters.coupling.time_out);
  const json facts = json::parse(link.handshake(
      handshake_items(version(), configuration_hash(parameters), {0, 0, -options.gravity}), "{}"));
  link.send_plan(plan_windows(parameters, Scene{}, facts.at("time_step")));
  if (options.check) {
    link.close();
    return exit_done;
  }

  const double solid_volume = facts.at("solid_volume");
  const FluidEnd::Start start = link.start({});  // water fills all bulk cells
  CellValues<BulkParticles> particles = start.particles[0];
  expect_near(total(particles, world).solid_volume, solid_volume, 1e-12 * solid_volume,
              "solid volume on the bulk grid", 0);
  expect_near(total(particles, world).drag_impulse, {}, 0, "drag impulse before the first window", 0);

  ParticleReport report = start.report;
  Vec3 momentum = vec3(facts.at("momentum"));
  while (link.next_window()) {
    const long n = link.number();
    if (link.plan().own_lengths()) link.set_steps(options.steps.at((n - 1) % options.steps.size()));
    const double window = link.window_length();
    FluidMessage fluid;
    fluid.means = {still_water(particles.cells, options)};
    Vec3 left_over;
    for (std::size_t i = 0; i < particles.cells.size(); ++i)
      if (particles.values[i].drag_factor > 0) {  // as with K_eff: nothing is left over without drag
        fluid.means[0].values[i].left_over = {0, 0, -options.left_over};
        left_over += fluid.means[0].values[i].left_over;
      }
    MPI_Allreduce(MPI_IN_PLACE, &left_over, 3, MPI_DOUBLE, MPI_SUM, world.comm());
    if (n == options.killed_in_window) std::raise(SIGKILL);
    link.window(
        fluid, [] {}, [&](ParticleMessage message) { particles = std::move(message.sums[0]); });
    report = link.close_window();
    if (link.writes()) link.both_have_written();
    const double outputs = link.end_time() / parameters.output.interval;
    if (link.plan().own_lengths() && !link.done())
      expect(link.writes() == (std::abs(outputs - std::round(outputs)) < 1e-9),
             fmt::format("window {}: output at {} s", n, link.end_time()));

    expect_near(report.steps, window / static_cast<double>(facts.at("time_step")), 1e-9, "DEM steps", n);
    const double solid = report.solid_volume, mass = report.mass;
    const double scale = mass * options.gravity * window;  // of impulses
    expect_near(report.solid_volume_bulk, solid, 1e-12 * solid, "solid volume on the bulk grid", n);
    expect_near(total(particles, world).solid_volume, solid, 1e-12 * solid, "solid volume received", n);
    expect_near(total(particles, world).drag_impulse, report.drag_impulse, 1e-12 * scale, "drag impulse", n);
    expect_near(report.left_over_given, left_over, 1e-12 * scale, "left-over impulse", n);
    expect(report.lost == 0, fmt::format("window {}: {} particles lost", n, report.lost));

    const Vec3 change = report.momentum - momentum;
    const Vec3 booked = report.drag_impulse + report.pressure_impulse + report.left_over_given +
                        report.contact_impulse + report.gravity_impulse - report.held_impulse;
    momentum = report.momentum;
    expect_near(change, booked, 1e-12 * (scale + norm(momentum)), "change of momentum", n);
  }
  expect_near(link.end_time(), parameters.coupling.end_time, 0, "time at the end", link.number());
  if (options.terminal_velocity > 0)
    expect_near(report.momentum.z / report.mass, -options.terminal_velocity,
                options.terminal_tolerance * options.terminal_velocity, "velocity at the end", link.number());
  if (!options.bulk_file.empty())
    write_bulk(fmt::format("{}.{}", options.bulk_file, world.rank()), particles);
  link.close();
  return failures ? exit_failed : exit_done;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("A fluid at rest in place of foam_side.", "mock_fluid");
  app.add_option("case", options.case_file)->required();
  app.add_flag("--check", options.check);
  app.add_option("--gravity", options.gravity);
  app.add_option("--left-over", options.left_over);
  app.add_option("--terminal-velocity", options.terminal_velocity);
  app.add_option("--bulk-file", options.bulk_file);
  app.add_option("--steps", options.steps);
  app.add_option("--killed-in-window", options.killed_in_window);
  CLI11_PARSE(app, argc, argv);
  OwnWorld world(argc, argv, Side::fluid);
  return guarded_main(world, [&] { return play(options, world); });
}
