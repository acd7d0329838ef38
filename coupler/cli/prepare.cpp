// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/prepare.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <stdexcept>

#include "coupler/cli/child_process.hpp"
#include "coupler/cli/decompose.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

/// The value of a keyword that stands at the begin of a line; empty where there is none.
std::string entry(const std::string& dictionary, const std::string& keyword) {
  std::smatch found;
  return std::regex_search(dictionary, found, std::regex("(?:^|\n)\\s*" + keyword + "\\s+([^\\s;]+)\\s*;"))
             ? found[1].str()
             : "";
}

std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' ? std::optional(value) : std::nullopt;
}

/// The folder of fields that the case starts from, as OpenFOAM finds it by its controlDict; empty where that
/// is time 0, or there is no such folder.
std::string later_start(const fs::path& original) {
  std::ifstream stream(original / "system" / "controlDict");
  const std::string control{std::istreambuf_iterator<char>(stream), {}};
  std::map<double, std::string> folders;
  for (const fs::directory_entry& file : fs::directory_iterator(original))
    if (const auto time = number(file.path().filename().string()); time && file.is_directory())
      folders.emplace(*time, file.path().filename().string());
  if (fs::is_directory(original / "0.orig")) folders.emplace(0, "0");
  if (folders.empty()) return "";
  const std::string from = entry(control, "startFrom");
  auto start =
      from == "firstTime" ? folders.begin() : std::prev(folders.end());  // OpenFOAM's default: the latest
  if (from == "startTime") start = folders.find(number(entry(control, "startTime")).value_or(0));
  return start == folders.end() || start->first == 0 ? "" : start->second;
}

/// Returned: the folder of the start, where that is later than at 0.
std::string copy_case(const fs::path& original, const fs::path& copy) {
  const auto options = fs::copy_options::recursive;
  for (const char* part : {"constant", "system"}) {
    if (!fs::is_directory(original / part))
      throw InputError(fmt::format("{} is no OpenFOAM case: there is no folder {}", original.string(), part));
    fs::create_directories(copy / part);
    fs::copy(original / part, copy / part, options);
  }
  const std::string start = later_start(original);
  if (!start.empty()) fs::copy(original / start, copy / start, options);
  // 0.orig holds the fields as the user wrote them, 0 those that an earlier setFields left.
  for (const char* fields : {"0.orig", "0"})
    if (fs::is_directory(original / fields)) {
      fs::copy(original / fields, copy / "0", options);
      return start;
    }
  if (!start.empty()) return start;
  throw InputError(fmt::format("{} is no OpenFOAM case: there is neither 0 nor 0.orig", original.string()));
}

std::string last_lines(const fs::path& log, std::size_t count) {
  std::ifstream stream(log);
  std::deque<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty()) continue;
    lines.push_back(line);
    if (lines.size() > count) lines.pop_front();
  }
  std::string text;
  for (const std::string& line : lines) text += "\n    " + line;
  return text;
}

}  // namespace

void run_logged(const std::string& command, const fs::path& where, const fs::path& log) {
  std::ofstream(log, std::ios::app) << "\n$ " << command << std::endl;
  const int file = open(log.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0)
    throw std::runtime_error(fmt::format("cannot write {}: {}", log.string(), std::strerror(errno)));
  ChildOptions options;
  options.directory = where;
  options.environment = foam_environment();
  options.output = file;
  const int code = ChildProcess({"/bin/sh", "-c", command}, options).wait();
  close(file);
  if (code != 0)
    throw InputError(fmt::format("{} failed (exit code {}) in {}; the end of {}:{}", command, code,
                                 where.string(), log.string(), last_lines(log, 12)));
}

std::map<std::string, std::string> foam_environment() {
  return {{"WM_PROJECT_DIR", DEMVOF_FOAM_PROJECT_DIR}};
}

void prepare_case(const CaseParameters& parameters, const RunFolder& folder, bool force,
                  const std::function<void(const std::string&)>& say) {
  folder.clear(force);
  std::ofstream(folder.prepare_log()) << "demvof prepare " << parameters.file << std::endl;
  const std::string start =
      copy_case(beside_case_file(parameters, parameters.fluid.case_folder), folder.fluid());
  if (!start.empty())
    say("preparing the fluid case: it starts at time " + start + ", as its controlDict says");
  const auto run = [&](const std::string& command) {
    run_logged(command, folder.fluid(), folder.prepare_log());
  };
  for (const std::string& command : parameters.fluid.prepare) {
    say("preparing the fluid case: " + command);
    run(command);
  }
  if (parameters.fluid.ranks > 1) {
    say(fmt::format("preparing the fluid case: decomposePar for {} ranks", parameters.fluid.ranks));
    decompose(folder.fluid(), parameters.fluid.ranks, "decomposePar -force", run, say);
  }
  folder.mark_ready();
}

}  // namespace demvof
