// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/tetrahedron.hpp"

namespace demvof {
namespace {

Vec3 cut_edge(const Vec3& a, const Vec3& b, int axis, double plane) {
  Vec3 point = a + (b - a) * ((plane - a[axis]) / (b[axis] - a[axis]));
  point[axis] = plane;
  return point;
}

/// A prism between the triangles a and b, with edges from a[i] to b[i]; a side may have shrunk to an edge.
void add_prism(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, TetrahedronPart& part) {
  part.add(a[0], a[1], a[2], b[0]);
  part.add(a[1], a[2], b[0], b[1]);
  part.add(a[2], b[0], b[1], b[2]);
}

/// One corner (the tip) on one side, three (the base) on the other.
void split_tip(const Vec3& tip, const std::array<Vec3, 3>& base, int axis, double plane,
               TetrahedronPart& tip_side, TetrahedronPart& base_side) {
  std::array<Vec3, 3> cut;
  for (int i = 0; i < 3; ++i) cut[i] = cut_edge(tip, base[i], axis, plane);
  tip_side.add(tip, cut[0], cut[1], cut[2]);
  add_prism(cut, base, base_side);
}

}  // namespace

void split(const Tetrahedron& whole, int axis, double plane, TetrahedronPart& below, TetrahedronPart& above) {
  below.count = above.count = 0;
  std::array<Vec3, 4> low, high;
  int lows = 0, highs = 0;
  for (const Vec3& corner : whole.corner)
    if (corner[axis] < plane)
      low[lows++] = corner;
    else
      high[highs++] = corner;

  switch (lows) {
    case 0:
      above.part[above.count++] = whole;
      break;
    case 1:
      split_tip(low[0], {high[0], high[1], high[2]}, axis, plane, below, above);
      break;
    case 2: {
      const Vec3 cut00 = cut_edge(low[0], high[0], axis, plane),
                 cut01 = cut_edge(low[0], high[1], axis, plane);
      const Vec3 cut10 = cut_edge(low[1], high[0], axis, plane),
                 cut11 = cut_edge(low[1], high[1], axis, plane);
      add_prism({low[0], cut00, cut01}, {low[1], cut10, cut11}, below);
      add_prism({high[0], cut00, cut10}, {high[1], cut01, cut11}, above);
      break;
    }
    case 3:
      split_tip(high[0], {low[0], low[1], low[2]}, axis, plane, above, below);
      break;
    default:
      below.part[below.count++] = whole;
  }
}

}  // namespace demvof
