// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/axis_kernel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace demvof {

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
      width_(averaging.width > 0 ? averaging.width / cells_.spacing() : 0.5) {
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
      half_width_ = 0;
      break;
  }
}

void AxisKernel::shares(double x, AxisShares& out) const {
  out.index.clear();
  out.share.clear();
  const double s = cells_.place(x);
  const int last = static_cast<int>(std::floor(s + half_width_));
  const bool hat = kernel_ == Kernel::linear || kernel_ == Kernel::diffusion;
  const int first = hat ? last - 1 : static_cast<int>(std::floor(s - half_width_));
  const bool folds = !cells_.inside(first) || !cells_.inside(last);
  const auto add = [&](int index, double share) {
    if (folds) {
      index = cells_.fold(index);
      const auto known = std::find(out.index.begin(), out.index.end(), index);
      if (known != out.index.end()) {
        out.share[known - out.index.begin()] += share;
        return;
      }
    }
    out.index.push_back(index);
    out.share.push_back(share);
  };

  switch (kernel_) {
    case Kernel::centre:
      add(first, 1.0);
      break;
    case Kernel::linear:
    case Kernel::diffusion: {
      const double upper_share = s + half_width_ - last;
      add(first, 1.0 - upper_share);
      add(last, upper_share);
      break;
    }
    case Kernel::gaussian: {
      const double scale = 1.0 / (std::sqrt(2.0) * width_);
      const double end = std::erf(gaussian_cut / std::sqrt(2.0));
      double below = -end;  // erf at the lower edge of the cell
      for (int index = first; index <= last; ++index) {
        const double above = index == last ? end : std::clamp(std::erf((index + 1 - s) * scale), -end, end);
        add(index, (above - below) / (2 * end));
        below = above;
      }
      break;
    }
    case Kernel::volume:
      assert(!"the volume kernel is no product of three");
      break;
  }
}

}  // namespace demvof
