// SPDX-License-Identifier: GPL-3.0-or-later
// What forces beyond drag and pressure need to know of the fluid.
//
//   div tau               tau = mu_eff (grad u + grad u^T), by the operator of the momentum equation with eps
//   = 1 sigma kappa grad a    face values of the momentum equation, reconstructed in the cell as grad p is:
//   where
//                         they balance (a drop at rest), a particle feels neither
//   Du/Dt                 (u - u_0)/dt + (u - u_c).grad u, u_0 one time step before in the same cell, which
//                         moves with u_c
//   curl u                from the same grad u
//
// mu_eff viscosity of the mixture with turbulence, Pa s; sigma surface tension, N/m; kappa curvature, 1/m; a
// liquid fraction.

#include "foam_side/fluid_gradients.hpp"

namespace demvof {
namespace {

Foam::vectorField viscous_force(Flow& flow) {
  // The matrix is that of -div tau; applied to u it gives its value per volume.
  const tmp<volVectorField> force = flow.turbulence->divDevRhoReff(flow.rho, flow.U) & flow.U;
  return -force().primitiveField();
}

Foam::vectorField capillary_force(const Flow& flow) {
  const surfaceScalarField pull(flow.mixture.surfaceTensionForce() * flow.mesh.magSf());
  return (*flow.reconstruct)([&](const auto& at, label) { return at(pull); });
}

Foam::vectorField curl(const Foam::tensorField& gradient) {
  Foam::vectorField curl(gradient.size());
  forAll(curl, cell) {
    const Foam::tensor& g = gradient[cell];  // g.xy() = d(u_y)/dx
    curl[cell] = vector(g.yz() - g.zy(), g.zx() - g.xz(), g.xy() - g.yx());
  }
  return curl;
}

Foam::vectorField acceleration(const Flow& flow, const Foam::tensorField& gradient) {
  const Foam::vectorField& u = flow.U.primitiveField();
  const Foam::vectorField change((u - flow.U.oldTime().primitiveField()) / flow.time.deltaTValue());
  if (!flow.mesh.moving()) return change + (u & gradient);
  const surfaceScalarField& swept = flow.mesh.phi();
  const Foam::vectorField cell_velocity =
      (*flow.reconstruct)([&](const auto& at, label) { return at(swept); });
  return change + ((u - cell_velocity) & gradient);
}

}  // namespace

Foam::vectorField fluid_acceleration(const Flow& flow) {
  return acceleration(flow, fvc::grad(flow.U)().primitiveField());
}

FluidGradients fluid_gradients(Flow& flow, const ForceParameters& forces) {
  const label cells = flow.mesh.nCells();
  FluidGradients found{Foam::vectorField(cells, Foam::Zero), Foam::vectorField(cells, Foam::Zero),
                       Foam::vectorField(cells, Foam::Zero), Foam::vectorField(cells, Foam::Zero)};
  if (forces.viscous_stress) found.viscous_force = viscous_force(flow);
  found.stress_force += found.viscous_force;
  if (forces.capillary && flow.scene.surface_tension) found.stress_force += capillary_force(flow);

  const bool accelerates = need_acceleration(forces) && flow.U.nOldTimes() > 0;
  if (!accelerates && !need_vorticity(forces)) return found;
  const tmp<Foam::volTensorField> gradient = fvc::grad(flow.U);
  const Foam::tensorField& g = gradient().primitiveField();
  if (need_vorticity(forces)) found.vorticity = curl(g);
  if (accelerates) found.acceleration = acceleration(flow, g);
  return found;
}

}  // namespace demvof
