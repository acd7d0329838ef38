// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/sharing_weights.hpp"

namespace demvof {

std::vector<double> sharing_weights(const Flow& flow, Sharing sharing) {
  std::vector<double> weight(static_cast<std::size_t>(flow.mesh.nCells()), 1.0);
  if (sharing == Sharing::mass)
    for (std::size_t cell = 0; cell < weight.size(); ++cell) {
      const label index = static_cast<label>(cell);
      weight[cell] = (flow.porosity ? flow.porosity->eps[index] : 1.0) * flow.rho[index];
    }
  return weight;
}

double sharing_weight(const Flow& flow, const SurfaceToBulk& surface, Sharing sharing, int k,
                      const Piece& piece, const std::vector<double>& weight) {
  const double volume = surface.share(k, piece) * piece.volume;
  if (sharing == Sharing::volume || !surface.is_cut(piece.slot)) return weight[piece.fine] * volume;
  return (flow.porosity ? flow.porosity->eps[piece.fine] : 1.0) * volume;
}

}  // namespace demvof
