// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/base/vec3.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

inline Vec3 to_vec3(const Foam::vector& v) {
  return {v.x(), v.y(), v.z()};
}
inline Foam::vector to_foam(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace demvof
