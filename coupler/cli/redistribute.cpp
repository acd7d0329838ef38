// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/redistribute.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdio.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "coupler/cli/decompose.hpp"
#include "coupler/cli/prepare.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

// Beside <run>/fluid: what is being made, and what is complete and changes places with it.
fs::path unfinished(const fs::path& run) {
  return run / "fluid.part";
}
fs::path other(const fs::path& run) {
  return run / "fluid.new";
}

bool of_fluid(const std::string& name) {
  return name.rfind("fluid/", 0) == 0;
}

/// In one step: a run killed at any moment has both.
void change_places(const fs::path& a, const fs::path& b) {
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) != 0)
    throw std::runtime_error(
        fmt::format("cannot exchange {} and {}: {}", a.string(), b.string(), std::strerror(errno)));
}

void keep_other(const fs::path& run) {
  fs::path kept;
  for (int number = 1; kept.empty() || fs::exists(kept); ++number)
    kept = run / "earlier" / fmt::format("fluid_{}", number);
  fs::create_directories(kept.parent_path());
  fs::rename(other(run), kept);
}

/// The case's first time, from which it is read before it goes on, and that of the state.
std::vector<std::string> times(const fs::path& with_times, const RestartPoint& point) {
  std::string first = point.fluid_time;
  for (const auto& entry : fs::directory_iterator(with_times)) {
    const std::string name = entry.path().filename().string();
    char* end = nullptr;
    if (const double time = std::strtod(name.c_str(), &end);
        entry.is_directory() && *end == '\0' && time < std::strtod(first.c_str(), nullptr))
      first = name;
  }
  return first == point.fluid_time ? std::vector{first} : std::vector{first, point.fluid_time};
}

std::string part_of_rank(int rank) {
  return fmt::format("processor{}", rank);
}

/// The case without its parts, and the fields at these times: whole.
void gather(const fs::path& fluid, const fs::path& made, int ranks, const std::vector<std::string>& at,
            const RunLogged& run) {
  const auto all = fs::copy_options::recursive;
  for (const char* folder : {"system", "constant"}) fs::copy(fluid / folder, made / folder, all);
  // With all digits, whatever the case says.
  run("foamDictionary -entry writeFormat -set binary system/controlDict");
  if (ranks == 1) {
    for (const std::string& time : at) fs::copy(fluid / time, made / time, all);
    return;
  }
  for (int rank = 0; rank < ranks; ++rank)
    fs::create_directory_symlink(fs::absolute(fluid / part_of_rank(rank)), made / part_of_rank(rank));
  run(fmt::format("reconstructPar -withZero -time {}", fmt::join(at, ",")));
  for (int rank = 0; rank < ranks; ++rank) fs::remove(made / part_of_rank(rank));
}

}  // namespace

void redistribute(const CaseParameters& parameters, const RunFolder& folder, const RestartPoint& point,
                  const std::function<void(const std::string&)>& say) {
  const fs::path run_folder = folder.path(), made = unfinished(run_folder);
  const int ranks = parameters.fluid.ranks;
  say(fmt::format("dividing the state for {} in place of {} fluid ranks", ranks, point.frame.fluid_ranks));
  fs::remove_all(made);
  fs::create_directories(made);
  const auto run = [&](const std::string& command) { run_logged(command, made, folder.prepare_log()); };
  const int before = point.frame.fluid_ranks;
  const std::vector<std::string> at =
      times(before > 1 ? folder.fluid() / part_of_rank(0) : folder.fluid(), point);
  gather(folder.fluid(), made, before, at, run);
  if (ranks > 1) {
    decompose(made, ranks, fmt::format("decomposePar -force -copyUniform -time {}", fmt::join(at, ",")), run,
              say);
    for (const std::string& time : at) fs::remove_all(made / time);
  }
  fs::copy_file(folder.fluid() / "system" / "controlDict", made / "system" / "controlDict",
                fs::copy_options::overwrite_existing);

  RestartPoint divided = point;
  divided.frame.fluid_ranks = ranks;
  for (auto file = divided.files.begin(); file != divided.files.end();)
    file = of_fluid(file->first) ? divided.files.erase(file) : std::next(file);
  StateFiles fields;
  for (int rank = 0; rank < ranks; ++rank) {
    const fs::path part = ranks > 1 ? made / part_of_rank(rank) : made;
    for (const fs::path& folder : {part / point.fluid_time, part / "constant" / "polyMesh"})
      add_state_folder(fields, made, folder);
  }
  for (const auto& [name, facts] : fields) divided.files["fluid/" + name] = facts;

  fs::rename(made, other(run_folder));
  change_places(other(run_folder), folder.fluid());
  write_restart_point(run_folder, divided, 1);
  folder.mark_ready();
  keep_other(run_folder);
}

void settle_division(const fs::path& run, const RestartPoint& point) {
  fs::remove_all(unfinished(run));
  if (!fs::exists(other(run))) return;
  if (!find_damage(point.files, run, of_fluid).empty()) change_places(other(run), run / "fluid");
  keep_other(run);
}

}  // namespace demvof
