// SPDX-License-Identifier: GPL-3.0-or-later
// Change of mesh topology (dynamicRefineFvMesh). OpenFOAM maps every registered field; what mapping
// alone would spoil is put right here: liquid volume where eps differs between merged cells, and the
// flux, which on new faces is only an interpolation.

#include "foam_side/flow.hpp"

namespace demvof {
namespace {

/// New faces have no flux of their own: take it from the mapped face velocity, then make it continuous.
void rebuild_flux(Flow& flow) {
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
}

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

}  // namespace

bool refine_mesh(Flow& flow) {
  if (!flow.mesh.dynamic()) return false;
  std::unique_ptr<volScalarField> liquid;
  if (flow.porosity)
    liquid = std::make_unique<volScalarField>("liquidPerVolume", flow.porosity->eps * flow.alpha);
  flow.face_force.clear();
  flow.pressure_system = PressureSystem();

  flow.mesh.update();
  if (flow.mesh.moving())
    FatalErrorInFunction << "the mesh moves: this solver does refinement, not motion"
                         << Foam::exit(Foam::FatalError);
  if (!flow.mesh.changing()) return false;

  flow.gh = (flow.g & flow.mesh.C()) - flow.gh_reference;
  flow.ghf = (flow.g & flow.mesh.Cf()) - flow.gh_reference;
  flow.reconstruct = std::make_unique<Reconstruction>(flow.mesh);
  if (liquid) restore_liquid(flow, *liquid);
  rebuild_flux(flow);
  flow.mixture.correct();
  return true;
}

}  // namespace demvof
