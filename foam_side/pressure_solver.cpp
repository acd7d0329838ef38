// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/pressure_solver.hpp"

#include <fmt/format.h>

namespace demvof {

std::string slow_pressure_solver(const Flow& flow) {
  // As measured, docs/performance.md: 0.97 of the fluid's time on 48 000 cells, 0.75 on 162 000.
  constexpr label many_cells = 100000;
  const label cells = Foam::returnReduce(flow.mesh.nCells(), Foam::sumOp<label>());
  const Foam::entry* const entry =
      flow.mesh.solutionDict().subDict("solvers").findEntry("p_rgh", Foam::keyType::REGEX);
  if (cells < many_cells || !entry || !entry->isDict()) return {};  // a given flow has no solver
  const Foam::dictionary& solver = entry->dict();
  if (solver.get<Foam::word>("solver") != "PCG") return {};
  if (solver.isDict("preconditioner") || solver.get<Foam::word>("preconditioner") == "GAMG") return {};
  return fmt::format(
      "system/fvSolution: p_rgh: PCG with {} takes many iterations on {} cells; with GAMG as its "
      "preconditioner "
      "the fluid took 0.75 of the time on 162000, 0.55 on 384000 (docs/performance.md, The pressure's "
      "solver)",
      solver.get<Foam::word>("preconditioner"), cells);
}

}  // namespace demvof
