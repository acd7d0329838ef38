// SPDX-License-Identifier: GPL-3.0-or-later
// An MPI program that is none of ours, in the place of a partner: stranger begin (starts MPI, and goes its
// own way), stranger meet (calls upon all ranks again and again), stranger end (starts MPI and ends it).
#include <mpi.h>
#include <unistd.h>

#include <cstring>

int main(int argc, char** argv) {
  const char* what = argc > 1 ? argv[1] : "begin";
  MPI_Init(&argc, &argv);
  if (std::strcmp(what, "begin") == 0) sleep(60);
  for (int i = 0; std::strcmp(what, "meet") == 0 && i < 100000000; ++i) {
    double mine = i, all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  }
  MPI_Finalize();
}
