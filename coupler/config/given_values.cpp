// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/given_values.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/base/printable.hpp"
#include "coupler/config/keys.hpp"
#include "coupler/config/nearest.hpp"

namespace demvof {
namespace {

std::string joined(const std::string& parent, const std::string& name) {
  return parent.empty() ? name : parent + "." + name;
}

bool is_known(const std::string& path) {
  return find_key(path) || find_section(path);
}

/// Names of the keys and sections directly inside a section ("" is the whole file).
std::vector<std::string> names_inside(const std::string& path) {
  std::vector<std::string> names;
  for (const Section& section : case_sections())
    if (parent_of(section.path) == path && !find_key(section.path))
      names.push_back(name_of_key(section.path));
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

std::string unknown_path(const std::string& path) {
  std::vector<std::string> paths;
  for (const Key& key : case_keys()) paths.push_back(key.path);
  const std::string hint = did_you_mean(path, paths);
  if (!hint.empty()) return "unknown key" + hint;
  const bool in_section = find_section(parent_of(path)) != nullptr;
  return unknown_key(name_of_key(path), in_section ? parent_of(path) : "");
}

/// How an entry with a value is written.
std::string entry_example(const std::string& word, const ValueRule& rule) {
  const std::string value = rule.form == ValueRule::Form::choice ? rule.choices.back() : allowed_text(rule);
  return fmt::format("{{{}: {}}}", word, value);
}

std::string read_text(const std::string& file) {
  constexpr std::size_t most_bytes = 1000000;  // a thousand times what a case needs
  std::ifstream stream(file);
  std::string text(most_bytes + 1, ' ');
  if (!stream || (stream.read(text.data(), most_bytes + 1), stream.bad()))
    throw InputError(fmt::format("{}: the case file cannot be read", file));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most_bytes)
    throw InputError(fmt::format("{}: a case file has at most {} bytes", file, most_bytes));
  return text;
}

/// Where documents begin, and nothing of what is in them.
class DocumentStarts : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> marks;  // of the first thing in each

