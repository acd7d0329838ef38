// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/stress_of_other.hpp"

#include <algorithm>

#include "foam_side/cell_field.hpp"
#include "foam_side/kept_field.hpp"

namespace demvof {

namespace {

const char* const stress_name = "stressInCells";

/// Sum over the faces of each cell of mu |S|/d, kg/s.
scalarField conductance(const Flow& flow, const scalarField& viscosity) {
  const Foam::fvMesh& mesh = flow.mesh;
  const volScalarField mu(with_boundary("mu", mesh, Foam::dimDynamicViscosity, viscosity));
  const tmp<volScalarField> sum =
      fvc::surfaceSum(fvc::interpolate(mu) * mesh.nonOrthDeltaCoeffs() * mesh.magSf());
  return sum().primitiveField();
}

}  // namespace

Foam::vectorField& stress_in_cells(Flow& flow) {
  return kept(flow, stress_name, Foam::dimForce / Foam::dimVolume);
}
const Foam::vectorField* find_stress_in_cells(const Flow& flow) {
  return find_kept(flow, stress_name);
}

scalarField others_stress_share(const Flow& flow, int k) {
  scalarField share(flow.mesh.nCells(), 0.0);
  if (!flow.scene.two_fluids) return share;
  const scalarField all = conductance(flow, dynamic_viscosity(flow)),
                    own = conductance(flow, dynamic_viscosity(flow, k));
  forAll(share, cell) share[cell] = std::max(0.0, 1 - own[cell] / all[cell]);
  return share;
}

Foam::vectorField stress_of_other(const Flow& flow, int k, const Foam::vectorField* stress) {
  Foam::vectorField other(flow.mesh.nCells(), Foam::Zero);
  if (stress) other = others_stress_share(flow, k) * *stress;
  return other;
}

}  // namespace demvof
