// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/unsettled_corrections.hpp"

#include <algorithm>

#include "uniformDimensionedFields.H"

namespace demvof {
namespace {

const char* const predictions_name = "unsettledPredictions";
const char* const most_name = "mostUnsettled";

using Kept = Foam::uniformDimensionedScalarField;

double kept(const Flow& flow, const char* name) {
  const Kept* found = flow.mesh.findObject<Kept>(name);
  return found ? found->value() : 0;
}

void keep(const Flow& flow, const char* name, double value) {
  if (Kept* found = flow.mesh.getObjectPtr<Kept>(name)) {
    found->value() = value;
    return;
  }
  const Foam::IOobject as(name, flow.time.constant(), flow.mesh, Foam::IOobject::NO_READ,
                          Foam::IOobject::NO_WRITE, true);
  Foam::regIOobject::store(new Kept(as, dimensionedScalar(name, Foam::dimless, value)));
}

}  // namespace

UnsettledCorrections unsettled_corrections(const Flow& flow) {
  return {kept(flow, predictions_name), kept(flow, most_name)};
}

void note_unsettled(const Flow& flow, double most) {
  const UnsettledCorrections before = unsettled_corrections(flow);
  keep(flow, predictions_name, before.predictions + 1);
  keep(flow, most_name, std::max(before.most, most));
}

}  // namespace demvof
