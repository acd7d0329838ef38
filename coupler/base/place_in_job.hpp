// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <initializer_list>
#include <optional>

namespace demvof {

namespace detail {
inline std::optional<int> first_number(std::initializer_list<const char*> variables) {
  for (const char* variable : variables)
    if (const char* value = std::getenv(variable)) return std::atoi(value);
  return std::nullopt;
}
}  // namespace detail

// What a process knows of its job before MPI is initialised, from those who start ranks: Open MPI's mpirun,
// anything that speaks PMIx (prterun, srun --mpi=pmix), MPICH's mpirun or srun --mpi=pmi2, and srun. In this
// order, because an mpirun inside a Slurm job inherits Slurm's variables, and its own are the right ones
// then.

/// This process's rank in the job; nothing for a program that was started alone.
inline std::optional<int> rank_in_job() {
  return detail::first_number({"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"});
}
/// The job's number of ranks, where the one who started it tells.
inline std::optional<int> ranks_of_job() {
  return detail::first_number({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"});
}

}  // namespace demvof
