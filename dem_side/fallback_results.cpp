// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/fallback_results.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <mutex>

#include "coupler/config/read_case.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/output/results.hpp"

namespace demvof {

namespace fs = std::filesystem;

struct FallbackResults::State {
  std::mutex mutex;
  RunResults results;
  fs::path file;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

FallbackResults::FallbackResults(const ProgramOptions& options, const CaseParameters& parameters,
                                 const OwnWorld& world)
    : state_(std::make_shared<State>()) {
  RunResults& results = state_->results;
  state_->file = options.out / "results.json";
  results.status = RunStatus::failed;
  results.configuration_hash = configuration_hash(parameters);
  results.configuration = resolved_configuration(parameters);
  results.command = options.command;
  results.ranks = {world.partner_size(), world.size()};
  if (world.rank() != 0 || options.check) return;
  set_last_words([state = state_](const Failure& failure) {
    // A file that is there is the partner's own account, or that of the run which this one was to go on with.
    if (failure.exit_code != exit_partner_lost || fs::exists(state->file)) return;
    const std::lock_guard<std::mutex> lock(state->mutex);
    state->results.failure =
        RunFailure{side_name(failure.side), failure.stage, failure.time, failure.message};
    state->results.wall_seconds.total =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - state->start).count();
    write_results(state->file, state->results);
  });
}

void FallbackResults::start(long particles) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->results.particles.initial = state_->results.particles.final = particles;
}

void FallbackResults::window(long windows, long dem_steps, const ParticleReport& report, long particles) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  RunResults& results = state_->results;
  results.steps.windows = windows;
  results.steps.particles = dem_steps;
  results.particles.final = particles;
  results.particles.inserted = std::lround(report.inserted);
  results.particles.left = std::lround(report.left);
  results.particles.lost = std::lround(report.lost);
  results.wall_seconds.particles = report.dem_seconds;
  results.wall_seconds.waiting = report.waiting_seconds;
}

}  // namespace demvof
