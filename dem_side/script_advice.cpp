// SPDX-License-Identifier: GPL-3.0-or-later
// What the text of a script tells. LIGGGHTS names what it does not like, not the line: three things that
// stand in many scripts have a reason that a user cannot guess: ranks that the script sets, names that
// another coupling gives to its fixes, and styles of another LIGGGHTS than the one that is linked.

#include "dem_side/script_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <vector>

#include "coupler/base/errors.hpp"

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

/// The last line of a command of which the linked LIGGGHTS has not that style.
std::string on_style(const std::filesystem::path& script, const std::string& command,
                     std::string (*instead)(const std::string&)) {
  std::string advice;
  for (const Line& line : commands(script))
    if (line.words[0] == command && line.words.size() > 1)
      advice = fmt::format("{}: the LIGGGHTS that demvof is linked with has no {} '{}'; {}",
                           quoted(script, line), command, line.words[1], instead(line.words[1]));
  return advice;
}

/// gran/hertz/history of LIGGGHTS 2 and LAMMPS: the model's name and whether it remembers the tangential
/// force.
std::string pair_style_instead(const std::string& style) {
  std::smatch old;
  if (!std::regex_match(style, old, std::regex("gran/(hooke|hertz)(/history)?(/\\w+)*")))
    return "spheres in contact: 'pair_style gran model hertz tangential history', materials in fix "
           "property/global";
  return fmt::format(
      "it is of a version before 3: write 'pair_style gran model {} tangential {}', 'pair_coeff * *', and "
      "the "
      "materials (youngsModulus, poissonsRatio, coefficientRestitution, coefficientFriction) in fix "
      "property/global; walls (fix wall/gran) by the same words",
      old[1].str(), old[2].matched ? "history" : "no_history");
}

std::string atom_style_instead(const std::string& style) {
  const bool shapes = style == "superquadric" || style == "convexhull";
  return fmt::format("{}demvof couples spheres: write 'atom_style granular'",
                     shapes ? "that shape is left out when it is built, as Debian's package is; " : "");
}

}  // namespace

void refuse_before_it_is_read(const std::filesystem::path& script) {
  for (const Line& line : commands(script))
    if (line.words.size() > 1 && line.words[0] == "dimension" && line.words[1] != "3")
      throw InputError(fmt::format(
          "{}: particles are spheres in space, and LIGGGHTS's spheres know nothing else; remove the line. A "
          "slice: walls, or one row of periodic cells",
          quoted(script, line)));
}

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
  if (error.find("Atom sorting has bin size") != std::string::npos)
    return "there are no particles yet by whose size LIGGGHTS could sort them: add the line 'atom_modify "
           "sort 0 0'";
  if (error.find("Too many atom sorting bins") != std::string::npos)
    return "the particles' box is very large against them: add the line 'atom_modify sort 0 0', or make the "
           "box "
           "smaller";
  if (error.find("Too many neighbor bins") != std::string::npos)
    return "the particles' box is very large against them: make it smaller (create_box, read_data); where "
           "particles leave it they are lost";
  if (error.find("Invalid pair style") != std::string::npos)
    return on_style(script, "pair_style", pair_style_instead);
  if (error.find("Invalid atom style") != std::string::npos)
    return on_style(script, "atom_style", atom_style_instead);
  return {};
}

}  // namespace demvof
