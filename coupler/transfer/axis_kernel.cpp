// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/axis_kernel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "coupler/base/four.hpp"

namespace demvof {
namespace {

/// erf(z), |z| <= gaussian_cut / sqrt 2, to a unit in the last place of 1: z times the Chebyshev polynomial
/// of erf(z)/z in z^2, by powers of u = z^2/2.25 - 1; even and odd ones by themselves. No call, so that
/// several go at the same time.
template <class Number>
[[gnu::always_inline]] inline void erf_within_cut(const Number& z, Number& erf) {
  static_assert(gaussian_cut == 3.0);
  constexpr double even[] = {0.6440700976502072,     0.13002914047167516,   0.022688198513323637,
                             0.0023133106108676987,  0.0001481200687475723, 6.423722837030391e-06,
                             2.0010239904716265e-07, 4.682162711921724e-09, 8.502047405225345e-11,
                             1.3143131857499143e-12};
  constexpr double odd[] = {-0.2625699042132889,     -0.05818390129351065,   -0.007719156858667304,
                            -0.0006172438320103695,  -3.225467011560341e-05, -1.1780098292107017e-06,
                            -3.1648345877795616e-08, -6.505140409967838e-10, -1.0529479792910429e-11,
                            -1.4636124067075394e-13};
  const Number u = z * z * (1 / 2.25) - 1, square = u * u;
  Number evens = even[9] + 0 * u, odds = odd[9] + 0 * u;
#pragma GCC unroll 9
  for (int k = 8; k >= 0; --k) {
    evens = evens * square + even[k];
    odds = odds * square + odd[k];
  }
  erf = z * (evens + u * odds);
}

/// Shares of a particle in cells first, first + 1, ... along three axes, which have counts of them; places
/// and counts in the first lanes. share: a row of all lanes for each cell.
[[gnu::always_inline]] inline void gaussian_shares(const double* place, const double* first,
                                                   const double* counts, const double* scales, int most,
                                                   double* share) {
  constexpr double cut = gaussian_cut / 1.4142135623730951;
  const Four zero{}, low = zero - cut, high = zero + cut;
  Four end;
  erf_within_cut(high, end);
  const Four half = 0.5 / end;
  Four s, begin, count, scale;
  load(s, place);
  load(begin, first);
  load(count, counts);
  load(scale, scales);
  Four below = -end;
  for (int a = 0; a < most; ++a) {
    Four above = end;
    if (a + 1 < most) {  // at the upper face of the cell
      Four z = (begin + (a + 1.0) - s) * scale;
      z = z < low ? low : z > high ? high : z;
      erf_within_cut(z, above);
      above = above < below ? below : above > end ? end : above;
      above = zero + (a + 1.0) < count ? above : end;
    }
    store(share + 4 * a, (above - below) * half);
    below = above;
  }
}
DEMVOF_WIDE void gaussian_shares_wide(const double* place, const double* first, const double* counts,
                                      const double* scales, int most, double* share) {
  gaussian_shares(place, first, counts, scales, most, share);
}

/// Of what is not far from 0.
int rounded_down(double x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero - (x < towards_zero);
}

}  // namespace

AxisCells::AxisCells(const BulkGrid& grid, int axis)
    : lower_(grid.lower()[axis]),
      spacing_(grid.spacing()[axis]),
      count_(grid.cells()[axis]),
      periodic_(grid.periodic()[axis]) {}

double AxisCells::place(double x) const {
  double s = (x - lower_) / spacing_;
  if (periodic_) s -= count_ * std::floor(s / count_);
  return s > 0 ? std::min<double>(s, count_) : 0.0;  // in this order not-a-number is on the wall, too
}

int AxisCells::fold(int index) const {
  const int period = periodic_ ? count_ : 2 * count_;
  const int m = (index % period + period) % period;
  return m < count_ ? m : period - 1 - m;
}

CellSpan AxisCells::fold(int first, int last) const {
  const int count = last - first + 1;
  if (inside(first) && inside(last)) return {first, count};
  if (periodic_) return count < count_ ? CellSpan{fold(first), count} : CellSpan{0, count_};
  int lowest = fold(first), highest = lowest;
  for (int index = first + 1; index <= last; ++index) {
    lowest = std::min(lowest, fold(index));
    highest = std::max(highest, fold(index));
  }
  return {lowest, highest - lowest + 1};
}

void AxisCells::reach(double x_min, double x_max, double half_width, int& first, int& last) const {
  const bool inside = x_min >= lower_ && x_max < lower_ + count_ * spacing_;
  const double low = place(x_min) - half_width, high = place(x_max) + half_width;
  const bool wraps = periodic_ && !(inside && low >= 0 && high < count_);
  // What is mirrored at a wall stays in between. One cell more on either side: where a mirrored share ends
  // is known to round-off only.
  first = wraps ? 0 : static_cast<int>(std::max(low - 1, 0.0));
  last = wraps ? count_ - 1 : static_cast<int>(std::min<double>(high + 1, count_ - 1));
}

AxisKernels::AxisKernels(const BulkGrid& grid, const AveragingParameters& averaging)
    : cells_{AxisCells(grid, 0), AxisCells(grid, 1), AxisCells(grid, 2)}, kernel_(averaging.kernel) {
  for (int axis = 0; axis < 3; ++axis) {
    const double width = averaging.width > 0 ? averaging.width / cells_[axis].spacing() : 0.5;
    scale_[axis] = 1.0 / (std::sqrt(2.0) * width);
    switch (kernel_) {
      case Kernel::gaussian:
        half_width_[axis] = gaussian_cut * width;
        break;
      case Kernel::linear:
      case Kernel::diffusion:
        half_width_[axis] = 0.5;
        break;
      case Kernel::centre:
      case Kernel::volume:  // sphere_cells.hpp
        break;
    }
    // One more than it should be: where a cell begins is known to round-off only.
    most_cells_ = std::max(most_cells_, static_cast<int>(std::floor(2 * half_width_[axis])) + 3);
  }
  unfolded_.resize(4 * static_cast<std::size_t>(most_cells_));
}

std::array<CellSpan, 3> AxisKernels::shares(const Vec3& position, double* share) {
  assert(kernel_ != Kernel::volume);  // which is no product of three
  const bool hat = kernel_ == Kernel::linear || kernel_ == Kernel::diffusion;
  double place[4] = {}, begin[4] = {}, counts[4] = {};
  std::array<CellSpan, 3> spans;
  int most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    place[axis] = cells_[axis].place(position[axis]);
    const int last = rounded_down(place[axis] + half_width_[axis]);
    const int first = hat ? last - 1 : rounded_down(place[axis] - half_width_[axis]);
    spans[axis] = {first, last - first + 1};
    begin[axis] = first;
    counts[axis] = spans[axis].count;
    most = std::max(most, spans[axis].count);
  }
  double* unfolded = unfolded_.data();
  if (kernel_ == Kernel::gaussian)
    (have_wide ? gaussian_shares_wide : gaussian_shares)(place, begin, counts, scale_.data(), most, unfolded);
  for (int axis = 0; axis < 3 && kernel_ != Kernel::gaussian; ++axis) {
    unfolded[axis] = 1;
    if (!hat) continue;
    const double upper_share = place[axis] + half_width_[axis] - (spans[axis].first + 1);
    unfolded[axis] = 1.0 - upper_share;
    unfolded[4 + axis] = upper_share;
  }
  for (int axis = 0; axis < 3; ++axis) {
    CellSpan& span = spans[axis];
    const AxisCells& cells = cells_[axis];
    const int first = span.first, count = span.count;
    if (cells.inside(first) && cells.inside(first + count - 1)) {
      for (int i = 0; i < count; ++i) share[i] = unfolded[4 * i + axis];
    } else {
      span = cells.fold(first, first + count - 1);
      std::fill_n(share, span.count, 0.0);
      for (int i = 0; i < count; ++i) share[cells.place_in(span, first + i)] += unfolded[4 * i + axis];
    }
    share += span.count;
  }
  return spans;
}

}  // namespace demvof
