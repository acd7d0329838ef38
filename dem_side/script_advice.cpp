// SPDX-License-Identifier: GPL-3.0-or-later
// What the text of a script tells. LIGGGHTS names what it does not like, not the line: two things that stand
// in many scripts have a reason that a user cannot guess: ranks that the script sets, and names that another
// coupling gives to its fixes.

#include "dem_side/script_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <vector>

namespace demvof {
namespace {

struct Line {
  int number;
  std::string text;
  std::vector<std::string> words;
};

/// The commands of a script, without comments.
std::vector<Line> commands(const std::filesystem::path& script) {
  std::vector<Line> lines;
  std::ifstream file(script);
  int number = 0;
  for (std::string text; std::getline(file, text);) {
    ++number;
    text.erase(std::min(text.find('#'), text.size()));
    Line line{number, text, {}};
    std::istringstream stream(text);
    for (std::string word; stream >> word;) line.words.push_back(word);
    if (!line.words.empty()) lines.push_back(line);
  }
  return lines;
}

std::string quoted(const std::filesystem::path& script, const Line& line) {
  const auto begin = line.text.find_first_not_of(" \t"), end = line.text.find_last_not_of(" \t\r");
  return fmt::format("{}:{}: '{}'", script.string(), line.number, line.text.substr(begin, end - begin + 1));
}

std::string on_ranks(const std::filesystem::path& script) {
  for (const Line& line : commands(script))
    if (line.words[0] == "processors")
      return fmt::format(
          "{}: how many ranks dem_side has, says particles.ranks of the case file (or --particle-ranks); "
          "write "
          "'processors * * *', or as many as there",
          quoted(script, line));
  return {};
}

/// Names f_x that no fix of the script has: in scripts for other couplings, those of the fixes that hand over
/// the fluid's force.
std::string on_unknown_fixes(const std::filesystem::path& script) {
  const std::vector<Line> lines = commands(script);
  std::set<std::string> made;
  for (const Line& line : lines)
    if (line.words[0] == "fix" && line.words.size() > 1) made.insert(line.words[1]);
  const std::regex use("\\bf_(\\w+)");
  for (const Line& line : lines) {
    std::smatch found;
    if (!std::regex_search(line.text, found, use) || made.count(found[1]) > 0) continue;
    const std::string name = found[1];
    const bool another = name == "dragforce" || name == "couple" || name == "cfd" || name == "cfd2";
    return fmt::format(
        "{}: the script makes no fix '{}'{}; remove the line and what uses it. What the fluid does to the "
        "particles "
        "is in history.csv (output.history) and in the files of folder particles",
        quoted(script, line), name,
        another
            ? ", which belongs to another coupling (CFDEMcoupling's fix couple/cfd/force): demvof puts the "
              "fluid's forces on the particles itself, those under 'forces' in the case file"
            : "");
  }
  return {};
}

}  // namespace

bool fix_has_word(const std::filesystem::path& script, const std::string& fix, const std::string& word) {
  for (const Line& line : commands(script))
    if (line.words.size() > 3 && line.words[0] == "fix" && line.words[1] == fix &&
        std::find(line.words.begin() + 3, line.words.end(), word) != line.words.end())
      return true;
  return false;
}

std::string advice_on(const std::string& error, const std::filesystem::path& script) {
  if (error.find("processors") != std::string::npos) return on_ranks(script);
  if (error.find("Fix ID") != std::string::npos) return on_unknown_fixes(script);
  return {};
}

}  // namespace demvof
