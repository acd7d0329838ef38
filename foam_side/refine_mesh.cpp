// SPDX-License-Identifier: GPL-3.0-or-later
// Change of mesh topology (dynamicRefineFvMesh). OpenFOAM maps every registered field; what mapping
// alone would spoil is put right: liquid volume where eps differs between merged cells, here; the void
// fraction, which has a profile inside a bulk cell (renew_porosity); and the flux, which on new faces is
// only an interpolation (settle_flux).

#include <algorithm>
#include <limits>
#include <optional>

#include "dynamicRefineFvMesh.H"
#include "findRefCell.H"
#include "foam_side/balance_mesh.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/initial_fields.hpp"
#include "foam_side/last_answer.hpp"
#include "syncTools.H"

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

const Foam::hexRef8& cutter_of(const Foam::fvMesh& mesh) {
  return dynamic_cast<const Foam::dynamicRefineFvMesh&>(mesh).meshCutter();
}

/// How often each cell was halved: a registered field, which mapping takes along.
struct LevelsBefore {
  explicit LevelsBefore(const Foam::fvMesh& mesh)
      : of_cell(Foam::IOobject("levelBeforeChange", mesh.time().timeName(), mesh), mesh,
                dimensionedScalar(Foam::dimless, Foam::Zero)) {
    forAll(of_cell, cell) of_cell[cell] = cutter_of(mesh).cellLevel()[cell];
  }
  volScalarField of_cell;
};

/// On faces inside of cells that were halved OpenFOAM puts the mean of the faces around, walls among them: a
/// stream along a wall stood almost still there.
void renew_new_face_velocities(Flow& flow, const LevelsBefore& before) {
  const Foam::fvMesh& mesh = flow.mesh;
  const Foam::hexRef8& cutter = cutter_of(mesh);
  const auto halved = [&](label cell) { return cutter.cellLevel()[cell] > before.of_cell[cell] + 0.5; };
  const auto parent = [&](label cell) { return cutter.history().parentIndex(cell); };
  forAll(mesh.neighbour(), face) {
    const label own = mesh.owner()[face], next = mesh.neighbour()[face];
    if (halved(own) && halved(next) && parent(own) == parent(next))
      (*flow.face_velocity)[face] = 0.5 * (flow.U[own] + flow.U[next]);
  }
}

/// One look at the mesh: cells are halved or put together once. True if it changed.
bool change_once(Flow& flow) {
  std::unique_ptr<volScalarField> liquid;
  std::optional<LevelsBefore> before;
  if (flow.porosity)
    liquid = std::make_unique<volScalarField>("liquidPerVolume", flow.porosity->eps * flow.alpha);
  if (flow.refinement) {
    flow.refinement->set_marks(flow);
    before.emplace(flow.mesh);
  }
  flow.mesh.update();
  if (flow.mesh.moving())
    FatalErrorInFunction << "the mesh moves: this solver does refinement, not motion"
                         << Foam::exit(Foam::FatalError);
  if (!flow.mesh.changing()) return false;
  if (liquid) restore_liquid(flow, *liquid);
  if (before && flow.face_velocity) renew_new_face_velocities(flow, *before);
  return true;
}

/// Looks at the mesh once, or, as long as that changes it, so often. True if it changed.
bool change_mesh(Flow& flow, int looks) {
  int look = 0;
  while (look < looks && change_once(flow)) ++look;
  return look > 0;
}

/// Where cells on both sides of a cut between ranks are put together, each side keeps the velocity of
/// another one of the faces that became one. The mean of both, or the two ranks' fluxes would differ.
void agree_on_both_sides(surfaceVectorField& face_velocity) {
  const Foam::fvMesh& mesh = face_velocity.mesh();
  Foam::vectorField across(mesh.nBoundaryFaces(), vector::zero);
  const auto first = [&mesh](label patch) {
    return mesh.boundaryMesh()[patch].start() - mesh.nInternalFaces();
  };
  auto& at_boundary = face_velocity.boundaryFieldRef();
  forAll(at_boundary, patch) forAll(at_boundary[patch], face) across[first(patch) + face] =
      at_boundary[patch][face];
  Foam::syncTools::swapBoundaryFaceList(mesh, across);
  forAll(at_boundary, patch) {
    if (!at_boundary[patch].coupled()) continue;
    Foam::fvsPatchVectorField& here = at_boundary[patch];
    forAll(here, face) here[face] = 0.5 * (here[face] + across[first(patch) + face]);
  }
}

