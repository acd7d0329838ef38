// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/openfoam.hpp"

namespace demvof {

/// Cell vectors v from their normal components at the cell's faces, least squares weighted by area:
///
///   v = (sum_f S S/|S|)^-1 sum_f S/|S| (v_f . S)
///
/// The matrix depends on the mesh alone and is kept. To be built anew when the mesh changes.
class Reconstruction {
 public:
  explicit Reconstruction(const Foam::fvMesh& mesh);

  /// flux(at, cell): v_f . S as the cell sees it, where at(field) is a surfaceScalarField's value at
  /// the face. Called for both cells of an inner face. Returns one vector per cell.
  template <class Flux>
  Foam::vectorField operator()(const Flux& flux) const;

 private:
  const Foam::fvMesh& mesh_;
  Foam::tensorField inverse_;
};

template <class Flux>
Foam::vectorField Reconstruction::operator()(const Flux& flux) const {
  Foam::vectorField sum(mesh_.nCells(), vector::zero);
  const surfaceVectorField& S = mesh_.Sf();
  const surfaceScalarField& area = mesh_.magSf();
  forAll(mesh_.owner(), face) {
    const auto at = [face](const surfaceScalarField& field) { return field[face]; };
    const vector normal = S[face] / area[face];
    const label owner = mesh_.owner()[face], neighbour = mesh_.neighbour()[face];
    sum[owner] += normal * flux(at, owner);
    sum[neighbour] += normal * flux(at, neighbour);
  }
  forAll(mesh_.boundary(), patch) {
    const Foam::labelUList& cells = mesh_.boundary()[patch].faceCells();
    forAll(S.boundaryField()[patch], i) {
      const auto at = [patch, i](const surfaceScalarField& field) { return field.boundaryField()[patch][i]; };
      sum[cells[i]] += at(mesh_.magSf()) > 0
                           ? S.boundaryField()[patch][i] / at(mesh_.magSf()) * flux(at, cells[i])
                           : vector::zero;
    }
  }
  forAll(sum, cell) sum[cell] = inverse_[cell] & sum[cell];
  return sum;
}

}  // namespace demvof
