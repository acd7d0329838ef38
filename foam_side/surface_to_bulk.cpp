// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/surface_to_bulk.hpp"

#include <algorithm>

#include "foam_side/fine_mesh.hpp"

namespace demvof {
namespace {

/// Sums over the subcells of a bulk cell.
struct SurfaceSums {
  double volume = 0, liquid = 0;  // sum V, sum V alpha, m3
  Vec3 steepness;                 // sum V grad alpha, m2: into the liquid
  Vec3 moment;                    // sum V (x - centre), m4: what of the cell is mesh
};

double within_bounds(double alpha) {
  return std::clamp(alpha, 0.0, 1.0);
}

/// The plane in a cell of which the mesh fills a box: all of it, or what a wall along the grid leaves.
BulkSurface plane(const SurfaceSums& sum, const Vec3& spacing) {
  BulkSurface surface;
  surface.liquid_fraction = sum.liquid / sum.volume;
  if (!is_cut(surface)) return surface;
  const double size = norm(sum.steepness);
  surface.normal = size > 0 ? sum.steepness / -size : Vec3{0, 0, 1};
  const Vec3 centroid = sum.moment / sum.volume;
  Vec3 edges;
  for (int axis = 0; axis < 3; ++axis) edges[axis] = spacing[axis] - 2 * std::abs(centroid[axis]);
  surface.offset =
      plane_offset(surface.normal, edges, surface.liquid_fraction) + dot(surface.normal, centroid);
  return surface;
}

}  // namespace

SurfaceToBulk::SurfaceToBulk(const Flow& flow, const BulkCut& cut) : flow_(flow), cut_(cut) {
  look();
}

void SurfaceToBulk::look() {
  if (fluids() == 1) return;
  std::vector<double> liquid(cut_.cells().cells().size());
  for (const Subcell& subcell : cut_.remap().subcells())
    liquid[subcell.slot] += subcell.volume * within_bounds(flow_.alpha[subcell.fine]);
  liquid_ = cut_.cells().fetch_from_owners(cut_.cells().sum_to_owners(liquid), 0.0);
  const std::vector<double>& volume = cut_.remap().bulk_volume();
  for (std::size_t slot = 0; slot < liquid_.size(); ++slot)
    if (volume[slot] > 0) liquid_[slot] /= volume[slot];
}

double SurfaceToBulk::share(int k, const Subcell& subcell) const {
  if (fluids() == 1) return 1;
  if (!is_cut(subcell.slot)) return (liquid_[subcell.slot] > 0.5) == (k == 0) ? 1 : 0;
  const double alpha = within_bounds(flow_.alpha[subcell.fine]);
  return k == 0 ? alpha : 1 - alpha;
}

std::vector<double> SurfaceToBulk::volumes(int k) const {
  std::vector<double> volumes(cut_.cells().cells().size());
  for (const Subcell& subcell : cut_.remap().subcells())
    volumes[subcell.slot] += share(k, subcell) * subcell.volume;
  return cut_.cells().fetch_from_owners(cut_.cells().sum_to_owners(volumes), 0.0);
}

CellValues<BulkSurface> SurfaceToBulk::news() {
  const tmp<volVectorField> gradient = fvc::grad(flow_.alpha);
  const BulkGrid& grid = cut_.grid();
  const std::vector<CellId>& cells = cut_.cells().cells();
  std::vector<SurfaceSums> sums(cells.size());
  for (const Subcell& subcell : cut_.remap().subcells()) {
    SurfaceSums& sum = sums[subcell.slot];
    sum.volume += subcell.volume;
    sum.liquid += subcell.volume * within_bounds(flow_.alpha[subcell.fine]);
    sum.steepness += subcell.volume * to_vec3(gradient()[subcell.fine]);
    sum.moment += subcell.volume * (subcell.centroid - grid.cell_centre(grid.ijk(cells[subcell.slot])));
  }
  const CellValues<SurfaceSums> owned = cut_.cells().sum_to_owners(sums);
  CellValues<BulkSurface> news, now;
  for (std::size_t i = 0; i < owned.cells.size(); ++i) {
    if (!(owned.values[i].volume > 0)) continue;
    const BulkSurface surface = plane(owned.values[i], grid.spacing());
    const bool wet = surface.liquid_fraction > least_seen_share;
    if (wet) {
      now.cells.push_back(owned.cells[i]);
      now.values.push_back(surface);
    }
    const BulkSurface* before = find(seen_, owned.cells[i]);
    const bool was_cut = before && demvof::is_cut(*before);
    if (first_ ? !wet : !demvof::is_cut(surface) && !was_cut && wet == (before != nullptr)) continue;
    news.cells.push_back(owned.cells[i]);
    news.values.push_back(surface);
  }
  seen_ = std::move(now);
  first_ = false;
  return news;
}

void SurfaceToBulk::go_on_from(CellValues<BulkSurface> seen) {
  seen_ = std::move(seen);
  first_ = false;
}

}  // namespace demvof
