// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/mesh_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "coupler/transfer/tetrahedron.hpp"

namespace demvof {
namespace {

// A cell that reaches into a bulk cell by less than this fraction of its own extent does not reach it:
// the corners of nested meshes meet the grid's planes only to round-off.
constexpr double overlap_tolerance = 1e-9;
// A cell that fills its bounding box to this fraction is a box.
constexpr double box_tolerance = 1e-10;
constexpr double smallest_subcell = 1e-12;  // of the cell's volume

/// Bulk cells that a fine cell overlaps: indices first..last per axis. Periodic axes may run over the ends.
struct Range {
  std::array<int, 3> first, last;
  bool single() const { return first == last; }
  std::array<int, 3> size() const {
    return {last[0] - first[0] + 1, last[1] - first[1] + 1, last[2] - first[2] + 1};
  }
};

Range overlapped(const BulkGrid& grid, const Vec3& lower, const Vec3& upper) {
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = grid.spacing()[axis], margin = overlap_tolerance * (upper[axis] - lower[axis]);
    double first = std::floor((lower[axis] + margin - grid.lower()[axis]) / h);
    double last = std::floor((upper[axis] - margin - grid.lower()[axis]) / h);
    if (!grid.periodic()[axis]) {
      const double n = grid.cells()[axis];
      first = std::clamp(first, 0.0, n - 1);
      last = std::clamp(last, 0.0, n - 1);
    }
    range.first[axis] = static_cast<int>(first);
    range.last[axis] = static_cast<int>(std::max(first, last));
  }
  return range;
}

/// What a cell has in each bulk cell of its range.
struct Parts {
  Range range;
  std::array<int, 3> size;
  std::vector<double> volume;
  std::vector<Vec3> moment;  // volume * centroid

  void reset(const Range& r) {
    range = r;
    size = r.size();
    const std::size_t count = std::size_t(size[0]) * size[1] * size[2];
    volume.assign(count, 0.0);
    moment.assign(count, Vec3{});
  }
  std::size_t place(const std::array<int, 3>& ijk) const {
    return (ijk[0] - range.first[0]) +
           std::size_t(size[0]) *
               ((ijk[1] - range.first[1]) + std::size_t(size[1]) * (ijk[2] - range.first[2]));
  }
};

/// Walks through the bulk cells of a range.
template <class Visit>
void for_each_cell(const Range& range, Visit visit) {
  for (int k = range.first[2]; k <= range.last[2]; ++k)
    for (int j = range.first[1]; j <= range.last[1]; ++j)
      for (int i = range.first[0]; i <= range.last[0]; ++i) visit(std::array<int, 3>{i, j, k});
}

void cut_box(const BulkGrid& grid, const Vec3& lower, const Vec3& upper, Parts& parts) {
  for_each_cell(parts.range, [&](const std::array<int, 3>& ijk) {
    Vec3 size, centre;
    for (int axis = 0; axis < 3; ++axis) {
      const double plane = grid.cell_lower(ijk)[axis];
      const double low = ijk[axis] == parts.range.first[axis] ? lower[axis] : plane;
      const double high = ijk[axis] == parts.range.last[axis] ? upper[axis] : plane + grid.spacing()[axis];
      size[axis] = high - low;
      centre[axis] = 0.5 * (low + high);
    }
    const double volume = size.x * size.y * size.z;
    parts.volume[parts.place(ijk)] = volume;
    parts.moment[parts.place(ijk)] = volume * centre;
  });
}

/// Slices a tetrahedron into slabs along one axis after the other, and adds what is in each bulk cell.
void slice(const BulkGrid& grid, const Tetrahedron& whole, double sign, int axis, std::array<int, 3> ijk,
           Parts& parts) {
  if (axis == 3) {
    const double volume = sign * std::abs(signed_volume(whole));
    parts.volume[parts.place(ijk)] += volume;
    parts.moment[parts.place(ijk)] += volume * centroid(whole);
    return;
  }
  double low = whole.corner[0][axis], high = low;
  for (const Vec3& corner : whole.corner) {
    low = std::min(low, corner[axis]);
    high = std::max(high, corner[axis]);
  }
  // ijk[axis] comes in as the first slab that can hold anything.
  const auto upper_plane = [&] { return grid.cell_lower(ijk)[axis] + grid.spacing()[axis]; };
  while (ijk[axis] < parts.range.last[axis] && low >= upper_plane()) ++ijk[axis];
  const double plane = upper_plane();
  if (ijk[axis] == parts.range.last[axis] || high <= plane) {
    slice(grid, whole, sign, axis + 1, ijk, parts);
    return;
  }
  TetrahedronPart below, above;
  split(whole, axis, plane, below, above);
  for (int i = 0; i < below.count; ++i) slice(grid, below.part[i], sign, axis + 1, ijk, parts);
  ++ijk[axis];
  for (int i = 0; i < above.count; ++i) slice(grid, above.part[i], sign, axis, ijk, parts);
}

void cut_polyhedron(const BulkGrid& grid, const Polyhedron& cell, const Vec3& centre, Parts& parts) {
  for (const std::vector<Vec3>& face : cell.faces) {
    Vec3 middle;
    for (const Vec3& corner : face) middle += corner;
    middle *= 1.0 / face.size();
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Tetrahedron t{{centre, middle, face[i], face[(i + 1) % face.size()]}};
      // Seen from the centre of a cell that is not convex, a tetrahedron can be inside out: it then counts
      // as negative, and the sum is still right.
      slice(grid, t, signed_volume(t) < 0 ? -1.0 : 1.0, 0, parts.range.first, parts);
    }
  }
}

