// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/restart.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/output/piped_file.hpp"
#include "coupler/output/state_frame.hpp"
#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

fs::path facts_file(const fs::path& run, long window) {
  return restart_folder(run, window) / "particles.json";
}

}  // namespace

fs::path restart_file(const fs::path& run, long window) {
  return restart_folder(run, window) / "particles";
}

StateFiles write_particle_restart(const fs::path& run, long window, Dem& dem, int steps) {
  const long count = dem.census().count;
  const RandomStates random = dem.random_states();
  int rank;
  check_mpi(MPI_Comm_rank(dem.world(), &rank), "MPI_Comm_rank");
  StateFiles files;
  if (rank != 0) {
    dem.write_restart("written by rank 0");
    dem.write_rows("likewise");
    return files;
  }
  fs::create_directories(restart_folder(run, window));
  const nlohmann::json facts = {{"step", dem.step()},
                                {"particles", count},
                                {"steps_per_window", steps},
                                {"random", {{"names", random.names}, {"states", random.states}}}};
  write_file_atomically(facts_file(run, window), facts.dump() + "\n");
  // LIGGGHTS does not look whether its writes succeed.
  PipedFile file(restart_file(run, window));
  dem.write_restart(file.name());
  file.finish();
  const fs::path rows_file = Dem::rows_file(restart_file(run, window));
  PipedFile rows(rows_file);
  dem.write_rows(rows.name());
  rows.finish();
  add_state_file(files, run, facts_file(run, window));
  add_state_file(files, run, restart_file(run, window));
  add_state_file(files, run, rows_file);
  return files;
}

RestartPoint open_state(const ProgramOptions& options, const CaseParameters& parameters,
                        const OwnWorld& world) {
  const RestartPoint point =
      read_restart_point(options.out, options.from, state_frame(parameters, parameters.fluid.ranks),
                         parameters.coupling.end_time);
  const std::string own = fmt::format("restart/{}/particles", point.window);
  if (world.rank() == 0)
    require_whole(options.out, point, [&](const std::string& name) { return name.rfind(own, 0) == 0; });
  return point;
}

LastParticles read_particle_restart(const fs::path& run, long window, const Dem& dem,
                                    const std::string& script) {
  std::ifstream stream(facts_file(run, window));
  const auto facts = nlohmann::json::parse(stream, nullptr, false);
  if (!facts.is_object())
    throw InputError(
        fmt::format("--continue: {} is not what dem_side has written", facts_file(run, window).string()));
  const long step = facts.at("step"), count = facts.at("particles");
  if (dem.step() != step || dem.census().count != count)
    throw InputError(fmt::format(
        "--continue: {} ends with {} particles at step {}, the run to go on with had {} at step {}. Where "
        "the "
        "variable ${{continued}} is 1 the script has to read ${{restart_file}} in place of making a box and "
        "particles (docs/howto_your_own_case.md)",
        script, dem.census().count, dem.step(), count, step));
  const nlohmann::json& random = facts.at("random");
  return {facts.at("steps_per_window"), {random.at("names"), random.at("states")}};
}

}  // namespace demvof
