// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the versions of OpenFOAM (openfoam.com, OPENFOAM is 1912 to 2412) name differently. Everything else
// here is written so that all of them take it; docs/versions.md says what was run, and what compiled only.

#include <type_traits>

#include "foam_side/openfoam.hpp"
#include "fvMeshDistribute.H"
#include "isoAdvection.H"

#if OPENFOAM < 2006
#include "isoCutCell.H"
#include "isoCutFace.H"
#else
#include "cutFaceAdvect.H"
#include "surfaceIteratorIso.H"
#endif

namespace demvof {

/// The iso-surface of values at the mesh's points that leaves alpha of a cell on its wet side, and what its
/// faces let pass while that surface moves. Rewritten in v2006 (library geometricVoF).
class CellCut {
 public:
  /// at_points: the values, which have to live as long as this.
  CellCut(const Foam::fvMesh& mesh, [[maybe_unused]] const volScalarField& alpha, scalarField& at_points)
#if OPENFOAM < 2006
      : cell_(mesh, at_points),
        face_(mesh, at_points){}
#else
      : cell_(mesh, at_points, 0), face_(mesh, alpha) {
  }
#endif

        /// False where the cell cannot be cut. tolerance: of alpha.
        bool cut(label cell, scalar alpha, scalar tolerance) {
    constexpr label most = 100;  // iterations of the search for the iso-value
    return cell_.vofCutCell(cell, alpha, tolerance, most) == 0;
  }

#if OPENFOAM < 2006
  Foam::point centre() {
    return cell_.isoFaceCentre();
  }
  vector area() {
    return cell_.isoFaceArea();
  }
#else
  Foam::point centre() {
    return cell_.surfaceCentre();
  }
  vector area() {
    return cell_.surfaceArea();
  }
#endif

  /// Volume of liquid, m3, through a face of the cell that was cut last, within dt, s, while the cut moves
  /// along its normal with a speed, m/s. flux: m3/s through the whole face; size: its area, m2.
  scalar wet_volume(label face, const Foam::point& centre, const vector& normal, scalar speed, scalar dt,
                    scalar flux, scalar size) {
#if OPENFOAM < 2006
    return face_.timeIntegratedFaceFlux(face, centre, normal, speed, cell_.isoValue(), dt, flux, size);
#else
    return face_.timeIntegratedFaceFlux(face, centre, normal, speed, dt, flux, size);
#endif
  }

 private:
#if OPENFOAM < 2006
  Foam::isoCutCell cell_;
  Foam::isoCutFace face_;
#else
  Foam::surfaceIteratorIso cell_;
  Foam::cutFaceAdvect face_;
#endif
};

/// A step of isoAdvector with its own bounding. Returns the flux of liquid, m3/s.
inline tmp<surfaceScalarField> advect_and_bound(volScalarField& alpha, const surfaceScalarField& phi,
                                                const volVectorField& velocity) {
  Foam::isoAdvection advector(alpha, phi, velocity);
#if OPENFOAM < 2006
  advector.advect();
#else
  advector.advect(Foam::zeroField(), Foam::zeroField());
#endif
  return advector.getRhoPhi(dimensionedScalar("liquid", Foam::dimless, 1),
                            dimensionedScalar("gas", Foam::dimless, 0));
}

/// Moves the cells, with every registered field, to the ranks given for them.
template <class Distribute = Foam::fvMeshDistribute>
auto distribute_mesh(Foam::fvMesh& mesh, const Foam::labelList& ranks) {
  if constexpr (std::is_constructible_v<Distribute, Foam::fvMesh&>)
    return Distribute(mesh).distribute(ranks);
  else
    return Distribute(mesh, 1e-6 * mesh.bounds().mag()).distribute(ranks);  // where points are the same, m
}

}  // namespace demvof
