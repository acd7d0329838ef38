// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/config/value_rule.hpp"

namespace demvof {

/// A map of the case file that holds keys.
struct Section {
  enum class Presence { required, defaulted, optional };

  std::string path;  // "coupling.averaging"
  std::string doc;   // one sentence
  Presence presence = Presence::defaulted;
  bool is_list = false;  // written [{drag: law}, pressure_gradient]: what a given list leaves out is off
  std::function<bool(const CaseParameters&)> present = [](const CaseParameters&) { return true; };
  std::function<void(CaseParameters&)> create = [](CaseParameters&) {};
};

/// One key of the case file; a section of the same path may be given in place of its value. Reading,
/// checking, JSON Schema, reference and resolved configuration all work from this description and nothing
/// else; the default is the one in parameters.hpp.
struct Key {
  std::string path;  // "coupling.window"
  ValueRule rule;
  std::string doc;  // one sentence
  std::function<Json(const CaseParameters&)> get;
  std::function<void(CaseParameters&, const Json&)> set;
  bool required = false;        // when its section is present
  bool changes_results = true;  // part of the configuration hash
};

/// In the order of the reference; a section comes before its keys and sub-sections.
const std::vector<Section>& case_sections();
const std::vector<Key>& case_keys();

const Section* find_section(const std::string& path);
const Key* find_key(const std::string& path);
/// "coupling.averaging" of "coupling.averaging.kernel", empty at the top.
std::string parent_of(const std::string& path);
/// "kernel" of "coupling.averaging.kernel".
std::string name_of_key(const std::string& path);

/// Parameters with every optional section present and all defaults.
CaseParameters default_parameters();

}  // namespace demvof
