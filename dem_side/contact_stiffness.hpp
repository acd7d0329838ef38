// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a contact resists sliding before friction gives way, as far as the script tells, per type of particle:
//
//   hooke/stiffness  k_t as given
//   hooke            k_t = k_n = 16/15 r*^1/2 E* (15 m* V^2/(16 r*^1/2 E*))^1/5          V:
//   characteristicVelocity hertz            k_t = 2 (1 - nu)/(2 - nu) k_n, k_n = (6 E*^2 r* F)^1/3 F: load on
//   the contact
//
// of two equal spheres: r* = r/2, m* = m/2, E* = Y/(2 (1 - nu^2)) (Johnson 1985; LIGGGHTS's manual, gran
// models). Where types differ the softest pair counts.

#include <optional>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace demvof {

/// N/m. load: N. E*: Pa. Hertz.
double hertz_tangential_stiffness(double effective_modulus, double poisson, double radius, double load);

class ContactStiffness {
 public:
  /// Of the properties that the script has now.
  explicit ContactStiffness(LAMMPS_NS::LAMMPS& liggghts);

  /// k_t, N/m, of a particle of a type (from 1); nothing where the script has no such property. radius: m;
  /// mass: kg; load: N.
  std::optional<double> tangential(int type, double radius, double mass, double load) const;

 private:
  struct Elastic {
    double effective_modulus, poisson;  // E*, Pa; nu, -
  };
  std::vector<double> springs_;      // k_t by type, N/m; empty: not given
  std::vector<Elastic> elastic_;     // by type; likewise
  double characteristic_speed_ = 0;  // m/s; 0: Hertz
};

}  // namespace demvof
