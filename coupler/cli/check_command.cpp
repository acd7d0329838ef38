// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "coupler/base/errors.hpp"
#include "coupler/cli/commands.hpp"
#include "coupler/cli/commands_in_case.hpp"
#include "coupler/cli/launch.hpp"
#include "coupler/cli/prepare.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

/// A folder of its own that goes with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "demvof-check-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder " + name);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// What is said of the copy, which is gone when it is read, said of the files that it was made of.
class OfTheUser {
 public:
  OfTheUser(const CaseParameters& parameters, const RunFolder& folder)
      : fluid_(beside_case_file(parameters, parameters.fluid.case_folder)), folder_(folder) {}

  std::string operator()(const std::string& text) const {
    const std::string copy = folder_.fluid().string(), own = fluid_.string();
    std::string said = text;
    if (fs::is_directory(fluid_ / "0.orig")) said = with_replaced(said, copy + "/0/", own + "/0.orig/");
    said = with_replaced(said, copy, own);
    return with_replaced(said, folder_.path().string(), "<run>");
  }

 private:
  fs::path fluid_;
  const RunFolder& folder_;
};

/// Says once that reading goes on and on. Only its author knows whether a script settles a bed or jumps for
/// ever: both use the processor, and nothing is ended that does.
class LongReading {
 public:
  explicit LongReading(fs::path log) : log_(std::move(log)) {}
  void look() {
    using Seconds = std::chrono::duration<double>;
    constexpr Seconds patience{30};
    if (said_ || Seconds(std::chrono::steady_clock::now() - begin_) < patience) return;
    said_ = true;
    fmt::print(
        "after {:g} s the case is still being read. A script that settles a bed takes its time, and one that "
        "loops for ever (jump, next) does not end; what it prints is in {}. Ctrl-C ends the check.\n",
        patience.count(), log_.string());
    std::fflush(stdout);
  }

 private:
  fs::path log_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool said_ = false;
};

void say_where_it_cannot_run(const CaseParameters& parameters) {
  try {
    RunFolder(parameters, {}).require_name();
  } catch (const InputError& error) {
    fmt::print("beware: beside the case file `demvof run` has no folder to run in: {}\n", error.what());
  }
}

}  // namespace

int check_command(const CaseOptions& options) {
  const CaseParameters parameters = read_case(options.case_file, options.overrides);
  if (options.no_commands) require_no_commands(parameters);
  fmt::print("{}: every key is in order (configuration {}).\n", options.case_file,
             configuration_hash(parameters));

  const TemporaryFolder temporary;
  const RunFolder folder(parameters, temporary.path() / "run");
  std::vector<std::string> arguments = {"--check", "--out", folder.path().string()};
  for (const std::string& assignment : options.overrides)
    arguments.insert(arguments.end(), {"--set", assignment});
  const LaunchCommand command = launch_command(parameters, arguments, 0);  // nothing to write
  const OfTheUser of_the_user(parameters, folder);
  const auto say = [&of_the_user](const std::string& what) { fmt::print("{}\n", of_the_user(what)); };
  try {
    prepare_case(parameters, folder, false, say);
  } catch (const InputError& error) {
    throw InputError(of_the_user(error.what()));
  }

  Watch watch;
  watch.on_line = say;
  LongReading reading(folder.path() / "particles.log");
  watch.on_tick = [&reading] { reading.look(); };
  const int code = launch(command, watch).code;
  if (code == 0) say_where_it_cannot_run(parameters);
  fmt::print("{}\n", code == 0 ? "The case is ready to run." : "The case cannot run as it is.");
  return code;
}

}  // namespace demvof