/// What hangs on the mesh and is no mapped field; values across cuts between ranks, of the step before too: a
/// flux that takes them differs on both sides of the cut otherwise.
/// The mesh counts as changed from here on, also when only an earlier look changed it.
void renew_geometry(Flow& flow) {
  for (volScalarField* field :
       {&flow.alpha, &flow.alpha.oldTime(), &flow.mixture.alpha2(), &flow.rho, &flow.rho.oldTime()})
    field->correctBoundaryConditions();
  for (volVectorField* field : {&flow.U, &flow.U.oldTime()}) field->correctBoundaryConditions();
  renew_gravity_potential(flow);
  Foam::setRefCell(flow.p, flow.p_rgh, flow.pimple.dict(), flow.p_reference_cell, flow.p_reference);
  flow.reconstruct = std::make_unique<Reconstruction>(flow.mesh);
  // The model itself does this in its next step, and wall functions come before.
  flow.mesh.topoChanging(true);
  const_cast<Foam::nearWallDist&>(flow.turbulence->y()).correct();
}

void record_balance(Flow& flow) {
  Refinement& refinement = *flow.refinement;
  refinement.worst_imbalance = std::max(refinement.worst_imbalance, imbalance(flow.mesh));
  ++refinement.changes;
}

}  // namespace

bool refine_mesh(Flow& flow, const std::function<void()>& before) {
  if (!flow.mesh.dynamic()) return false;
  if (flow.refinement && !flow.refinement->due(flow)) {
    flow.mesh.topoChanging(false);
    return false;
  }
  if (before) before();
  flow.face_force.clear();
  std::unique_ptr<volScalarField> answer = std::move(flow.pressure_system.inverse_diagonal);
  flow.pressure_system = PressureSystem();
  if (!flow.source) flow.pressure_system.inverse_diagonal = std::move(answer);  // mapped like the rest
  // At the start the mesh may be as coarse as the case's: every level at once, each from the one before.
  const bool changed =
      change_mesh(flow, flow.refinement && flow.refinement->first ? flow.refinement->parameters.levels : 1);
  if (flow.refinement) flow.refinement->first = false;
  if (!changed) return false;
  balance_mesh(flow);
  renew_geometry(flow);
  if (flow.refinement) record_balance(flow);
  return true;
}

void refine_start(Flow& flow) {
  const InitialFields fields(flow);
  if (!fields.given()) return;
  // OpenFOAM changes no mesh in step 0. No step of the run has this number, so each field's value of the
  // step before is taken anew in step 1.
  const double now = flow.time.value();
  const label step = flow.time.timeIndex();
  flow.time.setTime(now, std::numeric_limits<label>::max());
  bool changed = false;
  for (int level = 0; level < flow.refinement->parameters.levels && change_once(flow); ++level) {
    fields.set(flow);
    changed = true;
  }
  flow.time.setTime(now, step);
  flow.mesh.topoChanging(false);
  if (!changed) return;
  balance_mesh(flow);
  renew_geometry(flow);
  flow.mesh.topoChanging(false);
  record_balance(flow);
  balance_pressure(flow);
  flow.phi = fvc::flux(flow.U);
}

void settle_flux(Flow& flow) {
  agree_on_both_sides(*flow.face_velocity);
  flow.face_velocity->oldTime() == *flow.face_velocity;
  flow.phi = flux_of_face_velocity(flow);
  if (flow.porosity) {
    follow_solid(flow);
    flow.phi = flux_of(flow, flow.phi);
  }
  const tmp<scalarField> wanted = flow.porosity ? wanted_porosity_rate(flow) : tmp<scalarField>();
  fit_flux(flow, flow.source ? projection_mobility(flow) : last_answer(flow),
           flow.porosity ? &wanted() : nullptr);
  flow.mixture.correct();
}

}  // namespace demvof