  void OnDocumentStart(const YAML::Mark& mark) override {
    marks.push_back(mark);
    in_it_ = false;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { note(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { note(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    note(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    note(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    note(mark);
  }
  void OnMapEnd() override {}

 private:
  void note(const YAML::Mark& mark) {
    if (!in_it_) marks.back() = mark;
    in_it_ = true;
  }
  bool in_it_ = false;
};

/// From 1; nothing when the text is one document. yaml-cpp makes documents for ever of a comma or a closing
/// bracket between two of them: after the second one nobody asks it for more.
std::optional<int> line_of_second_document(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  while (starts.marks.size() < 2 && parser.HandleNextDocument(starts)) {
  }
  if (starts.marks.size() < 2) return std::nullopt;
  return starts.marks[1].line + 1;
}

}  // namespace

GivenValues::GivenValues(const std::string& file) : file_(file) {
  YAML::Node document;
  std::optional<int> second;
  try {
    const std::string text = read_text(file);
    second = line_of_second_document(text);
    document = YAML::Load(text);
  } catch (const YAML::ParserException& error) {
    throw InputError(
        fmt::format("{}:{}: not valid YAML: {}", file, error.mark.line + 1, printable(error.msg)));
  }
  const bool empty = document.IsNull();
  if (second && (empty || !document.IsMap()))
    throw InputError(
        fmt::format("{}:{}: there is more behind what is complete by itself: look for a comma or a "
                    "bracket too much, or a second YAML document",
                    file, *second));
  if (empty || !document.IsMap())
    throw InputError(fmt::format("{}: the case file {}; give a map with {}", file,
                                 empty ? "is empty" : "is no map", fmt::join(names_inside(""), ", ")));
  if (second) add_mistake(Source{file_, *second}, "", "a second YAML document; a case file holds one");
  walk_section(document, "");
}

void GivenValues::override_with(const std::string& assignment) {
  override_ = Source{"--set", Source::override_line};
  const std::size_t equals = assignment.find('=');
  const std::string path = assignment.substr(0, equals);
  if (equals == std::string::npos || path.empty()) {
    add_mistake(*override_, "", fmt::format("'{}' is not of the form key=value", assignment));
  } else if (!is_known(path)) {
    add_mistake(*override_, path, unknown_path(path));
  } else {
    // An override may open a section that the file does not have.
    for (std::string up = parent_of(path); !up.empty(); up = parent_of(up)) {
      values_.erase(up);  // where a value may stand in place of the section
      sections_.emplace(up, *override_);
      sources_.emplace(up, *override_);
    }
    try {
      walk_value(YAML::Load(assignment.substr(equals + 1)), path, *override_);
    } catch (const YAML::ParserException& error) {
      add_mistake(*override_, path, fmt::format("not a YAML value: {}", error.msg));
    }
  }
  override_.reset();
}

Source GivenValues::source_of(const YAML::Node& node) const {
  return override_ ? *override_ : Source{file_, node.Mark().line + 1};
}

void GivenValues::add_mistake(const Source& source, const std::string& key, const std::string& text) {
  Mistake mistake;
  mistake.source = source;
  mistake.key = key;
  mistake.text = text;
  mistakes_.push_back(mistake);
}

void GivenValues::forget_section(const std::string& path) {
  sections_.erase(path);
  for (const Key& key : case_keys())
    if (parent_of(key.path) == path) {
      values_.erase(key.path);
      sources_.erase(key.path);
    }
}

void GivenValues::walk_section(const YAML::Node& node, const std::string& path) {
  std::vector<std::string> seen;
  for (const auto& item : node)
    walk_item(item.first.IsScalar() ? item.first.Scalar() : given_text(item.first), item.second,
              source_of(item.first), path, seen);
}

void GivenValues::walk_list(const YAML::Node& node, const std::string& path) {
  // What a given list does not name is off.
  for (const Key& key : case_keys())
    if (parent_of(key.path) == path) {
      values_[key.path] = YAML::Load(off_value(key.rule).dump());
      sources_[key.path] = source_of(node);
    }
  std::vector<std::string> seen;
  for (const YAML::Node& entry : node) walk_list_entry(entry, path, seen);
}

void GivenValues::walk_list_entry(const YAML::Node& entry, const std::string& path,
                                  std::vector<std::string>& seen) {
  if (entry.IsMap() && entry.size() == 1) {
    const auto pair = *entry.begin();
    walk_item(pair.first.Scalar(), pair.second, source_of(pair.first), path, seen);
    return;
  }
  if (!entry.IsScalar()) {
    add_mistake(source_of(entry), path,
                fmt::format("{} is not allowed; give a word or {{word: value}}", given_text(entry)));
    return;
  }
  const std::string& word = entry.Scalar();
  const Key* key = find_key(joined(path, word));
  if (key && key->rule.form != ValueRule::Form::flag)
    add_mistake(source_of(entry), key->path, "needs a value: write " + entry_example(word, key->rule));
  else if (find_section(joined(path, word)))  // with its defaults
    walk_item(word, YAML::Node(YAML::NodeType::Map), source_of(entry), path, seen);
  else
    walk_item(word, YAML::Node("true"), source_of(entry), path, seen);
}

void GivenValues::walk_item(const std::string& name, const YAML::Node& value, const Source& source,
                            const std::string& parent, std::vector<std::string>& seen) {
  const std::string path = joined(parent, name);
  if (name.find('.') != std::string::npos && is_known(path)) {
    add_mistake(source, path, "the key of a section is written inside of it, not with dots");
  } else if (!is_known(path)) {
    add_mistake(source, path, unknown_key(name, parent));
  } else if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
    add_mistake(
        source, path,
        override_ ? "given twice" : fmt::format("given twice; first in line {}", sources_[path].line));
  } else {
    seen.push_back(name);
    walk_value(value, path, source);
  }
}

void GivenValues::walk_value(const YAML::Node& value, const std::string& path, const Source& source) {
  sources_[path] = source;
  const Section* section = find_section(path);
  const bool either = section && find_key(path);  // a value or a map; the last one given counts
  if (!section || (either && !value.IsMap())) {
    values_[path] = value;
    if (either) forget_section(path);
  } else if (section->is_list ? !value.IsSequence() : !value.IsMap()) {
    add_mistake(source, path,
                fmt::format("{} is not allowed; give a {} {}", given_text(value),
                            section->is_list ? "list of" : "map with", fmt::join(names_inside(path), ", ")));
  } else {
    values_.erase(path);
    sections_[path] = source;
    section->is_list ? walk_list(value, path) : walk_section(value, path);
  }
}

}  // namespace demvof
