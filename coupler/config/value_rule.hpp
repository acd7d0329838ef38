// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace demvof {

using Json = nlohmann::ordered_json;

/// What a key's value may be: one value or a list of values of one form, within limits, or a table.
struct ValueRule {
  enum class Form { text, number, integer, choice, flag, table };
  static constexpr int any_length = 0;

  Form form = Form::text;
  std::optional<int>
      list_length;  // absent: one value, not a list; any_length, or exactly so many; of a table: columns
  std::string unit = {};  // SI unit, "-" for a pure number, empty for what has none
  double lowest = -std::numeric_limits<double>::infinity();
  bool lowest_excluded = false;
  double highest = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};
};

/// "a number > 0 (s)", "3 whole numbers from 1 to 1000000", "one of centre, linear, gaussian".
std::string allowed_text(const ValueRule& rule);

/// What a key of a list section (forces) has when the list does not name it.
Json off_value(const ValueRule& rule);

/// Reads a YAML node by the rule into value; returns what is wrong with it, or nothing.
std::optional<std::string> read_value(const YAML::Node& node, const ValueRule& rule, Json& value);

/// The rows of a table, given as they are, or in a file: a row in each line, numbers between blanks or
/// commas, # begins a comment. As read_value.
std::optional<std::string> read_table(const YAML::Node& node, const ValueRule& rule, Json& value);
std::optional<std::string> read_table(const std::filesystem::path& file, const ValueRule& rule, Json& value);

/// The node as one line, as a user would type it; long values are cut.
std::string given_text(const YAML::Node& node);

}  // namespace demvof
