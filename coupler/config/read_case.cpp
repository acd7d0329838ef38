// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/read_case.hpp"

#include "coupler/config/case_checks.hpp"
#include "coupler/config/given_values.hpp"
#include "coupler/config/keys.hpp"

namespace demvof {
namespace {

/// The parameters from what is given, key by key; adds what is wrong or missing to the mistakes.
CaseParameters fill(const std::string& file, const GivenValues& given, Mistakes& mistakes) {
  CaseParameters parameters;
  parameters.file = file;
  for (const Section& section : case_sections()) {
    if (given.section_given(section.path)) section.create(parameters);
    if (section.presence == Section::Presence::required && !given.sources().count(section.path))
      mistakes.push_back(Mistake{Source{file, 0}, section.path, "missing; " + section.doc});
  }
  for (const Key& key : case_keys()) {
    const auto item = given.values().find(key.path);
    const std::string section = parent_of(key.path);
    if (item != given.values().end()) {
      Json value;
      auto mistake = read_value(item->second, key.rule, value);
      if (!mistake && key.rule.form == ValueRule::Form::table && value.is_string())
        mistake = read_table(beside_case_file(parameters, value), key.rule, value);
      if (mistake)
        mistakes.push_back(Mistake{given.sources().at(key.path), key.path, *mistake});
      else
        key.set(parameters, value);
    } else if (key.required && given.section_given(section) && !given.section_given(key.path)) {
      mistakes.push_back(
          Mistake{given.sources().at(section), key.path, "missing; give " + allowed_text(key.rule)});
    }
  }
  return parameters;
}

}  // namespace

CaseParameters read_case(const std::string& file, const std::vector<std::string>& overrides) {
  GivenValues given(file);
  for (const std::string& assignment : overrides) given.override_with(assignment);
  Mistakes mistakes = given.mistakes();
  CaseParameters parameters = fill(file, given, mistakes);
  check_case(parameters, given.sources(), mistakes);
  if (!mistakes.empty()) throw InputError(report(mistakes));
  if (parameters.scene.particles == Switch::off) parameters.particles.reset();
  return parameters;
}

std::filesystem::path beside_case_file(const CaseParameters& parameters, const std::string& path) {
  return std::filesystem::path(parameters.file).parent_path() / path;
}

}  // namespace demvof
