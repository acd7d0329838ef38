// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/batch_script.hpp"

#include <fmt/format.h>

#include <fstream>

#include "coupler/base/errors.hpp"
#include "coupler/cli/child_process.hpp"
#include "coupler/cli/slurm_options.hpp"
#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

constexpr const char* first_lines = "#!/bin/bash\n# Written by demvof run --slurm";

std::string without_slash_at_end(const fs::path& folder) {
  const fs::path normal = folder.lexically_normal();
  return normal.has_filename() ? normal.string() : normal.parent_path().string();
}

}  // namespace

fs::path batch_script_file(const fs::path& out) {
  return without_slash_at_end(out) + ".sbatch";
}

std::string batch_script(const BatchJob& job) {
  require_slurm_options(job.slurm_options, job.ranks);
  const std::string out = without_slash_at_end(job.out);
  std::string text = fmt::format("{}: sbatch {}\n", first_lines, shell_line({batch_script_file(out)}));
  text +=
      "# Submit it again, as it is, until the run is at its end: each job goes on from the last state\n"
      "# that the one before has written.\n";
  const auto add = [&text](const std::string& option) { text += "#SBATCH " + option + "\n"; };
  const auto option = [&add](const std::string& name, const std::string& value) {
    add(fmt::format("--{}={}", name, shell_line({value})));
  };
  option("job-name", fs::path(out).filename());
  option("chdir", job.directory);
  option("output", out + ".%j.log");
  option("open-mode", "append");
  option("ntasks", std::to_string(job.ranks));
  add("--requeue");
  text +=
      "# So many seconds before its time is up, demvof run (and nothing else) is told to stop: it ends the\n"
      "# window and writes a state.\n";
  add(fmt::format("--signal=B:TERM@{}", time_to_stop));
  if (!job.slurm_options.empty()) text += "# --slurm-option; the last one of a name counts\n";
  for (const std::string& own : job.slurm_options) add(own);

  const auto run = [&job](const char* how) {
    std::vector<std::string> words = job.command;
    words.emplace_back(how);
    return shell_line(words);
  };
  text += fmt::format(
      "\nif [ -e {} ]; then\n    exec {}\nfi\n"
      "# --force: there may be what a job has left that ended before its first state.\nexec {}\n",
      shell_line({(fs::path(out) / "restart" / "latest.json").string()}), run("--continue"), run("--force"));
  return text;
}

void write_batch_script(const fs::path& file, const std::string& script) {
  std::error_code none;
  if (fs::exists(file, none)) {
    std::ifstream stream(file);
    const std::string there{std::istreambuf_iterator<char>(stream), {}};
    if (there.rfind(first_lines, 0) != 0)
      throw InputError(fmt::format(
          "demvof run --slurm: {} is there, and not of demvof's making; remove it, or choose another --out",
          file.string()));
  }
  write_file_atomically(file, script);
}

}  // namespace demvof
