// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>

#include "coupler/base/errors.hpp"
#include "coupler/base/printable.hpp"
#include "coupler/base/words_of.hpp"
#include "coupler/cli/commands.hpp"
#include "coupler/cli/manual.hpp"
#include "coupler/cli/versions.hpp"
#include "coupler/config/describe.hpp"
#include "coupler/config/nearest.hpp"

namespace {

using namespace demvof;

/// The command line, and what to do about it.
class CommandLine {
 public:
  CommandLine() : app_("three-phase flows: OpenFOAM and LIGGGHTS coupled", "demvof") {
    app_.formatter(std::make_shared<ManualPage>());
    app_.footer(main_manual);
    app_.require_subcommand(1);
    group_options(app_);
    app_.add_flag_callback(
        "--version",
        [] {
          fmt::print("{}", versions());
          throw CLI::Success();
        },
        "Print the versions of demvof and of what it is built from");
    add_new();
    add_check();
    add_prepare();
    add_run();
    add_report();
    add_study();
    add_text("schema", "print the JSON Schema of the case file", schema_manual, case_file_schema);
    add_text("reference", "print the reference of the case file", reference_manual, case_file_reference);
  }

  /// The exit code.
  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& page) {
      return app_.exit(page);
    } catch (const CLI::ParseError& error) {
      throw InputError(
          fmt::format("demvof: {} (see demvof --help)", unknown_command(argc, argv, error.what())));
    }
    return action_();
  }

 private:
  /// CLI11 does not name a mistyped command; other mistakes keep its words.
  std::string unknown_command(int argc, char** argv, const std::string& otherwise) const {
    std::vector<std::string> names;
    for (const CLI::App* command : app_.get_subcommands({})) names.push_back(command->get_name());
    const std::string first = argc > 1 ? argv[1] : "";
    if (first.empty() || first[0] == '-' || std::count(names.begin(), names.end(), first)) return otherwise;
    return fmt::format("{} is no command{}", first, did_you_mean(first, names));
  }
  static void group_options(CLI::App& app) {
    app.option_defaults()->group("OPTIONS");
    app.set_help_flag("--help,-h", "Print this page");
  }
  CLI::App* add(const std::string& name, const std::string& purpose, const char* manual,
                std::function<int()> action) {
    CLI::App* command = app_.add_subcommand(name, purpose);
    command->footer(manual);
    command->group("COMMANDS");
    group_options(*command);
    command->final_callback([this, action = std::move(action)] { action_ = action; });
    return command;
  }
  void add_case(CLI::App* command) {
    command->add_option("CASE", case_.case_file, "The case file (YAML)")->required()->type_name("");
    command
        ->add_option("--set", case_.overrides,
                     "Set a key of the case file, e.g. coupling.window=1e-4; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--no-commands", case_.no_commands,
                      "Refuse a case that executes commands or code: for cases of strangers");
  }
  void add_out(CLI::App* command) {
    command
        ->add_option("--out", case_.out, "Folder for everything written; default: run, beside the case file")
        ->type_name("DIR");
    command->add_flag("--force", case_.force, "Replace what an earlier run left in DIR");
  }

  void add_new() {
    CLI::App* command = add("new", "write a case from an interFoam case and a LIGGGHTS script", new_manual,
                            [this] { return new_command(new_); });
    command->add_option("NAME", new_.name, "Folder of the new case")->required()->type_name("");
    command->add_option("--fluid", new_.fluid, "The interFoam case; it stays as it is")
        ->required()
        ->type_name("CASE");
    command->add_option("--particles", new_.particles, "The LIGGGHTS script; it stays as it is")
        ->required()
        ->type_name("SCRIPT");
  }
  void add_check() {
    add_case(add("check", "check a case on both sides without running it", check_manual,
                 [this] { return check_command(case_); }));
  }
  void add_prepare() {
    CLI::App* command = add("prepare", "make the mesh and fields of the fluid side", prepare_manual,
                            [this] { return prepare_command(case_); });
    add_case(command);
    add_out(command);
  }
  void add_run() {
    CLI::App* command = add("run", "run a case", run_manual, [this] { return run_command(case_, run_); });
    add_case(command);
    add_out(command);
    command->add_option("--fluid-ranks", run_.fluid_ranks, "MPI ranks of foam_side; default: fluid.ranks")
        ->type_name("N");
    command
        ->add_option("--particle-ranks", run_.particle_ranks,
                     "MPI ranks of dem_side; default: particles.ranks")
        ->type_name("N");
    command
        ->add_option(
            "--mpirun-option", run_.mpirun_words,
            "A word for mpirun, e.g. --mpirun-option=--hostfile --mpirun-option=hosts; may be repeated")
        ->type_name("WORD")
        ->allow_extra_args(false);
    command->add_flag("--slurm", run_.slurm,
                      "Write DIR.sbatch, a job for Slurm that does this run, and stop (see SLURM)");
    command
        ->add_option("--slurm-option", run_.slurm_options,
                     "A line of #SBATCH for the job, e.g. --slurm-option=--time=2:00:00; may be repeated")
        ->type_name("OPTION")
        ->allow_extra_args(false);
    command->add_flag("--continue", run_.continues,
                      "Go on with the run in DIR, from the last state that it has left there");
    command
        ->add_option("--from", run_.from, "With --continue: from the state that it has left after N windows")
        ->type_name("N");
    command->add_flag("--print-command", run_.print_command, "Print how the programs are started, and stop");
    command->add_flag("--quiet", run_.quiet, "Print errors only");
  }
  void add_report() {
    CLI::App* command = add("report", "make pictures and tables of runs", report_manual,
                            [this] { return report_command(folders_); });
    command->add_option("DIR", folders_, "Folders of runs")->required()->type_name("");
  }
  void add_study() {
    CLI::App* command = add("study", "error against run time of several runs", study_manual,
                            [this] { return study_command(study_); });
    command->add_option("STUDY", study_.study_file, "The study file (YAML)")->required()->type_name("");
    command->add_option("--out", study_.out, "Folder of the runs; default: run_STUDY, beside the study file")
        ->type_name("DIR");
    command->add_option("--only", study_.only, "Make the runs of this row only; may be repeated")
        ->type_name("ROW")
        ->allow_extra_args(false);
    command->add_flag("--no-runs", study_.no_runs, "Make no run; report on those that are there");
  }
  void add_text(const std::string& name, const std::string& purpose, const char* manual,
                std::string (*text)()) {
    add(name, purpose, manual, [text] {
      fmt::print("{}", text());
      return 0;
    });
  }

  CLI::App app_;
  CaseOptions case_;
  RunOptions run_;
  std::vector<std::string> folders_;
  StudyOptions study_;
  NewOptions new_;
  std::function<int()> action_;
};

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the shell's limit fails, here and in the programs
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // in step with stderr, also in a file
  try {
    return CommandLine().run(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", printable_lines(words_of(error)));
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "demvof: {}\n", printable_lines(words_of(error)));
    return 3;
  }
}
