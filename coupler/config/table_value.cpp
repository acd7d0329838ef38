// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "coupler/config/value_rule.hpp"

namespace demvof {
namespace {

/// A row of the table in the making, from its numbers. where: how to name it.
std::optional<std::string> add_row(const std::vector<YAML::Node>& numbers, const std::string& where,
                                   const ValueRule& rule, Json& table) {
  const auto columns = static_cast<std::size_t>(*rule.list_length);
  if (numbers.size() != columns)
    return fmt::format("{} has {} numbers in place of {}; give {}", where, numbers.size(), columns,
                       allowed_text(rule));
  ValueRule number;
  number.form = ValueRule::Form::number;
  number.lowest = rule.lowest;
  number.highest = rule.highest;
  Json row = Json::array();
  for (const YAML::Node& given : numbers) {
    Json value;
    if (const auto mistake = read_value(given, number, value)) return fmt::format("{}: {}", where, *mistake);
    row.push_back(value);
  }
  if (!table.empty() && !(table.back()[0] < row[0]))
    return fmt::format("{}: the first number, {}, is not above that of the row before, {}", where,
                       row[0].get<double>(), table.back()[0].get<double>());
  table.push_back(row);
  return {};
}

}  // namespace

std::optional<std::string> read_table(const YAML::Node& node, const ValueRule& rule, Json& value) {
  if (!node.IsSequence() || node.size() == 0)
    return fmt::format("{} is not allowed; give {}", given_text(node), allowed_text(rule));
  value = Json::array();
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string where = fmt::format("row {}, {}", i + 1, given_text(node[i]));
    const std::vector<YAML::Node> numbers = node[i].IsSequence()
                                                ? std::vector<YAML::Node>(node[i].begin(), node[i].end())
                                                : std::vector<YAML::Node>();
    if (auto mistake = add_row(numbers, where, rule, value)) return mistake;
  }
  return {};
}

std::optional<std::string> read_table(const std::filesystem::path& file, const ValueRule& rule, Json& value) {
  std::error_code none;  // a name may be too long for the system to ask
  std::ifstream stream(file);
  if (!std::filesystem::is_regular_file(file, none) || !stream)
    return fmt::format("there is no file {} to be read", file.string());
  value = Json::array();
  std::string line;
  for (int n = 1; std::getline(stream, line); ++n) {
    line.erase(std::min(line.find('#'), line.size()));
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == '\t' || c == '\r'; }, ' ');
    std::vector<YAML::Node> numbers;
    std::istringstream words(line);
    for (std::string word; words >> word;) numbers.emplace_back(word);
    if (numbers.empty()) continue;
    if (auto mistake = add_row(numbers, fmt::format("{}:{}", file.string(), n), rule, value)) return mistake;
  }
  if (value.empty()) return fmt::format("{} has no row of numbers", file.string());
  return {};
}

}  // namespace demvof
