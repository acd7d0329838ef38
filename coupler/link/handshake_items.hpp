// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/base/checksum.hpp"
#include "coupler/base/vec3.hpp"
#include "coupler/exchange/gravity_table.hpp"
#include "coupler/link/link.hpp"

namespace demvof {

/// A few words that tell one table from another.
inline std::string in_short(const GravityTable& table) {
  std::string all;
  for (const auto& [t, g] : table.rows) all += fmt::format("{} {} {} {}\n", t, g.x, g.y, g.z);
  return fmt::format("{}, {}", table.rows.size(), Checksum().add(all).text());
}

/// What both programs of a pair state before a run, and must agree on. The configuration hash stands
/// for the whole case file (window, bulk grid, exchange ...); gravity is the one fact that each
/// solver's own input states once more. out: the folder of the run, empty: not told; state: the checksum of
/// the state from which it is continued, or "no". table: of gravity, which each side may have read from a
/// file.
inline std::vector<HandshakeItem> handshake_items(const std::string& version,
                                                  const std::string& configuration_hash, const Vec3& gravity,
                                                  const std::filesystem::path& out = {},
                                                  const std::string& state = "no",
                                                  const std::optional<GravityTable>& table = {}) {
  constexpr double typed_twice = 1e-6;  // relative; numbers that a user wrote in two files
  std::vector<HandshakeItem> items = {
      {"version", version},
      {"configuration hash (case file and --set options)", configuration_hash},
      {"gravity, m/s2 (constant/g, fix gravity)", fmt::format("{} {} {}", gravity.x, gravity.y, gravity.z),
       typed_twice},
      {"gravity.table (rows, checksum)", table ? in_short(*table) : "none"},
      {"--continue (checksum of the state)", state}};
  if (!out.empty()) items.push_back({"--out", std::filesystem::weakly_canonical(out).string()});
  return items;
}

}  // namespace demvof
