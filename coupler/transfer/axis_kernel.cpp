// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/axis_kernel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace demvof {
namespace {

/// erf(z), |z| <= gaussian_cut / sqrt 2, to a unit in the last place of 1: z times the Chebyshev polynomial
/// of erf(z)/z in z^2, by powers of u = z^2/2.25 - 1; even and odd ones by themselves. No call, so that
/// several go at the same time.
inline double erf_within_cut(double z) {
  static_assert(gaussian_cut == 3.0);
  constexpr double even[] = {0.6440700976502072,     0.13002914047167516,   0.022688198513323637,
                             0.0023133106108676987,  0.0001481200687475723, 6.423722837030391e-06,
                             2.0010239904716265e-07, 4.682162711921724e-09, 8.502047405225345e-11,
                             1.3143131857499143e-12};
  constexpr double odd[] = {-0.2625699042132889,     -0.05818390129351065,   -0.007719156858667304,
                            -0.0006172438320103695,  -3.225467011560341e-05, -1.1780098292107017e-06,
                            -3.1648345877795616e-08, -6.505140409967838e-10, -1.0529479792910429e-11,
                            -1.4636124067075394e-13};
  const double u = z * z * (1 / 2.25) - 1, square = u * u;
  double evens = even[9], odds = odd[9];
#pragma GCC unroll 9
  for (int k = 8; k >= 0; --k) {
    evens = evens * square + even[k];
    odds = odds * square + odd[k];
  }
  return z * (evens + u * odds);
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

AxisKernel::AxisKernel(const BulkGrid& grid, const AveragingParameters& averaging, int axis)
    : cells_(grid, axis),
      kernel_(averaging.kernel),
      width_(averaging.width > 0 ? averaging.width / cells_.spacing() : 0.5),
      scale_(1.0 / (std::sqrt(2.0) * width_)) {
  switch (kernel_) {
    case Kernel::gaussian:
      half_width_ = gaussian_cut * width_;
      break;
    case Kernel::linear:
    case Kernel::diffusion:
      half_width_ = 0.5;
      break;
    case Kernel::centre:
    case Kernel::volume:  // sphere_cells.hpp
      break;
  }
  // One more than it should be: where a cell begins is known to round-off only.
  most_cells_ = static_cast<int>(std::floor(2 * half_width_)) + 3;
}

CellSpan AxisKernel::shares(double x, double* share) const {
  const double s = cells_.place(x);
  const int last = static_cast<int>(std::floor(s + half_width_));
  const bool hat = kernel_ == Kernel::linear || kernel_ == Kernel::diffusion;
  const int first = hat ? last - 1 : static_cast<int>(std::floor(s - half_width_));
  const int count = last - first + 1;
  switch (kernel_) {
    case Kernel::centre:
      share[0] = 1;
      break;
    case Kernel::linear:
    case Kernel::diffusion: {
      const double upper_share = s + half_width_ - last;
      share[0] = 1.0 - upper_share;
      share[1] = upper_share;
      break;
    }
    case Kernel::gaussian: {
      constexpr double cut = gaussian_cut / 1.4142135623730951;
      const double end = erf_within_cut(cut), half = 0.5 / end;
      for (int i = 0; i + 1 < count; ++i)  // up to the upper face of each cell
        share[i] = erf_within_cut(std::clamp((first + i + 1 - s) * scale_, -cut, cut));
      double below = -end;
      for (int i = 0; i < count; ++i) {
        const double above = i + 1 < count ? std::clamp(share[i], below, end) : end;
        share[i] = (above - below) * half;
        below = above;
      }
      break;
    }
    case Kernel::volume:
      assert(!"the volume kernel is no product of three");
      break;
  }
  if (cells_.inside(first) && cells_.inside(last)) return {first, count};
  const CellSpan span = cells_.fold(first, last);
  const std::vector<double> unfolded(share, share + count);
  std::fill_n(share, span.count, 0.0);
  for (int i = 0; i < count; ++i) share[cells_.place_in(span, first + i)] += unfolded[i];
  return span;
}

}  // namespace demvof
