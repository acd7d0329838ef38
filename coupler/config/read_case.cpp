// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/read_case.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "coupler/config/case_checks.hpp"
#include "coupler/config/keys.hpp"
#include "coupler/config/nearest.hpp"

namespace demvof {
namespace {

/// Walks the case file and the overrides, and collects what is given where and what is wrong.
class Reading {
 public:
  explicit Reading(const std::string& file) : file_(file) {}

  void read_file();
  void read_override(const std::string& assignment);
  CaseParameters fill();
  const Mistakes& mistakes() const { return mistakes_; }
  Mistakes& mistakes() { return mistakes_; }
  const std::map<std::string, Source>& sources() const { return sources_; }

 private:
  void add(const Source& source, const std::string& key, const std::string& text) {
    Mistake mistake;
    mistake.source = source;
    mistake.key = key;
    mistake.text = text;
    mistakes_.push_back(mistake);
  }
  Source source_of(const YAML::Node& node) const;
  void walk_section(const YAML::Node& node, const std::string& path, const Source* override_source);
  void walk_list(const YAML::Node& node, const std::string& path, const Source* override_source);
  void walk_item(const std::string& name, const YAML::Node& name_node, const YAML::Node& value,
                 const std::string& parent, std::vector<std::string>& seen, const Source* override_source);
  void walk_value(const YAML::Node& value, const std::string& path, const Source& source,
                  const Source* override_source);
  bool section_given(const std::string& path) const { return sections_.count(path) > 0; }

  std::string file_;
  std::map<std::string, YAML::Node> values_;  // of keys, by path
  std::map<std::string, Source> sources_;     // of keys and sections, by path
  std::map<std::string, Source> sections_;    // given ones
  Mistakes mistakes_;
};

std::string joined(const std::string& parent, const std::string& name) {
  return parent.empty() ? name : parent + "." + name;
}

/// Names of the keys and sections directly inside a section ("" is the whole file).
std::vector<std::string> names_inside(const std::string& path) {
  std::vector<std::string> names;
  for (const Section& section : case_sections())
    if (parent_of(section.path) == path) names.push_back(name_of_key(section.path));
  for (const Key& key : case_keys())
    if (parent_of(key.path) == path) names.push_back(name_of_key(key.path));
  return names;
}

std::string unknown_key(const std::string& name, const std::string& parent) {
  const std::vector<std::string> names = names_inside(parent);
  const std::string hint = did_you_mean(name, names);
  if (!hint.empty()) return "unknown key" + hint;
  // A known key in the wrong section is the other common slip.
  for (const Key& key : case_keys())
    if (name_of_key(key.path) == name) return fmt::format("unknown key; did you mean '{}'?", key.path);
  return fmt::format("unknown key; allowed here: {}", fmt::join(names, ", "));
}

void Reading::read_file() {
  std::ifstream stream(file_);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf()))
    throw InputError(fmt::format("{}: the case file cannot be read", file_));
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text.str());
  } catch (const YAML::ParserException& error) {
    throw InputError(fmt::format("{}:{}: not valid YAML: {}", file_, error.mark.line + 1, error.msg));
  }
  if (documents.size() > 1) add(source_of(documents[1]), "", "a second YAML document; a case file holds one");
  const bool empty = documents.empty() || documents[0].IsNull();
  if (empty || !documents[0].IsMap())
    throw InputError(fmt::format("{}: the case file {}; give a map with {}", file_,
                                 empty ? "is empty" : "is no map", fmt::join(names_inside(""), ", ")));
  walk_section(documents[0], "", nullptr);
}

void Reading::read_override(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string path = assignment.substr(0, equals);
  const Source source = {"--set", Source::override_line};
  if (equals == std::string::npos || path.empty()) {
    add(source, "", fmt::format("'{}' is not of the form key=value", assignment));
    return;
  }
  YAML::Node value;
  try {
    value = YAML::Load(assignment.substr(equals + 1));
  } catch (const YAML::ParserException& error) {
    add(source, path, fmt::format("not a YAML value: {}", error.msg));
    return;
  }
  if (!find_key(path) && !find_section(path)) {
    std::vector<std::string> paths;
    for (const Key& key : case_keys()) paths.push_back(key.path);
    const std::string hint = did_you_mean(path, paths);
    const bool in_section = find_section(parent_of(path)) != nullptr;
    add(source, path,
        !hint.empty() ? "unknown key" + hint
                      : unknown_key(name_of_key(path), in_section ? parent_of(path) : ""));
    return;
  }
  // An override may open a section that the file does not have.
  for (std::string up = parent_of(path); !up.empty(); up = parent_of(up)) {
    sections_.emplace(up, source);
    sources_.emplace(up, source);
  }
  walk_value(value, path, source, &source);
}

