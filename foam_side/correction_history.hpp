// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "foam_side/openfoam.hpp"

namespace demvof {

/// The corrections of a step so far, each a linear map of what it was given, and what to give the next one.
///
/// A correction is given x, leaves g(x) to the next, and leaves r(x) open, which is 0 where nothing changes
/// any more. Of all combinations of the corrections so far the one with the least |r| goes on (Anderson, J.
/// ACM 12 (1965) 547; of a linear map this is GMRES): what falls slowly from one correction to the next, or
/// grows, is found from how it changed. Collective.
class CorrectionHistory {
 public:
  struct Correction {
    scalarField given, leaves, open;
  };

  void add(Correction correction);

  /// What the best combination leaves to the next correction.
  scalarField next() const { return best(&Correction::leaves); }

  /// What the best combination was given: with it the coming correction leaves open no more than any before.
  scalarField again() const { return best(&Correction::given); }

 private:
  scalarField best(scalarField Correction::*part) const;

  Correction latest_;
  std::vector<Correction> changes_;  // from one correction to the next; their open parts are orthonormal
};

}  // namespace demvof
