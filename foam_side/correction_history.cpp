// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/correction_history.hpp"

#include <cmath>

namespace demvof {
namespace {

using Correction = CorrectionHistory::Correction;

void subtract(Correction& from, double factor, const Correction& what) {
  from.given -= factor * what.given;
  from.leaves -= factor * what.leaves;
  from.open -= factor * what.open;
}

}  // namespace

void CorrectionHistory::add(Correction correction) {
  constexpr double new_direction = 1e-8;  // of a change; less is round-off
  if (!latest_.open.empty()) {
    Correction change{correction.given - latest_.given, correction.leaves - latest_.leaves,
                      correction.open - latest_.open};
    const double before = std::sqrt(Foam::gSumSqr(change.open));
    for (int pass = 0; pass < 2; ++pass)
      for (const Correction& other : changes_)
        subtract(change, Foam::gSumProd(change.open, other.open), other);
    const double size = std::sqrt(Foam::gSumSqr(change.open));
    if (size > new_direction * before) {
      change.given /= size;
      change.leaves /= size;
      change.open /= size;
      changes_.push_back(std::move(change));
    }
  }
  latest_ = std::move(correction);
}

scalarField CorrectionHistory::best(scalarField Correction::*part) const {
  scalarField combination(latest_.*part);
  for (const Correction& change : changes_)
    combination -= Foam::gSumProd(latest_.open, change.open) * (change.*part);
  return combination;
}

}  // namespace demvof
