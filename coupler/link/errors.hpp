// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace demvof {

/// The partner is gone (killed, failed, silent beyond the time-out). Exit code 4.
struct PartnerLost : std::runtime_error {
  using std::runtime_error::runtime_error;
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

}  // namespace demvof
