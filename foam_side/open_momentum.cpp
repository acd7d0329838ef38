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

}  // namespace demvof
