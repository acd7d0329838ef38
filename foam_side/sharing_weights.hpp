// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/exchange/exchange_parameters.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/surface_to_bulk.hpp"

namespace demvof {

/// Weight w of each fine cell, per volume, in the force that it takes from a bulk cell and in the velocity
/// that it tells (particles_to_fine.cpp, fluid_to_bulk.cpp): eps rho (every fine cell of a bulk cell gets the
/// same acceleration) or 1.
std::vector<double> sharing_weights(const Flow& flow, Sharing sharing);

/// Weight of a piece for fluid k, m3 or kg: w times the volume that counts as k. Where the surface cuts the
/// bulk cell every part of fluid k has the same density: there w is eps.
double sharing_weight(const Flow& flow, const SurfaceToBulk& surface, Sharing sharing, int k,
                      const Piece& piece, const std::vector<double>& weight);

}  // namespace demvof
