// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/wake_width.hpp"

#include <cmath>

#include "coupler/transfer/axis_kernel.hpp"

namespace demvof {
namespace {

/// Of a particle's weights along an axis with cells of width h, m2.
double weight_variance(const AveragingParameters& averaging, double h, double diameter) {
  switch (averaging.kernel) {
    case Kernel::centre:
      return 0;
    case Kernel::volume:  // mean of w (1 - w) h^2 over the way through a face; many cells: that of a ball
      return diameter < h ? 9. / 70 * diameter * h : diameter * diameter / 20 + h * h / 12;
    case Kernel::linear:
      return h * h / 6;
    case Kernel::gaussian: {
      const double width = averaging.width > 0 ? averaging.width : 0.5 * h;
      constexpr double cut = 1 - 0.026663;  // second moment of the Gaussian cut at gaussian_cut
      static_assert(gaussian_cut == 3.0);
      return cut * width * width + h * h / 12;
    }
    case Kernel::diffusion:
      return averaging.bandwidth * averaging.bandwidth / 2 + h * h / 6;
  }
  return 0;
}

}  // namespace

WakeWidth::WakeWidth(const BulkGrid& grid, const AveragingParameters& averaging)
    : grid_(grid), averaging_(averaging) {}

double WakeWidth::operator()(double diameter) const {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = grid_.spacing()[axis];
    sum += 2 * weight_variance(averaging_, h, diameter) + h * h / 6;
  }
  return std::sqrt(sum / 3);
}

}  // namespace demvof
