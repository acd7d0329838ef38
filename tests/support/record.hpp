// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a verification test measured; the file that record.py writes, from C++.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace demvof::test {

class Record {
 public:
  /// row: file name and key; what: a paragraph for docs/verification.md; command: that repeats it,
  /// from the project's top folder.
  Record(const std::string& row, const std::string& title, const std::string& what,
         const std::string& command) {
    content_ = {{"row", row},
                {"title", title},
                {"what", what},
                {"command", command},
                {"values", nlohmann::json::array()},
                {"curves", nlohmann::json::array()}};
  }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

  /// Writes <folder>/<row>.json; the folder is $DEMVOF_RECORDS, or records/ below the working directory.
  ~Record() {
    const char* given = std::getenv("DEMVOF_RECORDS");
    const std::filesystem::path folder = given ? given : "records";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / (content_["row"].get<std::string>() + ".json")) << content_.dump(1) << '\n';
  }

  /// loose: why the bound may be further away than 3 times the value, 20 times where it is round-off.
  void at_most(const std::string& name, double value, double bound, const std::string& unit = "-",
               const std::string& loose = "") {
    add(name, value, bound, unit, "at most", value <= bound, loose);
    EXPECT_LE(value, bound) << name;
  }
  void at_least(const std::string& name, double value, double bound, const std::string& unit = "-",
                const std::string& loose = "") {
    add(name, value, bound, unit, "at least", value >= bound, loose);
    EXPECT_GE(value, bound) << name;
  }
  /// A number that is measured and held to no bound.
  void note(const std::string& name, double value, const std::string& unit = "-") {
    add(name, value, nullptr, unit, "recorded", true);
  }
  /// A line of a picture: curves of the same picture share axes. log: any of "x", "y".
  void curve(const std::string& picture, const std::string& x_label, const std::string& y_label,
             const std::string& series, const std::vector<double>& x, const std::vector<double>& y,
             const std::string& log = "", const std::string& style = "o-") {
    content_["curves"].push_back({{"picture", picture},
                                  {"x_label", x_label},
                                  {"y_label", y_label},
                                  {"series", series},
                                  {"x", x},
                                  {"y", y},
                                  {"log", log},
                                  {"style", style}});
  }

 private:
  void add(const std::string& name, double value, const nlohmann::json& bound, const std::string& unit,
           const std::string& comparison, bool passed, const std::string& loose = "") {
    content_["values"].push_back({{"name", name},
                                  {"value", value},
                                  {"bound", bound},
                                  {"unit", unit},
                                  {"comparison", comparison},
                                  {"passed", passed && std::isfinite(value)}});
    if (!loose.empty()) content_["values"].back()["loose"] = loose;
  }
  nlohmann::json content_;
};

}  // namespace demvof::test
