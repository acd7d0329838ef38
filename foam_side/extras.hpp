// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "IOMRFZoneList.H"
#include "foam_side/flow.hpp"
#include "fvOptions.H"

namespace demvof {

/// When the points of the mesh move.
enum class MeshMotion { never, each_step, each_corrector };

/// What interFoam's dictionaries may ask beyond Euler steps on a mesh at rest; without particles as interFoam
/// does it. Belongs to the mesh, whose registry keeps it.
struct Extras : Foam::regIOobject {
  explicit Extras(const Flow& flow);
  bool writeData(Foam::Ostream&) const override { return true; }

  Foam::IOMRFZoneList rotating;  // MRF zones; only without particles
  Foam::fv::options& sources;    // fvOptions, per volume of fluid: eps times as much per volume
  bool sources_of_momentum;
  MeshMotion motion;
  // Momentum steps other than Euler need the flux of liquid at the end of the step, m3/s.
  std::unique_ptr<surfaceScalarField> liquid_flux;
  // alphaApplyPrevCorr: compression flux of the last step, m3/s.
  std::unique_ptr<surfaceScalarField> compression;
};

/// Part of open_flow.
void make_extras(Flow& flow);
Extras& extras(const Flow& flow);

/// The flux of liquid, m3/s, to function objects that carry something with the liquid (scalarTransport).
void show_liquid_flux(const Flow& flow, const surfaceScalarField& flux);

/// What fvSolution says about alpha. advectionScheme, where it is not said, is that of the solver that the
/// case was written for (controlDict: application).
struct AdvectionControls {
  explicit AdvectionControls(const Flow& flow);

  Foam::word scheme;
  bool geometric;       // flux from the cut of the interface instead of a compression flux
  bool bounded_by_own;  // isoAdvector's own bounding, as in interIsoFoam, which knows no eps
  label correctors, sub_cycles;
  bool semi_implicit;       // MULESCorr: implicit upwind step first, MULES on the rest
  bool reuse;               // alphaApplyPrevCorr: begin with the last step's compression
  scalar isotropic, shear;  // icAlpha, scAlpha: of the compression speed, -
};

/// Throws Foam::error, with the reason and what to do, for what a case asks and this solver does not do. Part
/// of open_flow, so that `demvof check` finds it.
void refuse_what_is_not_done(const Flow& flow);

/// Without particles, in the first corrector of a step, or in each: points move, and the flux becomes that of
/// the moved mesh.
void move_mesh(Flow& flow);

/// p, and in a closed box the level of p_rgh, from p_rgh: at the end of a step, and before bodies that float
/// are moved by the pressure of the last corrector.
void update_total_pressure(Flow& flow);

}  // namespace demvof
