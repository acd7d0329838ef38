// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/grid/bulk_grid.hpp"
#include "coupler/transfer/averaging_parameters.hpp"

namespace demvof {

/// Over which length a particle's own force is spread in the fluid velocity that it samples: standard
/// deviation s per axis, m, of the Gaussian that stands for all of it (closures/own_wake.hpp),
///
///   s^2 = 2 v + h^2/6
///
///   v      variance of the weights about their own mean, once for the deposit and once for sampling; mean
///   over
///          the particle's position in its cell (and over the axes)
///   h^2/6  the force spread evenly in a bulk cell, and the mean velocity of a bulk cell: h^2/12 each
class WakeWidth {
 public:
  WakeWidth(const BulkGrid& grid, const AveragingParameters& averaging);
  double operator()(double diameter) const;

 private:
  BulkGrid grid_;
  AveragingParameters averaging_;
};

}  // namespace demvof
