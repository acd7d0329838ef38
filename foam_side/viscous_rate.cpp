// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/viscous_rate.hpp"

#include <algorithm>

namespace demvof {

double viscous_rate(const Flow& flow) {
  const tmp<volScalarField> nu = flow.turbulence->nuEff();
  const surfaceScalarField& inverse = flow.mesh.nonOrthDeltaCoeffs();
  double largest = 0;
  forAll(flow.mesh.owner(), face) {
    const double between = std::max(nu()[flow.mesh.owner()[face]], nu()[flow.mesh.neighbour()[face]]);
    largest = std::max(largest, between * inverse[face] * inverse[face]);
  }
  return Foam::returnReduce(largest, Foam::maxOp<double>());
}

}  // namespace demvof
