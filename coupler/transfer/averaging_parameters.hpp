// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace demvof {

/// How particles are averaged onto the bulk grid (kernel_weights.hpp, diffusion.hpp, limit_solid.hpp).
enum class Kernel { centre, volume, linear, gaussian, diffusion };

struct AveragingParameters {
  Kernel kernel = Kernel::gaussian;
  double width = 0;      // standard deviation of the Gaussian, m; 0: half a bulk cell
  double bandwidth = 0;  // b of the diffusion kernel, m; 0: six of the largest particle diameters
  double maximum_solid_fraction =
      0.74;  // of a bulk cell; what is above moves to the neighbours and is counted
};

}  // namespace demvof
