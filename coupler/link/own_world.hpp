// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

namespace demvof {

enum class Side { fluid, particles };
const char* side_name(Side side);     // "fluid", "particles"
const char* program_name(Side side);  // "foam_side", "dem_side"

/// The communicator that stands for MPI_COMM_WORLD inside one program of a pair.
///
/// Construction initialises MPI, splits the real world by program, and from then on every MPI call
/// of OpenFOAM's or LIGGGHTS's code that names MPI_COMM_WORLD works on this program's own ranks
/// (pmpi.cpp substitutes it through the MPI profiling interface). MPI_Abort stays on the real world.
/// MPI_Finalize and MPI_Abort called by a solver library without announcement throw SolverStopped.
class OwnWorld {
 public:
  OwnWorld(int& argc, char**& argv, Side side);
  ~OwnWorld();  // does not finalise MPI: finalise() does, once
  OwnWorld(const OwnWorld&) = delete;
  OwnWorld& operator=(const OwnWorld&) = delete;

  Side side() const { return side_; }
  MPI_Comm comm() const { return comm_; }
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Ranks of the partner program in the real world; 0 when this program was started alone.
  int partner_size() const { return partner_size_; }
  /// Real-world rank of the partner's rank 0 (meaningless when alone).
  int partner_leader() const { return partner_leader_; }

  /// The orderly end: MPI is finalised, by us or by the library's own exit path.
  void finalise();

 private:
  Side side_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1, partner_size_ = 0, partner_leader_ = -1;
};

}  // namespace demvof
