// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The surface between liquid and gas as the particles see it: in each bulk cell that it cuts, a plane with
// the cell's own liquid volume below it,
//
//   liquid where n.(x - x_c) < offset        n: unit normal, into the gas;  x_c: centre of the bulk cell
//
// n is the mean gradient of the fine mesh's alpha, and the volume is that of the fine mesh too: a plane
// surface is told exactly, wherever it lies in the bulk cell and however the fine mesh has smeared it. (The
// offset is that of piecewise linear interface calculation: Youngs 1982; Scardovelli and Zaleski, J. Comput.
// Phys. 164 (2000) 228.)
//
// The wetted share of a sphere is that of sphere, planes and cells:
//
//   a = sum over columns of (length below the planes) / sum of lengths
//
// along the axis that the normals favour; the columns are Gauss points s of r = R sqrt(1 - s^2), half length
// R s, weight s^2 ds, and equal angles. Continuous in the place of sphere and surface.

#include <functional>

#include "coupler/base/vec3.hpp"
#include "coupler/grid/bulk_grid.hpp"

namespace demvof {

/// What the surface does in a bulk cell. Plain row of doubles.
struct BulkSurface {
  double liquid_fraction = 0;  // of the fluid's part of the cell, -
  Vec3 normal;                 // unit, into the gas; zero where no plane cuts the cell
  double offset = 0;           // of the plane from the cell's centre along the normal, m
};

/// Below this share of a bulk cell liquid is not seen, nor gas: what MULES leaves behind is no surface.
constexpr double least_seen_share = 1e-4;

inline bool is_cut(const BulkSurface& cell) {
  return cell.liquid_fraction > least_seen_share && cell.liquid_fraction < 1 - least_seen_share;
}

/// Share of a box (edges: m) below the plane normal.x = offset, offset counted from its centre, -. normal:
/// unit.
double share_of_box_below(const Vec3& normal, double offset, const Vec3& edges);
/// The offset from the centre of a box, m, for which that share is as given.
double plane_offset(const Vec3& normal, const Vec3& edges, double share);

/// The surface at one particle.
struct SeenSurface {
  double wetted = 1;    // share of its volume in the liquid, -
  Vec3 normal;          // mean of the planes within two radii, into the gas; zero: none is near
  double distance = 0;  // of the surface from the centre along the normal, m: share_below_plane gives wetted
};

/// cell_of: the surface in a bulk cell, asked for cells within two radii of the centre only.
SeenSurface see_surface(const BulkGrid& grid, const Vec3& position, double radius,
                        const std::function<BulkSurface(CellId)>& cell_of);

}  // namespace demvof
