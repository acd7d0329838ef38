// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/contact_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "dem_side/script_property.hpp"

namespace demvof {

double hertz_tangential_stiffness(double effective_modulus, double poisson, double radius, double load) {
  const double normal = std::cbrt(6 * effective_modulus * effective_modulus * radius / 2 * load);
  return 2 * (1 - poisson) / (2 - poisson) * normal;
}

ContactStiffness::ContactStiffness(LAMMPS_NS::LAMMPS& liggghts) {
  const int types = liggghts.atom->ntypes;
  auto* given = script_property(liggghts, "kt", "peratomtypepair", types, types);
  auto* modulus = script_property(liggghts, "youngsModulus", "peratomtype", types, 0);
  auto* poisson = script_property(liggghts, "poissonsRatio", "peratomtype", types, 0);
  auto* speed = script_property(liggghts, "characteristicVelocity", "scalar", 0, 0);
  for (int type = 0; given && type < types; ++type) {
    springs_.push_back(given->compute_array(type, 0));
    for (int other = 1; other < types; ++other)
      springs_.back() = std::min(springs_.back(), given->compute_array(type, other));
  }
  for (int type = 0; modulus && poisson && type < types; ++type) {
    const double nu = poisson->compute_vector(type);
    elastic_.push_back({modulus->compute_vector(type) / (2 * (1 - nu * nu)), nu});
  }
  if (speed) characteristic_speed_ = speed->compute_scalar();
}

std::optional<double> ContactStiffness::tangential(int type, double radius, double mass, double load) const {
  if (!springs_.empty()) return springs_[type - 1];
  if (elastic_.empty()) return std::nullopt;
  const auto [modulus, poisson] = elastic_[type - 1];
  if (characteristic_speed_ == 0) return hertz_tangential_stiffness(modulus, poisson, radius, load);
  const double sphere = 16. / 15 * std::sqrt(radius / 2) * modulus;  // N/m^3/2
  return sphere * std::pow(mass / 2 * characteristic_speed_ * characteristic_speed_ / sphere, 0.2);
}

}  // namespace demvof
