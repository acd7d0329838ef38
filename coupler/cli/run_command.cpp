// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "coupler/base/printable.hpp"
#include "coupler/cli/batch_script.hpp"
#include "coupler/cli/child_process.hpp"
#include "coupler/cli/commands.hpp"
#include "coupler/cli/commands_in_case.hpp"
#include "coupler/cli/last_results.hpp"
#include "coupler/cli/launch.hpp"
#include "coupler/cli/prepare.hpp"
#include "coupler/cli/progress_display.hpp"
#include "coupler/cli/redistribute.hpp"
#include "coupler/cli/summary.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

// When a rank has ended badly, s: enough for the others to write what they have, and for a run to be over
// within 10 s of the loss of a side.
constexpr int time_to_write = 6;

fs::path results_file(const RunFolder& folder) {
  return folder.path() / "results.json";
}

std::vector<std::string> program_arguments(const CaseOptions& options, const RunOptions& run,
                                           const RunFolder& folder) {
  std::vector<std::string> arguments = {"--out", folder.path().string()};
  if (run.continues) arguments.push_back("--continue");
  if (run.from) arguments.insert(arguments.end(), {"--from", std::to_string(*run.from)});
  for (const std::string& assignment : options.overrides)
    arguments.insert(arguments.end(), {"--set", assignment});
  return arguments;
}

/// This command line as a job's, without --continue and --force.
BatchJob batch_job(const CaseOptions& options, const RunOptions& run, const CaseParameters& parameters,
                   const RunFolder& folder) {
  BatchJob job;
  job.directory = fs::current_path();
  job.out = folder.path();
  job.ranks = parameters.fluid.ranks + (parameters.particles ? parameters.particles->ranks : 0);
  job.command = {fs::read_symlink("/proc/self/exe").string(), "run", options.case_file, "--out",
                 folder.path().string()};
  for (const std::string& assignment : options.overrides)
    job.command.insert(job.command.end(), {"--set", assignment});
  for (const std::string& word : run.mpirun_words) job.command.push_back("--mpirun-option=" + word);
  if (options.no_commands) job.command.emplace_back("--no-commands");
  if (run.quiet) job.command.emplace_back("--quiet");
  job.slurm_options = run.slurm_options;
  return job;
}

/// What demvof run would refuse is refused now and not when the job has waited for its turn.
int write_job(const CaseOptions& options, const RunOptions& run, const CaseParameters& parameters,
              const RunFolder& folder) {
  const std::string script = batch_script(batch_job(options, run, parameters, folder));
  if (run.print_command) {
    fmt::print("{}", script);
    return 0;
  }
  if (run.continues)
    folder.require_continuable({});
  else if (!folder.ready())
    folder.clear(options.force);
  const fs::path file = batch_script_file(folder.path());
  write_batch_script(file, script);
  if (!run.quiet)
    fmt::print("{} is written; submit it with\n    sbatch {}\n", file.string(), shell_line({file.string()}));
  return 0;
}

/// Tells a file from one that has taken its place.
fs::file_time_type time_of(const fs::path& file) {
  std::error_code none;
  return fs::last_write_time(file, none);
}

/// said_why: the programs have told the user what went wrong.
void print_end(int code, const nlohmann::ordered_json& results, const RunFolder& folder, bool said_why) {
  if (!results.is_object())
    fmt::print("\nThe programs left no {} of this run.\n", results_file(folder).string());
  else
    fmt::print("\n{}", printable_lines(run_summary(results)));
  if (code != 0 && !said_why) fmt::print("{}\n", printable_lines(failure_text(results)));
  fmt::print("\n{}", output_list(folder.path()));
}

}  // namespace

int run_command(CaseOptions options, const RunOptions& run) {
  if (!run.fluid_ranks.empty()) options.overrides.push_back("fluid.ranks=" + run.fluid_ranks);
  if (!run.particle_ranks.empty()) options.overrides.push_back("particles.ranks=" + run.particle_ranks);
  if (run.from && !run.continues)
    throw InputError("demvof run: --from says where to go on; give --continue with it");
  if (run.from && run.slurm)
    throw InputError("demvof run: --slurm: the job goes on from the last state; leave --from out");
  if (!run.slurm_options.empty() && !run.slurm)
    throw InputError("demvof run: --slurm-option is for a job's script; give --slurm with it");
  if (run.continues && options.force)
    throw InputError("demvof run: --continue keeps what is in the folder, --force replaces it; give one");
  const CaseParameters parameters = read_case(options.case_file, options.overrides);
  if (options.no_commands) require_no_commands(parameters);
  const RunFolder folder(parameters, options.out);
  const LaunchCommand command =
      launch_command(parameters, program_arguments(options, run, folder), time_to_write, run.mpirun_words);
  if (run.slurm) return write_job(options, run, parameters, folder);
  if (run.print_command) {
    fmt::print("{}\n", shell_line(command));
    return 0;
  }

  const auto say = [&run](const std::string& what) {
    if (!run.quiet) fmt::print("{}\n", what);
  };
  if (run.continues) {
    const RunFolder::Continuable state = folder.require_continuable(run.from);
    for (const std::string& change : state.changes) say("not as in the run that goes on: " + change);
    if (state.point.frame.fluid_ranks != parameters.fluid.ranks)
      redistribute(parameters, folder, state.point, say);
  } else {
    if (folder.ready()) folder.hold();  // and is it still?
    if (!folder.ready()) prepare_case(parameters, folder, options.force, say);
  }

  folder.hold();
  remove_notes(folder.path());
  ProgressDisplay display(folder.path() / "progress.json", suitable_display(run.quiet));
  Watch watch;
  bool said_something = false;
  watch.on_line = [&](const std::string& line) {
    said_something = true;
    display.print(line);
  };
  watch.on_tick = [&] { display.update(); };
  const auto before = time_of(results_file(folder));
  const End end = launch(command, watch);
  display.finish();

  folder.wait_for_programs(10);  // mpirun may have been killed before them
  if (end.code == 3 || end.code == 4) write_last_results(folder.path(), parameters, command.words, end);
  remove_notes(folder.path());
  // What was there before is the result of the run as it was.
  const bool of_this_run = time_of(results_file(folder)) != before;
  const nlohmann::ordered_json results = of_this_run ? read_results(folder.path()) : nlohmann::ordered_json();
  const int code = confirmed(end, results.is_object() ? results.value("status", "") : "");
  if (run.continues && code == 2) return code;
  if (!run.quiet || code != 0) print_end(code, results, folder, said_something);
  return code;
}

}  // namespace demvof
