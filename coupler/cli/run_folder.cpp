// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "coupler/base/printable.hpp"
#include "coupler/cli/last_results.hpp"
#include "coupler/cli/redistribute.hpp"
#include "coupler/config/read_case.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/output/state_frame.hpp"
#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

constexpr auto marker = "prepared.json";  // written last by a preparation
// Everything that prepare, run and report write, and nothing else is ever removed.
constexpr const char* outputs[] = {
    "fluid",       "particles",     "surfaces",    "bulk",         "fluid.log",     "prepare.log",
    marker,        "particles.log", "history.csv", "results.json", "progress.json", "report.html",
    "results.csv", "restart",       "earlier",     "fluid.part",   "fluid.new"};
constexpr const char* result_files[] = {"results.json", "history.csv", "progress.json"};

std::string read_text(const fs::path& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

fs::file_time_type last_change(const fs::path& folder) {
  fs::file_time_type latest = fs::file_time_type::min();
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) latest = std::max(latest, entry.last_write_time());
  return latest;
}

/// inner is outer, or lies inside it.
bool inside(const fs::path& inner, const fs::path& outer) {
  const fs::path relative = fs::weakly_canonical(inner).lexically_relative(fs::weakly_canonical(outer));
  return !relative.empty() && *relative.begin() != "..";
}

/// Holds nothing but what a run leaves that did not even start.
bool holds_nothing(const fs::path& folder) {
  const fs::directory_iterator all(folder);
  return std::all_of(begin(all), end(all),
                     [](const fs::directory_entry& entry) { return entry.path().filename() == lock_file; });
}

}  // namespace

RunFolder::RunFolder(const CaseParameters& parameters, const fs::path& path)
    : parameters_(parameters), path_(path.empty() ? beside_case_file(parameters, "run") : path) {}

bool RunFolder::has_results() const {
  return std::any_of(std::begin(result_files), std::end(result_files),
                     [&](const char* file) { return fs::exists(path_ / file); });
}

std::string RunFolder::preparation(int ranks) const {
  const FluidParameters& fluid = parameters_.fluid;
  const fs::path original = fs::weakly_canonical(beside_case_file(parameters_, fluid.case_folder));
  return nlohmann::ordered_json{{"case", original.string()}, {"ranks", ranks}, {"prepare", fluid.prepare}}
             .dump(2) +
         "\n";
}

bool RunFolder::ready() const {
  const fs::path mark = path_ / marker;
  return fs::exists(mark) && !has_results() && read_text(mark) == preparation(parameters_.fluid.ranks) &&
         last_change(beside_case_file(parameters_, parameters_.fluid.case_folder)) <=
             fs::last_write_time(mark);
}

RunFolder::Continuable RunFolder::require_continuable(std::optional<long> from) const {
  if (fs::exists(path_ / "restart")) hold();
  constexpr int any_ranks = 0;
  const RestartPoint point =
      read_restart_point(path_, from, state_frame(parameters_, any_ranks), parameters_.coupling.end_time);
  settle_division(path_, point);
  const int ranks = point.frame.fluid_ranks;
  const std::string prepared = read_text(path_ / marker);
  if (prepared != preparation(ranks) && prepared != preparation(parameters_.fluid.ranks))
    throw InputError(
        fmt::format("--continue: the run in {} is of another fluid case (fluid.case or "
                    "fluid.prepare differ); start a new run with another --out",
                    path_.string()));
  if (ranks != parameters_.fluid.ranks && fs::exists(fluid() / "constant" / "dynamicMeshDict"))
    throw InputError(
        fmt::format("--continue: fluid.ranks was {} in the run in {}; on a mesh that changes "
                    "it has to stay",
                    ranks, path_.string()));
  require_whole(path_, point, [](const std::string&) { return true; });
  std::vector<std::string> changes = changed_keys(point.configuration, resolved_configuration(parameters_));
  changes.erase(
      std::remove_if(changes.begin(), changes.end(),
                     [](const std::string& line) { return line.rfind("coupling.end_time:", 0) == 0; }),
      changes.end());
  if (point.written_by != version())
    changes.insert(changes.begin(), fmt::format("demvof: {}, now {}", point.written_by, version()));
  if (last_change(beside_case_file(parameters_, parameters_.fluid.case_folder)) >
      fs::last_write_time(path_ / marker))
    changes.push_back(
        fmt::format("fluid.case: files have changed; the run keeps its copy, {}", fluid().string()));
  const fs::path script =
      parameters_.particles ? beside_case_file(parameters_, parameters_.particles->script) : "";
  if (fs::exists(script) &&
      fs::last_write_time(script) > fs::last_write_time(restart_folder(path_, point.window)))
    changes.push_back(fmt::format("particles.script: {} has changed", script.string()));
  return {point, changes};
}

