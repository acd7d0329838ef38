// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parameter <-> JSON value, by type.

#include <string>
#include <type_traits>
#include <vector>

#include "coupler/base/vec3.hpp"
#include "coupler/config/enum_names.hpp"
#include "coupler/config/value_rule.hpp"
#include "coupler/exchange/gravity_table.hpp"

namespace demvof {

template <class T>
Json to_json_value(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return name_of(value);
  else
    return value;
}
inline Json to_json_value(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

template <class T>
void from_json_value(const Json& json, T& value) {
  if constexpr (std::is_enum_v<T>) {
    for (const auto& [choice, name] : enum_names<T>)
      if (name == json.get<std::string>()) value = choice;
  } else {
    value = json.get<T>();
  }
}
inline void from_json_value(const Json& json, Vec3& v) {
  v = {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

inline Json to_json_value(const std::vector<GravityTable::Row>& rows) {
  Json json = Json::array();
  for (const auto& [t, g] : rows) json.push_back({t, g.x, g.y, g.z});
  return json;
}
inline void from_json_value(const Json& json, std::vector<GravityTable::Row>& rows) {
  for (const Json& row : json) rows.push_back({row[0], {row[1], row[2], row[3]}});
}

}  // namespace demvof
