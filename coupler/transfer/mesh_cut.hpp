// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "coupler/grid/bulk_grid.hpp"
#include "coupler/transfer/mapping_parameters.hpp"

namespace demvof {

/// A polyhedral cell by its faces, each a list of corners ordered so that normals point outward.
struct Polyhedron {
  std::vector<std::vector<Vec3>> faces;
};

/// What the remap needs to know of this rank's fine mesh cells.
struct FineMesh {
  std::vector<double> volume;                 // m3
  std::vector<Vec3> centre;                   // centroid, m
  std::vector<Vec3> lower, upper;             // bounding box, m
  std::function<Polyhedron(int cell)> shape;  // called only for cells that straddle bulk cells
};

/// One subcell: the part of a fine cell that lies in a bulk cell. The volumes of the subcells of a fine
/// cell add up to its volume to round-off.
struct Subcell {
  int fine;       // fine cell
  int slot;       // index into Remap::cells().cells()
  double volume;  // m3
  Vec3 centroid;  // m, inside the bulk cell's box
  Vec3 offset;    // of the centroid from that of the whole fine cell, m; sum of volume * offset is 0
};

/// The subcells of a rank's fine cells, in the order of the fine cells, before slots are known.
struct CutMesh {
  std::vector<Subcell> subcells;  // slot not yet filled
  std::vector<CellId> bulk;       // bulk cell of each subcell
};

/// Cuts fine cells along the planes of the bulk grid. What lies outside the grid belongs to the nearest
/// bulk cell, with a centroid moved into that cell's box; periodic directions wrap, centroids as well.
/// Mapping::nearest: cells stay whole, in the bulk cell of their centre. All others cut.
///
/// Cells inside one bulk cell and axis-aligned boxes are exact to round-off; other shapes are split into
/// tetrahedra (cell centre, mean of the face's corners, edge), which is exact for plane faces. The subcells
/// are scaled so that they add up to the volume given. Parts below 1e-12 of a cell are left out.
CutMesh cut_mesh(const BulkGrid& grid, const FineMesh& mesh, Mapping mapping);

}  // namespace demvof
