// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "foam_side/bulk_cut.hpp"
#include "foam_side/flow.hpp"

namespace demvof {

/// The fluid at one point: a sum over the fine cells that hold it, several when it lies between cells.
struct FluidSample {
  Vec3 velocity, pressure_gradient;   // m/s, Pa/m
  double density = 0, viscosity = 0;  // kg/m3, Pa s
  double cells = 0;
};

/// Takes the fluid at the centres of the bulk cells (of their fluid domain where the mesh does not fill
/// them), as the mapping says:
///
///   inverse_distance  sum q_f / |x - X_f| / sum 1 / |x - X_f| over the fine cell of x and its face
///   neighbours cell_point        OpenFOAM's interpolation cellPoint cell_point_face   OpenFOAM's
///   interpolation cellPointFace
///
/// To be built anew when the mesh changes. Calls are collective over the fluid side.
class FluidSampler {
 public:
  FluidSampler(const Foam::fvMesh& mesh, const BulkCut& cut);

  /// This rank's sums, one row per touched bulk cell. gradient, viscosity: one value per fine cell.
  std::vector<FluidSample> sample(const Flow& flow, const Foam::vectorField& gradient,
                                  const scalarField& viscosity) const;

 private:
  struct Hit {
    int slot, fine;
    vector point;
  };
  Mapping mapping_;
  std::size_t slots_;
  std::vector<Hit> hits_;
};

}  // namespace demvof
