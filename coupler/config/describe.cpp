// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/describe.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupler/config/keys.hpp"

namespace demvof {
namespace {

using Form = ValueRule::Form;

Json schema_of_one(const ValueRule& rule) {
  Json schema;
  switch (rule.form) {
    case Form::text:
      schema["type"] = "string";
      schema["minLength"] = 1;
      break;
    case Form::number:
      schema["type"] = "number";
      break;
    case Form::integer:
      schema["type"] = "integer";
      break;
    case Form::choice:
      schema["enum"] = rule.choices;
      break;
    case Form::flag:
      schema["type"] = "boolean";
      break;
    case Form::table:
      schema["oneOf"] = {{{"type", "string"}, {"minLength", 1}},
                         {{"type", "array"},
                          {"minItems", 1},
                          {"items",
                           {{"type", "array"},
                            {"items", {{"type", "number"}}},
                            {"minItems", *rule.list_length},
                            {"maxItems", *rule.list_length}}}}};
      return schema;
  }
  const auto bound = [&rule](double value) {
    return rule.form == Form::integer ? Json(static_cast<long>(value)) : Json(value);
  };
  if (std::isfinite(rule.lowest))
    schema[rule.lowest_excluded ? "exclusiveMinimum" : "minimum"] = bound(rule.lowest);
  if (std::isfinite(rule.highest)) schema["maximum"] = bound(rule.highest);
  return schema;
}

Json schema_of_value(const Key& key) {
  Json schema = {{"description", key.doc}};
  if (!key.rule.unit.empty() && key.rule.unit != "-")
    schema["description"] = fmt::format("{} Unit: {}.", key.doc, key.rule.unit);
  if (key.rule.list_length && key.rule.form != Form::table) {
    schema["type"] = "array";
    schema["items"] = schema_of_one(key.rule);
    if (*key.rule.list_length != ValueRule::any_length)
      schema["minItems"] = schema["maxItems"] = *key.rule.list_length;
  } else {
    schema.update(schema_of_one(key.rule));
  }
  return schema;
}

Json schema_of(const Key& key, const CaseParameters& defaults) {
  Json schema = schema_of_value(key);
  if (!key.required) schema["default"] = key.get(defaults);
  return schema;
}

Json section_schema(const std::string& path, const CaseParameters& defaults);

Json list_section_schema(const Section& section, const CaseParameters& defaults) {
  Json entries = Json::array();
  for (const Key& key : case_keys()) {
    if (parent_of(key.path) != section.path) continue;
    const std::string name = name_of_key(key.path);
    if (key.rule.form == Form::flag) {
      entries.push_back({{"description", key.doc}, {"const", name}});
    } else {
      entries.push_back({{"type", "object"},
                         {"properties", {{name, schema_of_value(key)}}},
                         {"required", Json::array({name})},
                         {"additionalProperties", false}});
    }
  }
  for (const Section& inside : case_sections()) {
    if (parent_of(inside.path) != section.path) continue;
    const std::string name = name_of_key(inside.path);
    entries.push_back({{"description", inside.doc}, {"const", name}});
    entries.push_back({{"type", "object"},
                       {"properties", {{name, section_schema(inside.path, defaults)}}},
                       {"required", Json::array({name})},
                       {"additionalProperties", false}});
  }
  return {{"description", section.doc}, {"type", "array"}, {"items", {{"oneOf", entries}}}};
}

/// The schema of a section ("" is the whole file) with everything inside it.
Json section_schema(const std::string& path, const CaseParameters& defaults) {
  Json properties = Json::object(), required = Json::array();
  for (const Key& key : case_keys()) {
    if (parent_of(key.path) != path) continue;
    properties[name_of_key(key.path)] = schema_of(key, defaults);
    if (key.required) required.push_back(name_of_key(key.path));
  }
  for (const Section& section : case_sections()) {
    if (parent_of(section.path) != path) continue;
    const std::string name = name_of_key(section.path);
    const Json inside =
        section.is_list ? list_section_schema(section, defaults) : section_schema(section.path, defaults);
    if (properties.contains(name))  // a value, or this
      properties[name] = {{"oneOf", Json::array({properties[name], inside})}};
    else
      properties[name] = inside;
    if (section.presence == Section::Presence::required) required.push_back(name);
  }
  Json schema = Json::object();
  if (const Section* section = find_section(path)) schema["description"] = section->doc;
  schema["type"] = "object";
  schema["properties"] = properties;
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  return schema;
}

/// JSON without quotation marks around single texts: as it is typed in the case file.
std::string as_typed(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array())
    return fmt::format("{}", value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump());
  std::string text = "[";
  for (const Json& item : value) text += (text.size() > 1 ? ", " : "") + as_typed(item);
  return text + "]";
}

std::string key_row(const Key& key, const std::string& section, const CaseParameters& defaults) {
  const std::string fallback = key.required ? "required" : fmt::format("`{}`", as_typed(key.get(defaults)));
  const std::string map = find_section(key.path) ? fmt::format(", or a map: `{}`", key.path) : "";
  return fmt::format("| `{}` | {}{} | {} | {} |\n", key.path.substr(section.size() + 1),
                     allowed_text(key.rule), map, fallback, key.doc);
}

}  // namespace

std::string case_file_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "demvof case file"}};
  schema.update(section_schema("", default_parameters()));
  return schema.dump(2) + "\n";
}

std::string case_file_reference() {
  std::string text = R"(# The case file

<!-- Written by `demvof reference`; edit coupler/config/keys.cpp instead. -->

One YAML file describes a run. Values are in SI units; paths count from the folder of the case file. Unknown
keys, keys given twice, wrong types and missing files are errors before anything starts. Any key can be set on
the command line, with the same checks: `--set coupling.window=1e-4`.

Editors that know JSON Schema complete the file when its first line is
`# yaml-language-server: $schema=<path to>/docs/case_file.schema.json`.

    fluid:      {case: fluid}
    particles:  {script: particles/in.dam_break}
    bulk_grid:  {lower: [0, 0, 0], upper: [0.2, 0.1, 0.3], cells: [20, 10, 30]}
    coupling:   {end_time: 0.5, window: 2.0e-4}
    forces:     [{drag: schiller_naumann}, pressure_gradient]
    output:     {interval: 0.02}
)";
  const CaseParameters defaults = default_parameters();
  for (const Section& section : case_sections()) {
    const bool required = section.presence == Section::Presence::required;
    text +=
        fmt::format("\n## `{}`\n\n{}{}\n\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n",
                    section.path, section.doc, required ? " Required." : "");
    for (const Key& key : case_keys())
      if (parent_of(key.path) == section.path) text += key_row(key, section.path, defaults);
  }
  return text;
}

}  // namespace demvof
