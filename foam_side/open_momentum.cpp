// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/open_momentum.hpp"

namespace demvof {

namespace {

using Kept = volVectorField::Internal;
const char* const open_name = "openMomentum";

}  // namespace

const Foam::vectorField* find_open_momentum(const Flow& flow) {
  return flow.mesh.foundObject<Kept>(open_name) ? &flow.mesh.lookupObject<Kept>(open_name).field() : nullptr;
}

Foam::vectorField& open_momentum(Flow& flow) {
  if (!flow.mesh.foundObject<Kept>(open_name))
    flow.mesh.objectRegistry::store(
        new Kept(Foam::IOobject(open_name, flow.time.timeName(), flow.mesh), flow.mesh,
                 Foam::dimensionedVector(Foam::dimDensity * Foam::dimVelocity, Foam::Zero)));
  return flow.mesh.lookupObjectRef<Kept>(open_name).field();
}

double size_of_open_momentum(const Flow& flow) {
  const Foam::vectorField* open = find_open_momentum(flow);
  double size = 0;
  if (open) forAll(*open, cell) size += flow.mesh.V()[cell] * Foam::mag((*open)[cell]);
  return Foam::returnReduce(size, Foam::sumOp<double>());
}

bool leaves_too_much_open(const Flow& flow) {
  constexpr double of_returned = 0.5, of_change = 0.01;
  const double open = size_of_open_momentum(flow);
  if (open <= of_returned * flow.pressure_system.returned) return false;
  double change = 0;  // of the fluid's momentum in the step
  const Foam::vectorField &U = flow.U.primitiveField(), &before = flow.U.oldTime().primitiveField();
  forAll(U, cell) change += flow.mesh.V()[cell] * flow.rho[cell] * Foam::mag(U[cell] - before[cell]);
  return open > of_change * Foam::returnReduce(change, Foam::sumOp<double>());
}

}  // namespace demvof
