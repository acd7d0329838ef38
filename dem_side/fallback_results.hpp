// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "coupler/config/parameters.hpp"
#include "coupler/config/program_options.hpp"
#include "coupler/exchange/particle_report.hpp"
#include "coupler/link/own_world.hpp"

namespace demvof {

/// foam_side writes results.json. When it is lost without having done so (killed, crashed), dem_side is
/// the one left to tell how far the run came: this keeps what that takes.
class FallbackResults {
 public:
  FallbackResults(const ProgramOptions& options, const CaseParameters& parameters, const OwnWorld& world);

  void start(long particles);
  void window(long windows, long dem_steps, const ParticleReport& report, long particles);

 private:
  struct State;  // shared with the last words, which another thread may speak
  std::shared_ptr<State> state_;
};

}  // namespace demvof
