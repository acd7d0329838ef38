// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/base/checksum.hpp"
#include "coupler/config/keys.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {
namespace {

/// The map that holds a section's keys, made on the way.
Json& place_of(Json& root, const std::string& section) {
  if (section.empty()) return root;
  const std::string parent = parent_of(section), name = name_of_key(section);
  Json& outside = place_of(root, parent);
  if (parent.empty() || !find_section(parent)->is_list) return outside[name];
  for (Json& entry : outside)
    if (entry.contains(name)) return entry[name];
  outside.push_back(Json::object());
  return outside.back()[name];
}

bool present(const CaseParameters& parameters, const std::string& section) {
  return section.empty() ||
         (find_section(section)->present(parameters) && present(parameters, parent_of(section)));
}

/// The case file's form of all present sections, with the keys that wanted() accepts.
template <class Wanted>
Json configuration(const CaseParameters& parameters, Wanted wanted) {
  Json root = Json::object();
  for (const Key& key : case_keys()) {
    const std::string section = parent_of(key.path), name = name_of_key(key.path);
    if (!present(parameters, section) || !wanted(key)) continue;
    if (find_section(key.path) && present(parameters, key.path)) continue;  // the map in place of the value
    Json& place = place_of(root, section);
    const Json value = key.get(parameters);
    if (!find_section(section)->is_list) {
      place[name] = value;
      continue;
    }
    if (place.is_null()) place = Json::array();
    if (value != off_value(key.rule)) place.push_back(value.is_boolean() ? Json(name) : Json{{name, value}});
  }
  return root;
}

}  // namespace

std::string resolved_configuration(const CaseParameters& parameters) {
  return configuration(parameters, [](const Key&) { return true; }).dump(2);
}

std::string configuration_hash(const CaseParameters& parameters) {
  const auto wanted = [](const Key& key) { return key.changes_results; };
  return Checksum().add(configuration(parameters, wanted).dump()).text();
}

}  // namespace demvof
