// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/divided_cells.hpp"

#include <fmt/format.h>

#include <map>
#include <numeric>
#include <vector>

#include "cyclicAMIPolyPatch.H"
#include "foam_side/vectors.hpp"

namespace demvof {

namespace {

// Of a bulk cell's fluid: less on one side of a wall is not worth a word.
constexpr double least_part = 0.02;

/// Fine cells that are joined to each other.
class Groups {
 public:
  explicit Groups(label cells) : next_(cells) { std::iota(next_.begin(), next_.end(), 0); }
  label of(label cell) {
    while (next_[cell] != cell) cell = next_[cell] = next_[next_[cell]];
    return cell;
  }
  void join(label a, label b) { next_[of(a)] = of(b); }

 private:
  std::vector<label> next_;
};

/// Joined fine cells of one bulk cell.
struct Part {
  double volume = 0;    // m3
  bool walled = false;  // some of them are at a wall
};

}  // namespace

std::string walls_inside_bulk_cells(const Foam::fvMesh& mesh, const BulkGrid& grid) {
  std::vector<CellId> bulk(mesh.nCells());
  for (label cell = 0; cell < mesh.nCells(); ++cell)
    bulk[cell] = grid.id(grid.locate(to_vec3(mesh.cellCentres()[cell])));
  Groups groups(mesh.nCells());
  for (label face = 0; face < mesh.nInternalFaces(); ++face) {
    const label a = mesh.faceOwner()[face], b = mesh.faceNeighbour()[face];
    if (bulk[a] == bulk[b]) groups.join(a, b);
  }
  std::map<CellId, std::map<label, Part>> parts;
  for (label cell = 0; cell < mesh.nCells(); ++cell)
    parts[bulk[cell]][groups.of(cell)].volume += mesh.V()[cell];
  for (const Foam::polyPatch& patch : mesh.boundaryMesh())
    for (const label cell : patch.faceCells()) {
      if (patch.coupled() || Foam::isA<Foam::cyclicAMIPolyPatch>(patch))
        parts[bulk[cell]].clear();  // goes on beyond the face
      else if (const auto part = parts[bulk[cell]].find(groups.of(cell)); part != parts[bulk[cell]].end())
        part->second.walled |= !Foam::isA<Foam::emptyPolyPatch>(patch);
    }

  label divided = 0;
  for (const auto& [cell, here] : parts) {
    double volume = 0;
    for (const auto& [group, part] : here) volume += part.volume;
    int sides = 0;
    for (const auto& [group, part] : here) sides += part.walled && part.volume > least_part * volume;
    divided += sides > 1;
  }
  Foam::reduce(divided, Foam::sumOp<label>());
  if (divided == 0) return {};
  return fmt::format(
      "{} bulk cells have fluid on both sides of a wall inside them: particles on one side displace fluid on "
      "the other, too, and are told of both. Put walls on faces of the bulk grid, or choose smaller bulk "
      "cells (docs/warnings.md, Walls inside bulk cells)",
      divided);
}

}  // namespace demvof
