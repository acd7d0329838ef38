// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/pressure_solver.hpp"

#include <gtest/gtest.h>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

std::string said(const char* cells_across, const char* solver, const char* preconditioner = "DIC") {
  const Settings settings{{"nx", cells_across},
                          {"ny", "50"},
                          {"nz", "50"},
                          {"p_solver", solver},
                          {"p_preconditioner", preconditioner}};
  return slow_pressure_solver(*FoamCase("pressure_solver", settings).open(scene(false, false, false)));
}

TEST(PressureSolver, IsCalledSlowOnLargeMeshesAlone) {
  EXPECT_NE(said("41", "PCG").find("PCG with DIC takes many iterations on 102500 cells"), std::string::npos);
  EXPECT_EQ(said("39", "PCG"), "");
  EXPECT_EQ(said("41", "GAMG"), "");
}

TEST(PressureSolver, IsNotCalledSlowWithGamgAsPreconditioner) {
  EXPECT_EQ(said("41", "PCG", "GAMG"), "");
  EXPECT_EQ(said("41", "PCG", "{ preconditioner GAMG; smoother DIC; tolerance 1e-3; }"), "");
}

/// A flow that is given (nNonOrthogonalCorrectors -1) needs none.
TEST(PressureSolver, NeedNotBeThere) {
  const FoamCase given("pressure_solver_none", {{"nx", "41"}, {"ny", "50"}, {"nz", "50"}});
  const auto flow = given.open(scene(false, false, false));
  auto& solvers = const_cast<Foam::dictionary&>(flow->mesh.solutionDict().subDict("solvers"));
  for (const char* name : {"p_rgh", "p_rghFinal"}) solvers.remove(name);
  EXPECT_EQ(slow_pressure_solver(*flow), "");
}

}  // namespace
}  // namespace demvof::test
