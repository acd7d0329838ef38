// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/gathered_state.hpp"

#include <map>
#include <string>

namespace demvof {
namespace {

using nlohmann::json;

bool is_cell_values(const json& value) {
  return value.is_object() && value.size() == 2 && value.contains("cells") && value.contains("values");
}

using Owns = std::function<bool(CellId)>;

json owned_cells(const std::vector<const json*>& parts, const Owns& owns) {
  std::map<CellId, std::vector<json>> rows;
  for (const json* part : parts) {
    const json &cells = part->at("cells"), &values = part->at("values");
    const std::size_t width = cells.empty() ? 0 : values.size() / cells.size();
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (const auto cell = cells[i].get<CellId>(); owns(cell))
        for (std::size_t entry = 0; entry < width; ++entry)
          rows[cell].push_back(values.at(i * width + entry));
  }
  json cells = json::array(), values = json::array();
  for (const auto& [cell, row] : rows) {
    cells.push_back(cell);
    for (const json& value : row) values.push_back(value);
  }
  return {{"cells", cells}, {"values", values}};
}

/// factor: 0 for all but one, so that the sum over ranks stays.
json sum(const std::vector<const json*>& parts, double factor) {
  if (!parts[0]->is_array()) {
    double total = 0;
    for (const json* part : parts) total += part->get<double>();
    return factor * total;
  }
  json total = json::array();
  for (std::size_t entry = 0; entry < parts[0]->size(); ++entry) {
    double one = 0;
    for (const json* part : parts) one += part->at(entry).get<double>();
    total.push_back(factor * one);
  }
  return total;
}

/// Values on bulk cells go to their owners, what else there is was the same on all ranks or is a sum over
/// them.
json on_bulk_cells(const std::vector<const json*>& parts, const Owns& owns, bool first) {
  const json& one = *parts[0];
  if (is_cell_values(one)) return owned_cells(parts, owns);
  if (one.is_structured()) {
    json all = one;
    const auto inside = [&](const auto& key) {
      std::vector<const json*> inner;
      for (const json* part : parts) inner.push_back(&part->at(key));
      return inner;
    };
    if (one.is_array()) {
      for (std::size_t i = 0; i < one.size(); ++i) all[i] = on_bulk_cells(inside(i), owns, first);
      return all;
    }
    for (const auto& [key, value] : one.items()) {
      all[key] = on_bulk_cells(inside(key), owns, first);
      if (key != "on_its_way" && key != "turnover") continue;
      all[key] = sum(inside(key), first ? 1 : 0);
    }
    return all;
  }
  return one;
}

}  // namespace

json gathered_state(const std::vector<json>& of_ranks, const Owns& owns, bool first) {
  json all = of_ranks.at(0);
  for (const char* key : {"exchange", "surface", "openings"}) {
    if (!all.contains(key)) continue;
    std::vector<const json*> parts;
    for (const json& part : of_ranks) parts.push_back(&part.at(key));
    all[key] = on_bulk_cells(parts, owns, first);
  }
  return all;
}

json gathered_flow(const std::vector<json>& of_ranks, const std::vector<int>& fine_cells) {
  std::size_t total = 0;
  for (const json& part : of_ranks) total += part.at("flow").at("cells").get<std::size_t>();
  json here = of_ranks[0].at("flow");
  here["cells"] = fine_cells.size();
  here["cell_numbers"] = fine_cells;
  for (const auto& [key, value] : of_ranks[0].at("flow").items()) {
    const auto cells = of_ranks[0].at("flow").at("cells").get<std::size_t>();
    if (!value.is_array() || key == "cell_numbers" || key == "gravity" || cells == 0) continue;
    const std::size_t width = value.size() / cells;
    std::vector<double> all(total * width);
    for (const json& part : of_ranks) {
      const json& flow = part.at("flow");
      const json &rows = flow.at(key), &numbers = flow.at("cell_numbers");
      for (std::size_t i = 0; i < numbers.size(); ++i)
        for (std::size_t entry = 0; entry < width; ++entry)
          all.at(numbers[i].get<std::size_t>() * width + entry) = rows.at(i * width + entry);
    }
    std::vector<double> mine;
    for (const int cell : fine_cells)
      for (std::size_t entry = 0; entry < width; ++entry)
        mine.push_back(all.at(static_cast<std::size_t>(cell) * width + entry));
    here[key] = mine;
  }
  return here;
}

}  // namespace demvof
