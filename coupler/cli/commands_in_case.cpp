// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/commands_in_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "coupler/base/printable.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

struct Rule {
  std::regex found;
  const char* what;
};

/// A path that leaves the folder.
const std::regex& outside() {
  static const std::regex path(R"((^|[\s"'(=])(/|~|\S*\.\.(/|$)))");
  return path;
}

void add(Lines& found, const fs::path& file, long line, const std::string& what, const std::string& text) {
  found.push_back(fmt::format("{}:{}: {}: {}", file.string(), line, what, cut(printable(text), 80)));
}

// ---- the commands of fluid.prepare

/// Known programs with plain words: they read and write the copied case only.
bool is_harmless(const std::string& command) {
  static const std::vector<std::string> known = {
      "blockMesh",    "setFields",       "topoSet",   "refineMesh",   "mirrorMesh", "stretchMesh",
      "renumberMesh", "createPatch",     "checkMesh", "extrudeMesh",  "subsetMesh", "cp",
      "mv",           "transformPoints", "autoPatch", "createBaffles"};
  static const std::regex plain(R"([A-Za-z0-9_ .,/:=()\-]*)");
  const std::string program = command.substr(0, command.find(' '));
  return std::regex_match(command, plain) && !std::regex_search(command, outside()) &&
         std::find(known.begin(), known.end(), program) != known.end();
}

// ---- OpenFOAM's dictionaries

const std::vector<Rule>& openfoam_rules() {
  static const std::vector<Rule> rules = {
      {std::regex(R"(#\s*(calc|codeStream|eval)\b|#\{)"), "code that is compiled and run"},
      {std::regex(R"(\bcoded\w*|\bcode(Include|Options|Execute|Write|End|Read)?\b)"),
       "code that is compiled and run"},
      {std::regex(R"(\bsystemCall\b|\b(execute|write|end)Calls\b)"), "a command of the shell"},
      {std::regex(R"(\blibs?\s*\([^)]*[/\\])"), "a library by its path"},
      {std::regex(R"(#\s*include\w*\s+"(/|~|[^"]*\.\.|\$))"), "a file from outside of the case"}};
  return rules;
}

/// Without what stands in comments.
std::string without_comments(const std::string& text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "//") == 0) {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (text.compare(i, 2, "/*") == 0) {
      for (i += 2; i < text.size() && text.compare(i, 2, "*/") != 0; ++i)
        if (text[i] == '\n') kept += '\n';
      ++i;
      continue;
    }
    if (i < text.size()) kept += text[i];
  }
  return kept;
}

void look_through_dictionary(const fs::path& file, Lines& found) {
  if (file.extension() == ".gz") return add(found, file, 1, "compressed, nobody has looked through it", "");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream whole;
  whole << stream.rdbuf();
  std::istringstream lines(without_comments(whole.str()));
  std::string line;
  for (long number = 1; std::getline(lines, line); ++number) {
    if (line.size() > 10000) continue;  // numbers
    for (const Rule& rule : openfoam_rules())
      if (std::regex_search(line, rule.found)) add(found, file, number, rule.what, line);
  }
}

void look_through_fluid(const fs::path& folder, Lines& found) {
  for (const char* part : {"system", "constant", "0.orig", "0"}) {
    std::error_code none;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder / part, none)) {
      if (entry.is_symlink()) add(found, entry.path(), 1, "a link", fs::read_symlink(entry.path()).string());
      if (entry.is_regular_file()) look_through_dictionary(entry.path(), found);
    }
  }
}

// ---- LIGGGHTS's script

const std::vector<Rule>& script_rules() {
  static const std::vector<Rule> rules = {
      {std::regex(R"(\bshell\b)"), "a command of the shell"},
      {std::regex(R"(\bpython\b|\bgetenv\b)"), "code from elsewhere"},
      {std::regex(R"((^|["'])\s*\$)"), "a command whose name is made up in the script"},
      {outside(), "a file outside of the script's folder"}};
  return rules;
}

void look_through_script(const fs::path& file, Lines& found, std::vector<fs::path>& seen) {
  const fs::path path = file.lexically_normal();
  if (std::count(seen.begin(), seen.end(), path)) return;
  seen.push_back(path);
  static const std::regex condition(R"(^\s*if\s+"[^"]*")");  // numbers and words are compared in it
  static const std::regex other_file(R"(^\s*(include|jump)\s+(\S+))");
  std::ifstream stream(path);
  std::string line;
  bool continued = false;  // by & at the end of the line before
  for (long number = 1; std::getline(stream, line); ++number) {
    line = std::regex_replace(line.substr(0, line.find('#')), condition, "if");
    for (const Rule& rule : script_rules())
      if (!(continued && rule.what == script_rules()[2].what) && std::regex_search(line, rule.found))
        add(found, path, number, rule.what, line);
    continued = !line.empty() && line.back() == '&';
    std::smatch other;
    if (std::regex_search(line, other, other_file) && other[2] != "SELF")
      look_through_script(path.parent_path() / other[2].str(), found, seen);
  }
}

}  // namespace

std::vector<std::string> commands_in_case(const CaseParameters& parameters) {
  Lines found;
  for (const std::string& command : parameters.fluid.prepare)
    if (!is_harmless(command))
      found.push_back(fmt::format("{}: fluid.prepare: a command of the shell: {}", parameters.file,
                                  cut(printable(command), 80)));
  look_through_fluid(beside_case_file(parameters, parameters.fluid.case_folder), found);
  std::vector<fs::path> seen;
  if (parameters.particles)
    look_through_script(beside_case_file(parameters, parameters.particles->script), found, seen);
  return found;
}

void require_no_commands(const CaseParameters& parameters) {
  const Lines found = commands_in_case(parameters);
  if (!found.empty())
    throw InputError(
        fmt::format("--no-commands: the case wants to do more than compute:\n{}", fmt::join(found, "\n")));
}

}  // namespace demvof
