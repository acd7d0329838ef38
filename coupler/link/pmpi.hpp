// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

// Inside of coupler/link: what the MPI functions defined here (pmpi.cpp and the generated ones) and
// OwnWorld tell each other. Programs link these functions because OwnWorld calls substitute_world.

namespace demvof {

/// Until now MPI_COMM_WORLD meant itself; from now on it means this communicator.
void substitute_world(MPI_Comm own_world);
/// The communicator an MPI call gets when a library names this one.
MPI_Comm own(MPI_Comm named);

/// MPI_Finalize is ours to call: from now on a library's call of it does nothing.
void announce_end();
bool end_announced();

/// What to do when a library ends the program and throwing is no way out. Does not return.
void on_sudden_end(void (*handler)(const char* why));

}  // namespace demvof
