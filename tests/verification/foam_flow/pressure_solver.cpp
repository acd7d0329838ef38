// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/pressure_solver.hpp"

#include <gtest/gtest.h>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

std::string said(const char* cells_across, const char* solver) {
  return slow_pressure_solver(
      *FoamCase("pressure_solver", {{"nx", cells_across}, {"ny", "50"}, {"nz", "50"}, {"p_solver", solver}})
           .open(scene(false, false, false)));
}

TEST(PressureSolver, IsCalledSlowOnLargeMeshesAlone) {
  EXPECT_NE(said("41", "PCG").find("PCG with DIC takes many iterations on 102500 cells"), std::string::npos);
  EXPECT_EQ(said("39", "PCG"), "");
  EXPECT_EQ(said("41", "GAMG"), "");
}

}  // namespace
}  // namespace demvof::test
