// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/kept_field.hpp"

namespace demvof {

namespace {

using Kept = volVectorField::Internal;

}  // namespace

const Foam::vectorField* find_kept(const Flow& flow, const char* name) {
  return flow.mesh.foundObject<Kept>(name) ? &flow.mesh.lookupObject<Kept>(name).field() : nullptr;
}

Foam::vectorField& kept(Flow& flow, const char* name, const Foam::dimensionSet& dimensions) {
  if (!flow.mesh.foundObject<Kept>(name))
    flow.mesh.objectRegistry::store(new Kept(Foam::IOobject(name, flow.time.timeName(), flow.mesh), flow.mesh,
                                             Foam::dimensionedVector(dimensions, Foam::Zero)));
  return flow.mesh.lookupObjectRef<Kept>(name).field();
}

}  // namespace demvof
