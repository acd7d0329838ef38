// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "coupler/base/vec3.hpp"
#include "coupler/link/link.hpp"

namespace demvof {

/// What both programs of a pair state before a run, and must agree on. The configuration hash stands
/// for the whole case file (window, bulk grid, exchange ...); gravity is the one fact that each
/// solver's own input states once more.
inline std::vector<HandshakeItem> handshake_items(const std::string& version,
                                                  const std::string& configuration_hash,
                                                  const Vec3& gravity) {
  constexpr double typed_twice = 1e-6;  // relative; numbers that a user wrote in two files
  return {{"version", version},
          {"configuration hash (case file and --set options)", configuration_hash},
          {"gravity, m/s2 (constant/g, fix gravity)",
           fmt::format("{} {} {}", gravity.x, gravity.y, gravity.z), typed_twice}};
}

}  // namespace demvof