class Cutter {
 public:
  Cutter(const BulkGrid& grid, CutMesh& cut) : grid_(grid), cut_(cut) {}

  /// ijk may run over the ends of a periodic axis.
  void add(int fine, std::array<int, 3> ijk, double volume, Vec3 centroid, const Vec3& offset = {}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (grid_.periodic()[axis]) {
        const int n = grid_.cells()[axis], wrapped = (ijk[axis] % n + n) % n;
        centroid[axis] += (wrapped - ijk[axis]) * grid_.spacing()[axis];
        ijk[axis] = wrapped;
      }
      const double low = grid_.lower()[axis] + ijk[axis] * grid_.spacing()[axis];
      centroid[axis] = std::clamp(centroid[axis], low, low + grid_.spacing()[axis]);
    }
    cut_.subcells.push_back({fine, -1, volume, centroid, offset});
    cut_.bulk.push_back(grid_.id(ijk));
  }

  void add_parts(int fine, double volume, const Parts& parts) {
    double sum = 0;
    Vec3 moment;
    for (std::size_t place = 0; place < parts.volume.size(); ++place) {
      if (!(parts.volume[place] > smallest_subcell * volume)) continue;
      sum += parts.volume[place];
      moment += parts.moment[place];
    }
    const Vec3 middle = moment / sum;
    for_each_cell(parts.range, [&](const std::array<int, 3>& ijk) {
      const double part = parts.volume[parts.place(ijk)];
      if (!(part > smallest_subcell * volume)) return;
      const Vec3 centroid = parts.moment[parts.place(ijk)] / part;
      add(fine, ijk, part * (volume / sum), centroid, centroid - middle);
    });
  }

 private:
  const BulkGrid& grid_;
  CutMesh& cut_;
};

bool is_box(double volume, const Vec3& extent) {
  const double box = extent.x * extent.y * extent.z;
  return std::abs(volume - box) <= box_tolerance * box;
}

}  // namespace

CutMesh cut_mesh(const BulkGrid& grid, const FineMesh& mesh, Mapping mapping) {
  CutMesh cut;
  cut.subcells.reserve(mesh.volume.size());
  cut.bulk.reserve(mesh.volume.size());
  Cutter cutter(grid, cut);
  Parts parts;
  for (std::size_t fine = 0; fine < mesh.volume.size(); ++fine) {
    const int cell = static_cast<int>(fine);
    const double volume = mesh.volume[fine];
    const Vec3 &centre = mesh.centre[fine], &lower = mesh.lower[fine], &upper = mesh.upper[fine];
    const Range range =
        mapping == Mapping::nearest ? overlapped(grid, centre, centre) : overlapped(grid, lower, upper);
    if (range.single()) {
      cutter.add(cell, range.first, volume, centre);
      continue;
    }
    parts.reset(range);
    if (is_box(volume, upper - lower))
      cut_box(grid, lower, upper, parts);
    else
      cut_polyhedron(grid, mesh.shape(cell), centre, parts);
    cutter.add_parts(cell, volume, parts);
  }
  return cut;
}

}  // namespace demvof
