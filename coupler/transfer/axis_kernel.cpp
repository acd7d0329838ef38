// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/axis_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace demvof {

AxisKernel::AxisKernel(const BulkGrid& grid, const AveragingParameters& averaging, int axis)
    : kernel_(averaging.kernel),
      lower_(grid.lower()[axis]),
      spacing_(grid.spacing()[axis]),
      cells_(grid.cells()[axis]),
      periodic_(grid.periodic()[axis]),
      width_(averaging.width > 0 ? averaging.width / spacing_ : 0.5) {
  reach_ = kernel_ == Kernel::gaussian ? gaussian_cut * width_ : kernel_ == Kernel::linear ? 0.5 : 0.0;
}

double AxisKernel::cells_from_lower(double x) const {
  double s = (x - lower_) / spacing_;
  if (periodic_) s -= cells_ * std::floor(s / cells_);
  return s > 0 ? std::min<double>(s, cells_) : 0.0;  // in this order not-a-number is on the wall, too
}

int AxisKernel::fold(int index) const {
  const int period = periodic_ ? cells_ : 2 * cells_;
  const int m = (index % period + period) % period;
  return m < cells_ ? m : period - 1 - m;
}

void AxisKernel::reach(double x_min, double x_max, int& first, int& last) const {
  const bool inside = x_min >= lower_ && x_max < lower_ + cells_ * spacing_;
  const double low = cells_from_lower(x_min) - reach_, high = cells_from_lower(x_max) + reach_;
  const bool wraps = periodic_ && !(inside && low >= 0 && high < cells_);
  // One cell more on either side: where a mirrored share ends is known to round-off only.
  first = wraps ? 0 : static_cast<int>(std::max(low - 1, 0.0));
  last = wraps ? cells_ - 1 : static_cast<int>(std::min<double>(high + 1, cells_ - 1));
}

void AxisKernel::shares(double x, AxisShares& out) const {
  out.index.clear();
  out.share.clear();
  const double s = cells_from_lower(x);
  const int last = static_cast<int>(std::floor(s + reach_));
  const int first = kernel_ == Kernel::linear ? last - 1 : static_cast<int>(std::floor(s - reach_));
  const bool folds = first < 0 || last >= cells_;
  const auto add = [&](int index, double share) {
    if (folds) {
      index = fold(index);
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
    case Kernel::linear: {
      const double upper_share = s + reach_ - last;
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
  }
}

}  // namespace demvof
