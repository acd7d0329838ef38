// SPDX-License-Identifier: GPL-3.0-or-later
// How the particles move through the faces of the fine mesh, and the flux of a fluid that goes with them, or
// makes room for them:
//
//   J_v = v.S - s,   div(s) = d(eps)/dt       s: flux of solid
//   v.S = mean(psi v).S / mean(psi)           psi = 1 - eps
//
// The void fraction of a face, a mean of two cells', does not say where between them the edge of a bed is: s
// is not mean(psi) v.S there, but what makes the void fraction change as it does. It is found from that by a
// potential along the motion,
//
//   s = mean(psi) v.S - M grad(q).S,   M = mean(psi) |v.n|,   div(M grad q) = div(mean(psi) v) - d(eps)/dt
//
// Where nothing moves M is 0. A void fraction that changes otherwise (particles that are put in or taken out,
// that grow, or that a surface shares out anew) is no motion, and must not be taken for one: what goes
// through a face is limited to
//
//   0 <= s <= 2 max(psi of both sides) v.S      2: an edge may lie within the cell
//
// What s leaves of d(eps)/dt takes its room from the fluid at once. The flux that makes it, of a potential,
// is added to J_v and has no inertia and no drag: it would start and end with the window, and the impulses of
// that, equal and opposite, would be felt by particles that are there for the second alone. (Neutral spheres
// put into water at rest, a quarter of the volume in a window of 1 ms, went off with 0.2 m/s.)

#include <algorithm>

#include "foam_side/flow.hpp"
#include "gaussLaplacianScheme.H"

