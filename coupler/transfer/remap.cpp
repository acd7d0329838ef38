// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/remap.hpp"

#include <algorithm>
#include <utility>

namespace demvof {
namespace {

/// The fluid domain of one bulk cell. Plain row of doubles: summed over the ranks.
struct FluidDomain {
  double volume = 0;  // m3
  Vec3 moment;        // volume * (centroid - centre of the bulk cell), m4
  double subcells = 0;
};

/// All cells within one step of the given ones, as a block with those marked.
CellBlock mark_surroundings(const BulkGrid& grid, const std::vector<CellId>& cells) {
  std::array<int, 3> first = grid.cells(), last{-1, -1, -1};
  for (const CellId cell : cells) {
    const std::array<int, 3> ijk = grid.ijk(cell);
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = std::min(first[axis], ijk[axis] - 1);
      last[axis] = std::max(last[axis], ijk[axis] + 1);
    }
  }
  if (cells.empty()) return CellBlock(grid, {0, 0, 0}, {-1, -1, -1});
  for (int axis = 0; axis < 3; ++axis) {
    const int n = grid.cells()[axis];
    const bool wraps = grid.periodic()[axis] && (first[axis] < 0 || last[axis] >= n);
    first[axis] = wraps ? 0 : std::max(first[axis], 0);
    last[axis] = wraps ? n - 1 : std::min(last[axis], n - 1);
  }
  CellBlock block(grid, first, last);
  for (const CellId cell : cells) {
    const std::array<int, 3> ijk = grid.ijk(cell);
    for (int step = 0; step < 27; ++step) {
      const std::ptrdiff_t place = block.place_beside(ijk, {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1});
      if (place >= 0) block.mark(place);
    }
  }
  return block;
}

}  // namespace

Remap::Overlap Remap::find_overlap(const BulkGrid& grid, const FineMesh& mesh, Mapping to_bulk) {
  CutMesh cut = cut_mesh(grid, mesh, to_bulk);
  std::vector<CellId> overlapped;
  for (const CellId cell : cut.bulk)  // neighbours in the list are often in the same cell
    if (overlapped.empty() || overlapped.back() != cell) overlapped.push_back(cell);
  std::sort(overlapped.begin(), overlapped.end());
  overlapped.erase(std::unique(overlapped.begin(), overlapped.end()), overlapped.end());
  CellBlock block = mark_surroundings(grid, overlapped);
  std::vector<CellId> cells = block.list_marked();
  return {std::move(cut), std::move(block), std::move(cells)};
}

Remap::Remap(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition, const FineMesh& mesh,
             const MappingParameters& mapping)
    : Remap(world, grid, partition, mesh, mapping.to_fine, find_overlap(grid, mesh, mapping.to_bulk)) {}

Remap::Remap(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition, const FineMesh& mesh,
             Mapping to_fine, Overlap overlap)
    : cells_(world, partition, overlap.cells),
      subcells_(std::move(overlap.cut.subcells)),
      interpolates_(interpolates(to_fine)) {
  inverse_volume_.reserve(mesh.volume.size());
  for (const double volume : mesh.volume) inverse_volume_.push_back(1.0 / volume);

  const std::vector<CellId>& cells = overlap.cells;
  std::vector<FluidDomain> domain(cells.size());
  int slot = -1;
  Vec3 centre;
  for (std::size_t p = 0; p < subcells_.size(); ++p) {
    Subcell& subcell = subcells_[p];
    if (p == 0 || overlap.cut.bulk[p] != overlap.cut.bulk[p - 1]) {
      const std::array<int, 3> ijk = grid.ijk(overlap.cut.bulk[p]);
      slot = overlap.block.slot(overlap.block.place(ijk));
      centre = grid.cell_centre(ijk);
    }
    subcell.slot = slot;
    straddles_ |= p > 0 && subcells_[p - 1].fine == subcell.fine;
    domain[slot].volume += subcell.volume;
    domain[slot].moment += subcell.volume * (subcell.centroid - centre);
    domain[slot].subcells += 1;
  }
  std::vector<int> has_slope;
  slope_of_.assign(cells.size(), -1);
  std::vector<char> here(cells.size());
  for (std::size_t s = 0; s < cells.size(); ++s) here[s] = domain[s].subcells > 0;

  domain = cells_.fetch_from_owners(cells_.sum_to_owners(domain), FluidDomain{});
  for (std::size_t s = 0; s < cells.size(); ++s) {
    const Vec3 middle = grid.cell_centre(grid.ijk(cells[s]));
    bulk_volume_.push_back(domain[s].volume);
    bulk_centroid_.push_back(domain[s].volume > 0 ? middle + domain[s].moment / domain[s].volume : middle);
    // A single subcell has its centroid where the bulk cell has it: a slope would change nothing.
    if (to_fine == Mapping::conservative && here[s] && domain[s].subcells > 1) {
      slope_of_[s] = static_cast<int>(has_slope.size());
      has_slope.push_back(static_cast<int>(s));
    }
  }
  slopes_ = LimitedSlopes(grid, cells, overlap.block, bulk_volume_, bulk_centroid_, has_slope);
  if (interpolates_)
    interpolation_ = BulkInterpolation(to_fine, grid, overlap.block, bulk_volume_, mesh.centre, subcells_);
}

