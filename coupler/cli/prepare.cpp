// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/prepare.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <fstream>
#include <regex>
#include <stdexcept>

#include "coupler/cli/child_process.hpp"
#include "coupler/cli/decompose.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

/// A start time other than 0, where controlDict says so: its fields, as they are. True if there are any.
bool copy_start(const fs::path& original, const fs::path& copy) {
  std::ifstream stream(original / "system" / "controlDict");
  const std::string control{std::istreambuf_iterator<char>(stream), {}};
  static const std::regex start("(?:^|\n)\\s*startTime\\s+([^\\s;]+)\\s*;");
  std::smatch found;
  if (!std::regex_search(control, found, start) || found[1] == "0") return false;
  const fs::path fields = original / found[1].str();
  if (!fs::is_directory(fields)) return false;
  fs::copy(fields, copy / found[1].str(), fs::copy_options::recursive | fs::copy_options::skip_existing);
  return true;
}

void copy_case(const fs::path& original, const fs::path& copy) {
  const auto options = fs::copy_options::recursive;
  for (const char* part : {"constant", "system"}) {
    if (!fs::is_directory(original / part))
      throw InputError(fmt::format("{} is no OpenFOAM case: there is no folder {}", original.string(), part));
    fs::create_directories(copy / part);
    fs::copy(original / part, copy / part, options);
  }
  const bool starts_later = copy_start(original, copy);
  // 0.orig holds the fields as the user wrote them, 0 those that an earlier setFields left.
  for (const char* fields : {"0.orig", "0"})
    if (fs::is_directory(original / fields)) return fs::copy(original / fields, copy / "0", options);
  if (starts_later) return;
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
  copy_case(beside_case_file(parameters, parameters.fluid.case_folder), folder.fluid());
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
