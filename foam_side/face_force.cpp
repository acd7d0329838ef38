// SPDX-License-Identifier: GPL-3.0-or-later
// Gravity and surface tension at the faces, where they meet the pressure:
//
//   (sigma kappa grad alpha - g.x grad rho).S

#include "foam_side/flow.hpp"

namespace demvof {

void update_face_force(Flow& flow) {
  flow.face_force.clear();
  flow.face_force = -flow.ghf * fvc::snGrad(flow.rho) * flow.mesh.magSf();
  if (flow.scene.surface_tension) {
    flow.mixture.interfaceProperties::correct();
    flow.face_force.ref() += flow.mixture.surfaceTensionForce() * flow.mesh.magSf();
  }
}

}  // namespace demvof
