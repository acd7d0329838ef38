// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace demvof {

/// The user's input is wrong. what() names file, line, key, value and what is allowed. Exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The partner is gone (killed, failed, silent beyond the time-out). Exit code 4.
struct PartnerLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A rank of the partner failed and said so. Exit code 4.
struct PartnerFailed : PartnerLost {
  using PartnerLost::PartnerLost;
};
/// A solver library (OpenFOAM, LIGGGHTS) ended the program on its own. Exit code 3. The library's
/// objects are half taken down by then: leave them alone, do not destroy them.
struct SolverStopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The run failed while in a known stage. Exit code 3. what(): what happened and what to try.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Another rank of this program failed and said so. Ends with that rank's exit code.
struct FellowFailed : RunError {
  FellowFailed(const std::string& what, int code) : RunError(what), exit_code(code) {}
  int exit_code;
};

}  // namespace demvof
