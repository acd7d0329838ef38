// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/geometric_flux.hpp"

#include "extrapolatedCalculatedFvPatchFields.H"
#include "foam_side/flow.hpp"
#include "foam_side/foam_compat.hpp"
#include "interpolationCellPoint.H"
#include "syncTools.H"
#include "volPointInterpolation.H"

namespace demvof {
namespace {

/// Values of all faces in the mesh's own numbering; empty patches give 0.
scalarField all_faces(const surfaceScalarField& field) {
  const Foam::fvMesh& mesh = field.mesh();
  scalarField values(mesh.nFaces(), 0);
  forAll(field, face) values[face] = field[face];
  forAll(field.boundaryField(), patch) {
    const auto& at_patch = field.boundaryField()[patch];
    forAll(at_patch, i) values[mesh.boundaryMesh()[patch].start() + i] = at_patch[i];
  }
  return values;
}

/// The wet share of what a face lets pass, where the cell it comes from holds an interface; else -1.
class WetShares {
 public:
  WetShares(const Flow& flow, const surfaceScalarField& phi)
      : flow_(flow),
        mesh_(flow.mesh),
        at_points_(Foam::volPointInterpolation::New(mesh_).interpolate(flow.alpha)().primitiveField()),
        cut_(mesh_, flow.alpha, at_points_),
        velocity_(flow.U),
        through_(all_faces(phi)),
        area_(all_faces(mesh_.magSf())),
        share_(mesh_.nFaces(), -1.0) {
    const Foam::dictionary& controls = mesh_.solverDict(flow.alpha.name());
    const scalar cut_tolerance = controls.lookupOrDefault<scalar>("isoFaceTol", 1e-8);
    const scalar surface_tolerance = controls.lookupOrDefault<scalar>("surfCellTol", 1e-8);
    forAll(flow.alpha, cell) {
      const scalar alpha = flow.alpha[cell];
      const bool surface = alpha > surface_tolerance && alpha < 1 - surface_tolerance;
      if (surface && cut_.cut(cell, alpha, cut_tolerance)) leave(cell);
    }
    hand_to_other_side();
  }

  const scalarField& values() const { return share_; }

 private:
  /// Faces through which fluid leaves a cell that has just been cut.
  void leave(label cell) {
    const Foam::point centre = cut_.centre();
    const vector area = cut_.area();
    if (Foam::mag(area) <= 0) return;
    const vector normal = area / Foam::mag(area);
    const scalar speed = velocity_.interpolate(centre, cell) & normal;
    const scalar dt = flow_.time.deltaTValue();
    for (const label face : mesh_.cells()[cell]) {
      const scalar outwards = mesh_.faceOwner()[face] == cell ? through_[face] : -through_[face];
      if (outwards <= Foam::VSMALL || area_[face] <= 0) continue;
      const scalar volume = cut_.wet_volume(face, centre, normal, speed, dt, through_[face], area_[face]);
      share_[face] = volume / (through_[face] * dt);
    }
  }

  /// The cell behind a processor or periodic face knows nothing of the cut in front of it.
  void hand_to_other_side() {
    scalarField boundary(mesh_.nBoundaryFaces());
    forAll(boundary, i) boundary[i] = share_[mesh_.nInternalFaces() + i];
    Foam::syncTools::syncBoundaryFaceList(mesh_, boundary, Foam::maxEqOp<scalar>());
    forAll(boundary, i) share_[mesh_.nInternalFaces() + i] = boundary[i];
  }

  const Flow& flow_;
  const Foam::fvMesh& mesh_;
  scalarField at_points_;
  CellCut cut_;
  Foam::interpolationCellPoint<vector> velocity_;
  scalarField through_, area_;
  scalarField share_;
};

}  // namespace

tmp<surfaceScalarField> geometric_flux(const Flow& flow, const surfaceScalarField& phi) {
  tmp<surfaceScalarField> flux = Foam::upwind<scalar>(flow.mesh, phi).flux(flow.alpha);
  const WetShares wet(flow, phi);
  const scalarField& share = wet.values();
  surfaceScalarField& liquid = flux.ref();
  forAll(liquid, face) if (share[face] >= 0) liquid[face] = share[face] * phi[face];
  forAll(liquid.boundaryField(), patch) {
    auto& at_patch = liquid.boundaryFieldRef()[patch];
    if (!at_patch.coupled()) continue;  // an outlet takes the cell's alpha: MULES limits no outlet
    const label start = flow.mesh.boundaryMesh()[patch].start();
    forAll(at_patch, i) {
      const scalar value = share[start + i];
      if (value >= 0) at_patch[i] = value * phi.boundaryField()[patch][i];
    }
  }
  return flux;
}

tmp<surfaceScalarField> advance_by_cuts(Flow& flow, const surfaceScalarField& phi,
                                        const volVectorField& velocity) {
  if (!flow.mesh.moving()) return advect_and_bound(flow.alpha, phi, velocity);
  volVectorField relative("UtoMesh", velocity);
  volVectorField of_mesh(Foam::IOobject("Umesh", flow.time.timeName(), flow.mesh), flow.mesh,
                         Foam::dimensionedVector(Foam::dimVelocity, Foam::Zero),
                         Foam::extrapolatedCalculatedFvPatchVectorField::typeName);
  const surfaceScalarField& swept = flow.mesh.phi();
  of_mesh.primitiveFieldRef() = (*flow.reconstruct)([&](const auto& at, label) { return at(swept); });
  of_mesh.correctBoundaryConditions();
  relative -= of_mesh;
  return advect_and_bound(flow.alpha, phi, relative);
}

}  // namespace demvof
