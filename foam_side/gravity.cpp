// SPDX-License-Identifier: GPL-3.0-or-later
// Gravity, and the potential g.x that stands for it beside p_rgh. With a table (gravity_table.hpp) it is
// another one in each window, or, without particles, in each step. Nothing else of the flow changes with it:
// p_rgh has no memory, and the pressure of the last step with the weight of the new gravity is the best
// guess of the new one.

#include "foam_side/flow.hpp"
#include "foam_side/vectors.hpp"

namespace demvof {

dimensionedScalar reference_potential(const Foam::uniformDimensionedVectorField& g,
                                      const Foam::fvMesh& mesh) {
  const Foam::uniformDimensionedScalarField height(
      Foam::IOobject("hRef", mesh.time().constant(), mesh, Foam::IOobject::READ_IF_PRESENT,
                     Foam::IOobject::NO_WRITE),
      dimensionedScalar(Foam::dimLength, Foam::Zero));
  const Foam::vector axis = Foam::cmptMag(g.value()) / (Foam::mag(g.value()) + Foam::VSMALL);
  return (g & axis) * height;
}

void renew_gravity_potential(Flow& flow) {
  flow.gh = (flow.g & flow.mesh.C()) - flow.gh_reference;
  flow.ghf = (flow.g & flow.mesh.Cf()) - flow.gh_reference;
}

Vec3 set_gravity(Flow& flow, const Vec3& gravity) {
  const Vec3 change = gravity - to_vec3(flow.g.value());
  if (norm(change) == 0) return change;
  // The case's own, which boundary conditions look up.
  flow.time.lookupObjectRef<Foam::uniformDimensionedVectorField>(flow.g.name()).value() = to_foam(gravity);
  flow.gh_reference = reference_potential(flow.g, flow.mesh);
  renew_gravity_potential(flow);
  flow.face_force.clear();
  return change;
}

}  // namespace demvof
