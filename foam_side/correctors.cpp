// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of PIMPLE inside a time step: outer correctors, and in each the pressure corrections; further
// ones where these leave too much of the momentum open.

#include "foam_side/flow.hpp"
#include "foam_side/open_momentum.hpp"

namespace demvof {

bool outer_corrector(Flow& flow) {
  return flow.pimple.loop();
}

bool pressure_corrector(Flow& flow) {
  constexpr int most_further_corrections = 20;
  if (flow.pimple.correct()) return true;
  PressureSystem& system = flow.pressure_system;
  if (flow.source && system.viscous && flow.pimple.finalIter() && leaves_too_much_open(flow)) {
    if (system.further_corrections < most_further_corrections) {
      ++system.further_corrections;
      return true;
    }
    Foam::Info << "After " << most_further_corrections
               << " further pressure corrections more momentum is open than half of what was returned"
               << Foam::endl;
  }
  if (flow.pimple.turbCorr()) flow.turbulence->correct();
  return false;
}

}  // namespace demvof
