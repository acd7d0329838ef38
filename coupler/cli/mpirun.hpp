// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace demvof {

/// The mpirun in PATH.
struct Mpirun {
  std::string version;  // as it says itself, e.g. "Open MPI 4.1.4"
  int open_mpi = 0;     // Open MPI's major version; 0: another MPI
};

/// Asks mpirun. Throws std::runtime_error when there is none, or when it cannot start the programs because
/// they run with another MPI.
Mpirun find_mpirun();

/// The MPI library of this program, e.g. "Open MPI 4.1.4".
std::string mpi_library();

/// What demvof asks of this mpirun, in its own words. time_out: of both sides, s. time_to_write: that ranks
/// have when another has ended badly, whole s.
std::vector<std::string> mpirun_options(const Mpirun& mpirun, double time_out, int time_to_write);

}  // namespace demvof
