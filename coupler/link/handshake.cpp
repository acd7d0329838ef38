// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/handshake.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "coupler/base/errors.hpp"
#include "coupler/link/link.hpp"

namespace demvof {
namespace {

/// OpenFOAM traps floating-point exceptions; a number of the partner that overflows is no reason to die.
class NoTraps {
 public:
  NoTraps() { std::feholdexcept(&before_); }
  ~NoTraps() { std::fesetenv(&before_); }
  NoTraps(const NoTraps&) = delete;
  NoTraps& operator=(const NoTraps&) = delete;

 private:
  std::fenv_t before_ = {};
};

// Numbers separated by blanks, or nothing when it is any other text.
std::optional<std::vector<double>> numbers(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> result;
  std::string entry;
  while (stream >> entry) {
    char* end = nullptr;
    result.push_back(std::strtod(entry.c_str(), &end));
    if (*end != '\0') return std::nullopt;
  }
  return result;
}

bool agree(double a, double b, double tolerance) {
  const double magnitude = std::max(std::abs(a), std::abs(b));
  const double difference = std::abs(a - b);
  if (!std::isfinite(difference)) return false;
  return magnitude < 1e-300 ? difference <= tolerance : difference <= tolerance * magnitude;
}

bool agree(const HandshakeItem& a, const HandshakeItem& b) {
  const double tolerance = std::max(a.tolerance, b.tolerance);
  if (tolerance < 0) return a.value == b.value;  // text may look like a number: a hash 5e1234... overflows
  const NoTraps here;
  const auto x = numbers(a.value), y = numbers(b.value);
  if (!x || !y) return a.value == b.value;
  return x->size() == y->size() && std::equal(x->begin(), x->end(), y->begin(),
                                              [&](double p, double q) { return agree(p, q, tolerance); });
}

}  // namespace

std::vector<std::string> disagreements(const std::vector<HandshakeItem>& fluid,
                                       const std::vector<HandshakeItem>& particles) {
  std::vector<std::string> lines;
  for (const HandshakeItem& item : fluid)
    for (const HandshakeItem& other : particles)
      if (item.key == other.key && !agree(item, other))
        lines.push_back(
            fmt::format("{}: foam_side has '{}', dem_side has '{}'", item.key, item.value, other.value));
  return lines;
}

std::string to_text(const Handshake& handshake) {
  nlohmann::json json{{"items", nlohmann::json::array()}, {"facts", handshake.facts}};
  for (const HandshakeItem& item : handshake.items)
    json["items"].push_back({item.key, item.value, item.tolerance});
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Handshake read_handshake(const std::string& text) {
  const NoTraps here;
  try {
    const auto json = nlohmann::json::parse(text);
    Handshake said;
    for (const auto& item : json.at("items")) said.items.push_back({item.at(0), item.at(1), item.at(2)});
    said.facts = json.at("facts");
    return said;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format(
        "what the partner said at the start is no handshake: is it of another version? ({})", error.what()));
  }
}

std::string Link::handshake(const std::vector<HandshakeItem>& items, const std::string& facts) {
  std::vector<HandshakeItem> mine = items;
  mine.push_back({"number of bulk cells", std::to_string(mine_.cell_count())});
  const Handshake said = read_handshake(swap_text(to_text({mine, facts})));
  const std::vector<HandshakeItem>& theirs = said.items;

  const bool fluid = world_.side() == Side::fluid;
  const auto differences = from_rank_0(fmt::format(
      "{}", fmt::join(fluid ? disagreements(mine, theirs) : disagreements(theirs, mine), "\n  ")));
  if (!differences.empty()) {
    meet_before_the_end();
    throw InputError(
        fmt::format("foam_side and dem_side do not agree:\n  {}\n"
                    "What to do: give both programs the same case file, and make the OpenFOAM case and the "
                    "LIGGGHTS script fit it.",
                    differences));
  }
  return said.facts;
}

}  // namespace demvof
