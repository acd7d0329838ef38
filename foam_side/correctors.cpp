// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of PIMPLE inside a time step: outer correctors, and in each the pressure corrections.

#include "foam_side/flow.hpp"

namespace demvof {

bool outer_corrector(Flow& flow) {
  return flow.pimple.loop();
}

bool pressure_corrector(Flow& flow) {
  const PressureSystem& system = flow.pressure_system;
  if (system.viscous ? !system.settled : flow.pimple.correct()) return true;
  if (flow.pimple.turbCorr()) flow.turbulence->correct();
  return false;
}

}  // namespace demvof