namespace demvof {
namespace {

/// What the particles do not do at the ends of the fluid.
void close_boundary(surfaceScalarField& flux) {
  for (auto& patch : flux.boundaryFieldRef())
    if (!patch.coupled()) patch == 0;
}

/// M grad(q).S above, m3/s.
tmp<surfaceScalarField> missed_by_means(Flow& flow, const surfaceScalarField& solid_flux,
                                        const surfaceScalarField& solid_f) {
  constexpr double slack = 1e-6;  // of a cell's sum of M: what cannot be explained by motion is left
  const Foam::fvMesh& mesh = flow.mesh;
  const Porosity& porosity = *flow.porosity;
  volScalarField potential(Foam::IOobject("solidPotential", flow.time.timeName(), mesh,
                                          Foam::IOobject::NO_READ, Foam::IOobject::NO_WRITE, false),
                           mesh, dimensionedScalar(Foam::dimLength, Foam::Zero),
                           Foam::zeroGradientFvPatchScalarField::typeName);
  mesh.setFluxRequired(potential.name());
  const surfaceScalarField mobility(solid_f * Foam::mag(porosity.along));  // M |S|
  Foam::fvScalarMatrix equation(Foam::fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(
                                    mobility, mesh.nonOrthDeltaCoeffs(), potential) == fvc::div(solid_flux));
  equation.source() -= mesh.V().field() * porosity.rate.field();
  const tmp<volScalarField> sum = fvc::surfaceSum(mobility * mesh.nonOrthDeltaCoeffs());
  const double most = Foam::gMax(sum().primitiveField());
  if (most == 0) return 0 * porosity.along;
  equation.diag() -= slack * (sum().primitiveField() + slack * most);
  Foam::dictionary solver;
  // What it corrects lies within a cell or two of an edge: some iterations find it. Of a kind that does not
  // know how the mesh is cut among ranks.
  solver.add("solver", Foam::word("PCG"));
  solver.add("preconditioner", Foam::word("diagonal"));
  solver.add("maxIter", 12);
  solver.add("tolerance", 1e-12);
  equation.solve(solver);
  return equation.flux();
}

/// Keeps s between nothing and twice what the denser side of each face would carry through it.
void limit(surfaceScalarField& solid_flux, const surfaceScalarField& along, const volScalarField& solid) {
  const auto limited = [](scalar flux, scalar along_face, scalar one, scalar other) {
    const scalar most = 2 * std::max(one, other) * along_face;
    return std::clamp(flux, std::min(most, 0.0), std::max(most, 0.0));
  };
  const Foam::labelUList &owner = solid.mesh().owner(), &neighbour = solid.mesh().neighbour();
  forAll(neighbour, face) solid_flux[face] =
      limited(solid_flux[face], along[face], solid[owner[face]], solid[neighbour[face]]);
  forAll(solid_flux.boundaryField(), patch) {
    if (!solid.boundaryField()[patch].coupled()) continue;
    auto& flux = solid_flux.boundaryFieldRef()[patch];
    const scalarField here(solid.boundaryField()[patch].patchInternalField());
    const scalarField there(solid.boundaryField()[patch].patchNeighbourField());
    forAll(flux, face) flux[face] =
        limited(flux[face], along.boundaryField()[patch][face], here[face], there[face]);
  }
}

/// With div = -(d(eps)/dt - div(s)), m3/s.
tmp<surfaceScalarField> flux_that_makes_room(Flow& flow, const surfaceScalarField& solid_flux) {
  const tmp<volScalarField> moved = fvc::div(solid_flux);
  const scalarField left(flow.porosity->rate.field() - moved().primitiveField());
  tmp<surfaceScalarField> flux(0 * flow.porosity->along);
  fit_flux(flow, flux.ref(), projection_mobility(flow), &left, solver_for_rest(flow, left));
  return flux;
}

}  // namespace

void set_solid_velocity(Flow& flow, const Foam::vectorField& velocity) {
  flow.porosity->solid_velocity.field() = velocity;
}

bool follow_solid(Flow& flow, bool at_start) {
  Porosity& porosity = *flow.porosity;
  const bool moves = Foam::gMax(Foam::mag(porosity.solid_velocity.field())()) > 0;
  const bool changes = Foam::gMax(Foam::mag(porosity.rate.field())()) > 0;
  const bool moved = Foam::gMax(Foam::mag(porosity.carried.primitiveField())()) > 0;
  if (!moves && !moved && !changes) return false;
  volScalarField solid("solidFraction", 1.0 - porosity.eps);
  solid.max(0.0);
  volVectorField flux_density(Foam::IOobject("solidFluxDensity", flow.time.timeName(), flow.mesh,
                                             Foam::IOobject::NO_READ, Foam::IOobject::NO_WRITE, false),
                              flow.mesh, Foam::dimensionedVector(Foam::dimVelocity, Foam::Zero),
                              Foam::zeroGradientFvPatchVectorField::typeName);
  flux_density.primitiveFieldRef() = solid.primitiveField() * porosity.solid_velocity.field();
  flux_density.correctBoundaryConditions();
  const surfaceScalarField solid_f(fvc::interpolate(solid));
  porosity.along =
      fvc::flux(flux_density) / (solid_f + dimensionedScalar("tiny", Foam::dimless, Foam::VSMALL));
  close_boundary(porosity.along);
  const surfaceScalarField eps_f(face_void_fraction(porosity.eps));
  porosity.carried = eps_f * porosity.along;
  if (at_start) return true;
  surfaceScalarField solid_flux(porosity.along - porosity.carried);
  if (moves) {
    solid_flux -= missed_by_means(flow, solid_flux, solid_f);
    limit(solid_flux, porosity.along, solid);
  }
  porosity.carried = porosity.along - solid_flux + flux_that_makes_room(flow, solid_flux);
  return true;
}

tmp<surfaceScalarField> flux_of(const Flow& flow, const surfaceScalarField& velocity_flux) {
  const Porosity& porosity = *flow.porosity;
  return porosity.carried + face_void_fraction(porosity.eps) * (velocity_flux - porosity.along);
}

tmp<surfaceScalarField> velocity_flux_of(const Flow& flow, const surfaceScalarField& flux) {
  const Porosity& porosity = *flow.porosity;
  return porosity.along + (flux - porosity.carried) / face_void_fraction(porosity.eps);
}

}  // namespace demvof
