// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/value_rule.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "coupler/base/printable.hpp"
#include "coupler/config/nearest.hpp"

namespace demvof {
namespace {

using Form = ValueRule::Form;

std::string range_text(const ValueRule& rule) {
  const bool bounded_below = std::isfinite(rule.lowest), bounded_above = std::isfinite(rule.highest);
  if (bounded_below && bounded_above)
    return fmt::format(" {} {:.15g} {} {:.15g}", rule.lowest_excluded ? ">" : "from", rule.lowest,
                       rule.lowest_excluded ? "and <=" : "to", rule.highest);
  if (bounded_below) return fmt::format(" {} {:.15g}", rule.lowest_excluded ? ">" : ">=", rule.lowest);
  return "";
}

std::string noun(const ValueRule& rule, bool plural) {
  switch (rule.form) {
    case Form::text:
      return plural ? "texts" : "a text";
    case Form::number:
      return (plural ? "numbers" : "a number") + range_text(rule);
    case Form::integer:
      return (plural ? "whole numbers" : "a whole number") + range_text(rule);
    case Form::choice:
      return fmt::format("{} {}", plural ? "words from" : "one of", fmt::join(rule.choices, ", "));
    case Form::flag:
      return "true or false";
    case Form::table:
      return "a file";
  }
  return "";
}

/// The whole text as a number of type T, without locale, octal or unit surprises.
template <class T>
bool parse(const std::string& text, T& value) {
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool within(double value, const ValueRule& rule) {
  return value <= rule.highest && (rule.lowest_excluded ? value > rule.lowest : value >= rule.lowest);
}

std::string not_allowed(const YAML::Node& node, const ValueRule& rule) {
  return fmt::format("{} is not allowed; give {}", given_text(node), allowed_text(rule));
}

std::optional<std::string> read_number(const YAML::Node& node, const ValueRule& rule, Json& value) {
  std::string text = node.Scalar();
  const std::size_t point = text.find('.');
  if (point != std::string::npos && point + 1 < text.size() && std::isalpha(text[point + 1]))
    text.erase(point, 1);  // YAML's .nan, -.inf
  double number = 0;
  if (!parse(text, number)) return not_allowed(node, rule);
  if (!std::isfinite(number))
    return fmt::format("{} is not finite; give {}", node.Scalar(), allowed_text(rule));
  if (!within(number, rule)) return not_allowed(node, rule);
  value = number;
  return {};
}

std::optional<std::string> read_integer(const YAML::Node& node, const ValueRule& rule, Json& value) {
  long long number = 0;
  if (!parse(node.Scalar(), number) || !within(static_cast<double>(number), rule))
    return not_allowed(node, rule);
  value = number;
  return {};
}

std::optional<std::string> read_one(const YAML::Node& node, const ValueRule& rule, Json& value) {
  if (!node.IsScalar() || node.Scalar().empty()) return not_allowed(node, rule);
  const std::string& text = node.Scalar();
  // yaml-cpp tags quoted scalars "!": a quoted number is a text to every YAML reader.
  const bool quoted = node.Tag() == "!";
  switch (rule.form) {
    case Form::text:
    case Form::table:  // of a file
      value = text;
      return {};
    case Form::number:
      return quoted ? not_allowed(node, rule) : read_number(node, rule, value);
    case Form::integer:
      return quoted ? not_allowed(node, rule) : read_integer(node, rule, value);
    case Form::choice:
      if (std::find(rule.choices.begin(), rule.choices.end(), text) == rule.choices.end())
        return not_allowed(node, rule) + did_you_mean(text, rule.choices);
      value = text;
      return {};
    case Form::flag:
      if (text != "true" && text != "false") return not_allowed(node, rule);
      value = text == "true";
      return {};
  }
  return {};
}

}  // namespace

std::string allowed_text(const ValueRule& rule) {
  std::string text;
  if (rule.form == Form::table)
    text = fmt::format("a file, or a list of rows of {} numbers, the first of them increasing",
                       *rule.list_length);
  else if (!rule.list_length)
    text = noun(rule, false);
  else if (*rule.list_length == ValueRule::any_length)
    text = "a list of " + noun(rule, true);
  else
    text = fmt::format("a list of {} {}", *rule.list_length, noun(rule, true));
  return rule.unit.empty() || rule.unit == "-" ? text : fmt::format("{} ({})", text, rule.unit);
}

Json off_value(const ValueRule& rule) {
  if (rule.list_length) return Json(std::vector<double>(static_cast<std::size_t>(*rule.list_length), 0.0));
  if (rule.form == Form::flag) return false;
  if (rule.form == Form::choice) return "none";
  return 0.0;
}

std::optional<std::string> read_value(const YAML::Node& node, const ValueRule& rule, Json& value) {
  if (rule.form == Form::table)
    return node.IsScalar() ? read_one(node, rule, value) : read_table(node, rule, value);
  if (!rule.list_length) return read_one(node, rule, value);
  const auto length = static_cast<std::size_t>(*rule.list_length);
  if (!node.IsSequence() || (length != ValueRule::any_length && node.size() != length))
    return not_allowed(node, rule);
  value = Json::array();
  for (const YAML::Node& item : node) {
    Json one;
    if (auto mistake = read_one(item, rule, one)) return mistake;
    value.push_back(one);
  }
  return {};
}

std::string given_text(const YAML::Node& node) {
  if (node.IsNull() || !node.IsDefined()) return "nothing";
  constexpr std::size_t longest = 60;
  if (node.IsScalar() && node.Scalar().size() > longest) return cut(node.Scalar(), longest);
  YAML::Emitter out;
  if (node.IsScalar() && node.Tag() == "!") out << YAML::DoubleQuoted;
  out.SetMapFormat(YAML::Flow);
  out.SetSeqFormat(YAML::Flow);
  out << node;
  std::string text = out.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return cut(text, longest);
}

}  // namespace demvof
