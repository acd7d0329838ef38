// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "coupler/base/vec3.hpp"
#include "coupler/closures/lubrication.hpp"

namespace demvof {

enum class DragLaw { none, schiller_naumann, gidaspow, di_felice, koch_hill, beetstra, rong };
enum class OwnWake { none, oseen };

enum class LiftLaw { none, saffman_mei };
enum class SpinLiftLaw { none, rubinow_keller, oesterle_bui_dinh };
enum class SuspensionViscosity { none, krieger_dougherty, eilers };

struct ForceParameters {
  DragLaw drag = DragLaw::schiller_naumann;
  bool pressure_gradient = true;
  OwnWake own_wake = OwnWake::none;  // correction of the sampled velocity for the particle's own disturbance
  bool viscous_stress = false;
  double added_mass = 0;  // C_m, -: the particle moves C_m times its own volume of fluid with it
  LiftLaw lift = LiftLaw::none;
  SpinLiftLaw spin_lift = SpinLiftLaw::none;
  bool torque = false;
  bool history = false;
  std::optional<LubricationParameters> lubrication;
  bool capillary = false;
  SuspensionViscosity suspension_viscosity = SuspensionViscosity::none;  // in the fluid's stress
  Vec3 constant;                                                         // N on each particle, from outside
};

/// True of a law that has a bed of several sizes in it (size_mix.hpp).
inline bool knows_sizes(DragLaw law) {
  return law == DragLaw::beetstra;
}

/// True when a force asks for the fluid's rotation.
inline bool need_vorticity(const ForceParameters& forces) {
  return forces.lift != LiftLaw::none || forces.spin_lift != SpinLiftLaw::none || forces.torque;
}

/// True when a force asks for the fluid's acceleration.
inline bool need_acceleration(const ForceParameters& forces) {
  return forces.added_mass > 0 || forces.history;
}

/// True when a force asks for derivatives of the fluid's velocity or for its surface (BulkFluidGradients).
inline bool need_gradients(const ForceParameters& forces) {
  return forces.viscous_stress || need_acceleration(forces) || need_vorticity(forces) || forces.capillary;
}

}  // namespace demvof
