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

/// Named by a word, or with settings of its own.
TEST(PressureSolver, IsNotCalledSlowWithGamgAsPreconditioner) {
  const FoamCase large("pressure_solver_gamg", {{"nx", "41"}, {"ny", "50"}, {"nz", "50"}});
  const auto flow = large.open(scene(false, false, false));
  auto& solver = const_cast<Foam::dictionary&>(flow->mesh.solutionDict().subDict("solvers").subDict("p_rgh"));
  solver.set("preconditioner", Foam::word("GAMG"));
  EXPECT_EQ(slow_pressure_solver(*flow), "");
  Foam::dictionary settings;
  settings.set("preconditioner", Foam::word("GAMG"));
  solver.set("preconditioner", settings);
  EXPECT_EQ(slow_pressure_solver(*flow), "");
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
