// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/run_stage.hpp"

#include <fmt/format.h>

namespace demvof {

std::string RunStage::describe() const {
  return fmt::format("in stage '{}' at t = {:g} s", stage(), time());
}

RunStage& run_stage() {
  static RunStage stage;
  return stage;
}

}  // namespace demvof
