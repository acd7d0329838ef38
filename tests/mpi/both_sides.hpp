// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>

#include "coupler/link/link.hpp"

// One test program plays both sides on split ranks: mpirun -np 3 program ffp runs it with ranks 0 and
// 1 as foam_side and rank 2 as dem_side. A test is one function that both sides run; where their parts
// differ it asks on_fluid_side().

namespace demvof::test {

/// The OwnWorld of this rank; made by run_both_sides before the first test.
OwnWorld& world();
inline bool on_fluid_side() {
  return world().side() == Side::fluid;
}

/// Waits for all ranks of both sides, so that tests do not run into each other.
void meet();
/// The sum of a value over all ranks of both sides.
double sum_over_both(double value);

/// The main() of a test program. Every rank runs every test; a failure on any rank fails the program.
int run_both_sides(int argc, char** argv);

}  // namespace demvof::test
