// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/open_momentum.hpp"

#include "foam_side/kept_field.hpp"

namespace demvof {

namespace {

const char* const open_name = "openMomentum";

}  // namespace

const Foam::vectorField* find_open_momentum(const Flow& flow) {
  return find_kept(flow, open_name);
}

Foam::vectorField& open_momentum(Flow& flow) {
  return kept(flow, open_name, Foam::dimDensity * Foam::dimVelocity);
}

}  // namespace demvof
