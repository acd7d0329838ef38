// SPDX-License-Identifier: GPL-3.0-or-later
#include "world_user.hpp"

#include <mpi.h>

int world_user_size() {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

int world_user_sum(int value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  return value;
}

int world_user_largest_rank() {
  MPI_Group group;
  MPI_Comm copy;
  MPI_Comm_group(MPI_COMM_WORLD, &group);
  MPI_Comm_create(MPI_COMM_WORLD, group, &copy);
  int rank = 0;
  MPI_Comm_rank(copy, &rank);
  MPI_Allreduce(MPI_IN_PLACE, &rank, 1, MPI_INT, MPI_MAX, copy);
  MPI_Comm_free(&copy);
  MPI_Group_free(&group);
  return rank;
}

void world_user_gives_up() {
  MPI_Finalize();
}
