// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "coupler/config/read_case.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

constexpr auto marker = "prepared.json";  // written last by a preparation
// Everything that prepare, run and report write, and nothing else is ever removed.
constexpr const char* outputs[] = {
    "fluid",       "particles",    "bulk",          "fluid.log",   "prepare.log", marker,    "particles.log",
    "history.csv", "results.json", "progress.json", "report.html", "results.csv", "restart", "earlier"};
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

}  // namespace

RunFolder::RunFolder(const CaseParameters& parameters, const fs::path& path)
    : parameters_(parameters), path_(path.empty() ? beside_case_file(parameters, "run") : path) {}

bool RunFolder::has_results() const {
  return std::any_of(std::begin(result_files), std::end(result_files),
                     [&](const char* file) { return fs::exists(path_ / file); });
}

std::string RunFolder::preparation() const {
  const FluidParameters& fluid = parameters_.fluid;
  const fs::path original = fs::weakly_canonical(beside_case_file(parameters_, fluid.case_folder));
  return nlohmann::ordered_json{
             {"case", original.string()}, {"ranks", fluid.ranks}, {"prepare", fluid.prepare}}
             .dump(2) +
         "\n";
}

bool RunFolder::ready() const {
  const fs::path mark = path_ / marker;
  return fs::exists(mark) && !has_results() && read_text(mark) == preparation() &&
         last_change(beside_case_file(parameters_, parameters_.fluid.case_folder)) <=
             fs::last_write_time(mark);
}

void RunFolder::require_continuable() const {
  read_restart_point(path_, parameters_);
  if (read_text(path_ / marker) != preparation())
    throw InputError(
        fmt::format("--continue: the run in {} is of another fluid case (fluid.case, fluid.ranks or "
                    "fluid.prepare differ); start a new run with another --out",
                    path_.string()));
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
  if (fs::exists(path_) && !fs::is_empty(path_)) {
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
    for (const char* output : outputs) fs::remove_all(path_ / output);
  }
  fs::create_directories(path_);
}

void RunFolder::mark_ready() const {
  write_file_atomically(path_ / marker, preparation());
}

}  // namespace demvof
