// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid beside a wall that accelerates is pushed by it:
//
//   dp/dn = -rho d(u_w)/dt . n        u_w: velocity of the wall's face, which takes the face along
//
// The flux through the wall's face before the pressure corrects it is that of the velocity which the wall
// had in the step before; what is missing from the present one is the pressure's. With the present velocity
// from the start (as in interFoam) the wall pushes nobody: the pressure is level at the wall, the cells
// beside it get half of the acceleration and drag behind, and particles there are told half of the pressure
// gradient.
//
// In the first step of a run the fluid goes with its walls already.

#include "foam_side/accelerating_walls.hpp"

#include "fixedFluxPressureFvPatchScalarField.H"
#include "movingWallVelocityFvPatchVectorField.H"

namespace demvof {

void let_pressure_accelerate_walls(Flow& flow) {
  constexpr scalar as_written = 1e-10;  // of the speed: what a run that goes on finds of it in its files
  if (flow.time.timeIndex() <= 1) return;
  const volVectorField& U = flow.U;
  forAll(U.boundaryField(), patch) {
    const Foam::fvPatchVectorField& wall = U.boundaryField()[patch];
    if (!Foam::isA<Foam::movingWallVelocityFvPatchVectorField>(wall) ||
        !Foam::isA<Foam::fixedFluxPressureFvPatchScalarField>(flow.p_rgh.boundaryField()[patch]))
      continue;
    const Foam::vectorField change(U.oldTime().boundaryField()[patch] - wall);
    flow.pressure_system.memory->boundaryFieldRef()[patch] ==
        Foam::pos(Foam::mag(change) - as_written * Foam::mag(wall)) * (change & wall.patch().Sf());
  }
}

}  // namespace demvof
