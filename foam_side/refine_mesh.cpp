// SPDX-License-Identifier: GPL-3.0-or-later
// Change of mesh topology (dynamicRefineFvMesh). OpenFOAM maps every registered field; what mapping
// alone would spoil is put right: liquid volume where eps differs between merged cells, here; the void
// fraction, which has a profile inside a bulk cell (renew_porosity); and the flux, which on new faces is
// only an interpolation (settle_flux).

#include <algorithm>

#include "foam_side/flow.hpp"

namespace demvof {
namespace {

/// alpha and rho, old-time values included, from the mapped liquid volume.
void restore_liquid(Flow& flow, const volScalarField& liquid) {
  for (volScalarField* alpha : {&flow.alpha.oldTime(), &flow.alpha}) {
    alpha->primitiveFieldRef() = liquid.primitiveField() / flow.porosity->eps.primitiveField();
    alpha->correctBoundaryConditions();
  }
  flow.mixture.alpha2() = 1.0 - flow.alpha;
  for (volScalarField* rho : {&flow.rho.oldTime(), &flow.rho})
    *rho == flow.alpha* flow.mixture.rho1() + flow.mixture.alpha2() * flow.mixture.rho2();
}

/// One look at the mesh: cells are halved or put together once. True if it changed.
bool change_once(Flow& flow) {
  std::unique_ptr<volScalarField> liquid;
  if (flow.porosity)
    liquid = std::make_unique<volScalarField>("liquidPerVolume", flow.porosity->eps * flow.alpha);
  if (flow.refinement) flow.refinement->set_marks(flow);
  flow.mesh.update();
  if (flow.mesh.moving())
    FatalErrorInFunction << "the mesh moves: this solver does refinement, not motion"
                         << Foam::exit(Foam::FatalError);
  if (!flow.mesh.changing()) return false;
  if (liquid) restore_liquid(flow, *liquid);
  return true;
}

void record_balance(Flow& flow) {
  const double most = Foam::returnReduce(flow.mesh.nCells(), Foam::maxOp<label>());
  const double all = Foam::returnReduce(flow.mesh.nCells(), Foam::sumOp<label>());
  Refinement& refinement = *flow.refinement;
  refinement.worst_imbalance = std::max(refinement.worst_imbalance, most * Foam::Pstream::nProcs() / all);
  ++refinement.changes;
}

}  // namespace

bool refine_mesh(Flow& flow) {
  if (!flow.mesh.dynamic()) return false;
  if (flow.refinement && !flow.refinement->due(flow)) {
    flow.mesh.topoChanging(false);
    return false;
  }
  flow.face_force.clear();
  flow.pressure_system = PressureSystem();
  bool changed = false;
  // The start is as coarse as the case's mesh: every level at once, each from the one before.
  const int looks = flow.refinement && flow.refinement->first ? flow.refinement->parameters.levels : 1;
  for (int look = 0; look < looks; ++look) changed = change_once(flow) || changed;
  if (flow.refinement) flow.refinement->first = false;
  if (!changed) return false;
  flow.mesh.topoChanging(true);  // also when only an earlier look changed it
  flow.gh = (flow.g & flow.mesh.C()) - flow.gh_reference;
  flow.ghf = (flow.g & flow.mesh.Cf()) - flow.gh_reference;
  flow.reconstruct = std::make_unique<Reconstruction>(flow.mesh);
  if (flow.refinement) record_balance(flow);
  return true;
}

void settle_flux(Flow& flow) {
  flow.phi = flow.mesh.Sf() & *flow.face_velocity;
  auto& at_boundary = flow.phi.boundaryFieldRef();
  forAll(at_boundary, patch) {
    const auto& wall_velocity = flow.U.boundaryField()[patch];
    if (wall_velocity.fixesValue())
      at_boundary[patch] = wall_velocity & flow.mesh.Sf().boundaryField()[patch];
  }
  if (flow.porosity) flow.phi *= face_void_fraction(flow.porosity->eps);
  const tmp<scalarField> wanted = flow.porosity ? wanted_porosity_rate(flow) : tmp<scalarField>();
  fit_flux(flow, projection_mobility(flow), flow.porosity ? &wanted() : nullptr);
  flow.mixture.correct();
}

}  // namespace demvof