Source Reading::source_of(const YAML::Node& node) const {
  return {file_, node.Mark().line + 1};
}

void Reading::walk_section(const YAML::Node& node, const std::string& path, const Source* override_source) {
  std::vector<std::string> seen;
  for (const auto& item : node)
    walk_item(item.first.IsScalar() ? item.first.Scalar() : given_text(item.first), item.first, item.second,
              path, seen, override_source);
}

void Reading::walk_list(const YAML::Node& node, const std::string& path, const Source* override_source) {
  const Source source = override_source ? *override_source : source_of(node);
  // What a given list does not name is off.
  for (const Key& key : case_keys())
    if (parent_of(key.path) == path) {
      values_[key.path] = YAML::Node(key.rule.form == ValueRule::Form::flag ? "false" : "none");
      sources_[key.path] = source;
    }
  std::vector<std::string> seen;
  for (const YAML::Node& item : node) {
    if (item.IsScalar()) {
      const Key* key = find_key(joined(path, item.Scalar()));
      if (key && key->rule.form != ValueRule::Form::flag)
        mistakes_.push_back(
            {override_source ? *override_source : source_of(item), key->path,
             fmt::format("needs a value: write {{{}: {}}}", item.Scalar(), key->rule.choices.back())});
      else
        walk_item(item.Scalar(), item, YAML::Node("true"), path, seen, override_source);
    } else if (item.IsMap() && item.size() == 1) {
      const auto pair = *item.begin();
      walk_item(pair.first.Scalar(), pair.first, pair.second, path, seen, override_source);
    } else {
      mistakes_.push_back(
          {override_source ? *override_source : source_of(item), path,
           fmt::format("{} is not allowed; give a word or {{word: value}}", given_text(item))});
    }
  }
}

void Reading::walk_item(const std::string& name, const YAML::Node& name_node, const YAML::Node& value,
                        const std::string& parent, std::vector<std::string>& seen,
                        const Source* override_source) {
  const std::string path = joined(parent, name);
  const Source source = override_source ? *override_source : source_of(name_node);
  if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
    add(source, path, fmt::format("given twice; first in line {}", sources_[path].line));
    return;
  }
  if (!find_key(path) && !find_section(path)) {
    add(source, path, unknown_key(name, parent));
    return;
  }
  seen.push_back(name);
  walk_value(value, path, source, override_source);
}

void Reading::walk_value(const YAML::Node& value, const std::string& path, const Source& source,
                         const Source* override_source) {
  sources_[path] = source;
  const Section* section = find_section(path);
  if (!section) {
    values_[path] = value;
    return;
  }
  if (section->is_list ? !value.IsSequence() : !value.IsMap()) {
    add(source, path,
        fmt::format("{} is not allowed; give a {} {}", given_text(value),
                    section->is_list ? "list of" : "map with", fmt::join(names_inside(path), ", ")));
    return;
  }
  sections_[path] = source;
  if (section->is_list)
    walk_list(value, path, override_source);
  else
    walk_section(value, path, override_source);
}

CaseParameters Reading::fill() {
  CaseParameters parameters;
  parameters.file = file_;
  for (const Section& section : case_sections()) {
    if (section_given(section.path)) section.create(parameters);
    if (section.presence == Section::Presence::required && !sources_.count(section.path))
      add(Source{file_, 0}, section.path, "missing; " + section.doc);
  }
  for (const Key& key : case_keys()) {
    const auto given = values_.find(key.path);
    if (given != values_.end()) {
      Json value;
      if (const auto mistake = read_value(given->second, key.rule, value))
        add(sources_[key.path], key.path, *mistake);
      else
        key.set(parameters, value);
    } else if (key.required && section_given(parent_of(key.path))) {
      mistakes_.push_back(
          {sections_[parent_of(key.path)], key.path, "missing; give " + allowed_text(key.rule)});
    }
  }
  return parameters;
}

}  // namespace

CaseParameters read_case(const std::string& file, const std::vector<std::string>& overrides) {
  Reading reading(file);
  reading.read_file();
  for (const std::string& assignment : overrides) reading.read_override(assignment);
  CaseParameters parameters = reading.fill();
  check_case(parameters, reading.sources(), reading.mistakes());
  if (!reading.mistakes().empty()) throw InputError(report(reading.mistakes()));
  if (parameters.scene.particles == Switch::off) parameters.particles.reset();
  return parameters;
}

std::filesystem::path beside_case_file(const CaseParameters& parameters, const std::string& path) {
  return std::filesystem::path(parameters.file).parent_path() / path;
}

}  // namespace demvof
