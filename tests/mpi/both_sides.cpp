// SPDX-License-Identifier: GPL-3.0-or-later
#include "both_sides.hpp"

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "coupler/base/mpi_check.hpp"
#include "coupler/base/place_in_job.hpp"

namespace demvof::test {
namespace {

std::unique_ptr<OwnWorld> the_world;

// Says on which rank a check failed; the ordinary output comes from one rank only.
class RankedFailures : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (result.failed())
      std::fprintf(stderr, "[%s rank %d] %s:%d\n%s\n", program_name(world().side()), world().rank(),
                   result.file_name(), result.line_number(), result.message());
  }
};

}  // namespace

OwnWorld& world() {
  return *the_world;
}

void meet() {
  check_mpi(MPI_Barrier(world().pair().both), "MPI_Barrier");
}

double sum_over_both(double value) {
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, world().pair().both),
            "MPI_Allreduce");
  return value;
}

int run_both_sides(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::string sides = argc > 1 ? argv[1] : "";
  const int rank = rank_in_job().value_or(0);
  if (rank >= static_cast<int>(sides.size())) {
    std::fprintf(stderr, "usage: mpirun -np N %s SIDES   (one letter f or p for each rank)\n", argv[0]);
    return 1;
  }
  the_world = std::make_unique<OwnWorld>(argc, argv, sides[rank] == 'f' ? Side::fluid : Side::particles);
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (rank != 0) delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new RankedFailures);
  const int failed = RUN_ALL_TESTS();
  const double all_failed = sum_over_both(failed);
  the_world->finalise();
  return all_failed > 0 ? 1 : 0;
}

}  // namespace demvof::test
