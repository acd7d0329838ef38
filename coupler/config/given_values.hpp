// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupler/config/case_checks.hpp"

namespace demvof {

/// What a user gives in a case file and on the command line: YAML values by the path of their key, not
/// yet read, and what is wrong with the keys themselves.
class GivenValues {
 public:
  /// Throws InputError when the file cannot be read or is no YAML map.
  explicit GivenValues(const std::string& file);
  /// Applies "coupling.window=1e-4" on top.
  void override_with(const std::string& assignment);

  const std::map<std::string, YAML::Node>& values() const { return values_; }
  /// Of every given key and section, also of sections that are no map.
  const std::map<std::string, Source>& sources() const { return sources_; }
  /// A map or list of that path is given, or a key inside it.
  bool section_given(const std::string& path) const { return sections_.count(path) > 0; }
  const Mistakes& mistakes() const { return mistakes_; }

 private:
  Source source_of(const YAML::Node& node) const;
  void add_mistake(const Source& source, const std::string& key, const std::string& text);
  void forget_section(const std::string& path);
  void walk_section(const YAML::Node& node, const std::string& path);
  void walk_list(const YAML::Node& node, const std::string& path);
  void walk_list_entry(const YAML::Node& entry, const std::string& path, std::vector<std::string>& seen);
  void walk_item(const std::string& name, const YAML::Node& value, const Source& source,
                 const std::string& parent, std::vector<std::string>& seen);
  void walk_value(const YAML::Node& value, const std::string& path, const Source& source);

  std::string file_;
  std::optional<Source> override_;  // while an override is walked
  std::map<std::string, YAML::Node> values_;
  std::map<std::string, Source> sources_, sections_;
  Mistakes mistakes_;
};

}  // namespace demvof
