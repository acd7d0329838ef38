// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A shared library that knows nothing of a pair and uses MPI as a solver does.

int world_user_size();
int world_user_sum(int value);  // over MPI_COMM_WORLD
int world_user_largest_rank();  // through a group and a communicator made from MPI_COMM_WORLD
void world_user_gives_up();     // MPI_Finalize
