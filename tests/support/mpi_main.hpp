// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// main() of a test that runs on the ranks of one program. Rank 0 prints; a failure on any rank fails the
// test, because mpirun returns the exit code of a rank that failed.

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  struct Failures : testing::EmptyTestEventListener {  // of other ranks, without the table
    void OnTestPartResult(const testing::TestPartResult& result) override {
      if (result.failed())
        std::fprintf(stderr, "%s:%d: %s\n", result.file_name(), result.line_number(), result.message());
    }
  };
  if (rank > 0) {
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Failures);
  }
  const int result = RUN_ALL_TESTS();
  MPI_Finalize();
  return result;
}