void RunFolder::clear(bool force) const {
  std::vector<fs::path> inputs = {parameters_.file,
                                  beside_case_file(parameters_, parameters_.fluid.case_folder)};
  if (parameters_.particles) inputs.push_back(beside_case_file(parameters_, parameters_.particles->script));
  for (const fs::path& input : inputs)
    if (inside(input, path_) || inside(path_, input))
      throw InputError(fmt::format("--out {}: the case's own {} is there; choose another --out",
                                   path_.string(), input.string()));
  if (fs::exists(path_) && !fs::is_directory(path_))
    throw InputError(
        fmt::format("--out {}: there is a file of that name; choose another --out", path_.string()));
  // Whose folder it is comes before what is in it: a run that has just begun there has little to show.
  if (!fs::exists(path_) || holds_nothing(path_) || fs::exists(path_ / lock_file)) hold();
  if (!holds_nothing(path_)) {
    const bool of_a_run = has_results() || fs::exists(prepare_log()) || fs::exists(path_ / marker);
    if (!of_a_run)
      throw InputError(
          fmt::format("--out {}: the folder holds something that is no earlier run; choose another --out",
                      path_.string()));
    // A preparation that failed half-way holds nothing of value; everything else needs the user's word.
    const bool valuable = has_results() || fs::exists(path_ / marker);
    if (valuable && !force)
      throw InputError(fmt::format(
          "--out {}: the folder holds {}; give --force to replace it, or another --out", path_.string(),
          has_results() ? "the results of an earlier run"
                        : "another preparation, or one older than the case"));
    hold();
    for (const char* output : outputs) fs::remove_all(path_ / output);
    remove_notes(path_);
  }
  hold();
}

void RunFolder::require_name() const {
  // OpenFOAM drops blanks and quotes from names of files, LIGGGHTS puts numbers in the place of * and %.
  const std::string name = fs::absolute(path_).lexically_normal().string();
  const auto unfit = [](char c) {
    return static_cast<unsigned char>(c) <= ' ' || c == 0x7f || std::strchr("\"'`\\;*%${}", c) != nullptr;
  };
  if (const auto at = std::find_if(name.begin(), name.end(), unfit); at != name.end())
    throw InputError(
        fmt::format("--out {}: OpenFOAM and LIGGGHTS take no folder with '{}' in its path; choose "
                    "another --out",
                    printable(name), printable({*at})));
}

void RunFolder::hold() const {
  if (lock_) return;
  require_name();
  std::error_code error;
  fs::create_directories(path_, error);
  if (error)
    throw InputError(fmt::format("--out {}: the folder cannot be made: {}", path_.string(), error.message()));
  if (faccessat(AT_FDCWD, path_.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    throw InputError(fmt::format("--out {}: nothing can be written to the folder: {}", path_.string(),
                                 std::strerror(errno)));
  lock_.emplace(path_, RunLock::Part::command);
}

void RunFolder::wait_for_programs(double seconds) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (lock_ && lock_->other_holder() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

void RunFolder::mark_ready() const {
  write_file_atomically(path_ / marker, preparation(parameters_.fluid.ranks));
}

}  // namespace demvof