std::vector<double> Remap::to_fine(const std::vector<double>& totals, int width,
                                   const std::vector<char>& flat) const {
  std::vector<double> means(totals.size(), 0.0);
  for (std::size_t slot = 0; slot < bulk_volume_.size(); ++slot)
    if (bulk_volume_[slot] > 0)
      for (int m = 0; m < width; ++m) means[slot * width + m] = totals[slot * width + m] / bulk_volume_[slot];
  if (interpolates_) return interpolation_.evaluate(means, width);
  const std::vector<Vec3> slopes = slopes_.evaluate(means, width);

  std::vector<double> fine(inverse_volume_.size() * width, 0.0);
  for (const Subcell& subcell : subcells_) {
    const double share = subcell.volume * inverse_volume_[subcell.fine];
    const double* mean = &means[std::size_t(subcell.slot) * width];
    double* value = &fine[std::size_t(subcell.fine) * width];
    for (int m = 0; m < width; ++m) value[m] += share * mean[m];
    if (slope_of_[subcell.slot] < 0 || (!flat.empty() && flat[subcell.slot])) continue;
    const Vec3 offset = share * (subcell.centroid - bulk_centroid_[subcell.slot]);
    const Vec3* slope = &slopes[std::size_t(slope_of_[subcell.slot]) * width];
    for (int m = 0; m < width; ++m) value[m] += dot(slope[m], offset);
  }
  return fine;
}

std::vector<double> Remap::rises(const std::vector<Subcell>& subcells, const std::vector<double>& means,
                                 int width, Slope kind) const {
  const std::vector<Vec3> slopes =
      kind == Slope::mean ? slopes_.gradients(means, width) : slopes_.evaluate(means, width);
  std::vector<double> rise(subcells.size() * width, 0.0);
  for (std::size_t i = 0; i < subcells.size(); ++i) {
    const Subcell& subcell = subcells[i];
    if (slope_of_[subcell.slot] < 0) continue;
    const Vec3* slope = &slopes[std::size_t(slope_of_[subcell.slot]) * width];
    for (int m = 0; m < width; ++m)
      rise[i * width + m] = dot(slope[m], subcell.centroid - bulk_centroid_[subcell.slot]);
  }
  return rise;
}

std::vector<double> Remap::partial_sums(const std::vector<double>& fine, int width,
                                        const std::vector<double>& weight,
                                        const std::vector<Vec3>& gradient) const {
  std::vector<double> sums(bulk_volume_.size() * width, 0.0);
  for (const Subcell& subcell : subcells_) {
    const double amount = weight.empty() ? subcell.volume : subcell.volume * weight[subcell.fine];
    const double* value = &fine[std::size_t(subcell.fine) * width];
    double* sum = &sums[std::size_t(subcell.slot) * width];
    for (int m = 0; m < width; ++m) sum[m] += amount * value[m];
    if (gradient.empty()) continue;
    const Vec3* slope = &gradient[std::size_t(subcell.fine) * width];
    for (int m = 0; m < width; ++m) sum[m] += amount * dot(slope[m], subcell.offset);
  }
  return sums;
}

}  // namespace demvof
