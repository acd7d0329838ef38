// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/manual.hpp"

#include <CLI/App.hpp>
#include <sstream>

namespace demvof {

ManualPage::ManualPage() {
  column_width(34);
  label("Positionals", "ARGUMENTS");
  label("REQUIRED", "");
}

std::string ManualPage::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
  const std::string full_name = name.empty() ? app->get_name() : name;
  std::ostringstream page;
  page << "NAME\n    " << full_name << " - " << app->get_description() << "\n\nSYNOPSIS\n    " << full_name;
  if (!app->get_subcommands({}).empty()) page << " COMMAND";
  for (const CLI::Option* option : app->get_options([](const CLI::Option* o) { return o->get_positional(); }))
    page << ' ' << option->get_name(true) << (option->get_expected_max() > 1 ? "..." : "");
  page << " [OPTIONS]\n" << make_positionals(app);
  for (const std::string& group : app->get_groups()) {
    const auto options = app->get_options(
        [&group](const CLI::Option* o) { return o->get_group() == group && o->nonpositional(); });
    if (!group.empty() && !options.empty()) page << make_group(group, false, options);
  }
  const auto commands = app->get_subcommands({});
  if (!commands.empty()) page << "\nCOMMANDS\n";
  for (const CLI::App* command : commands) page << "  " << make_subcommand(command);
  page << '\n' << app->get_footer();
  return page.str();
}

std::string ManualPage::make_group(std::string group, bool is_positional,
                                   std::vector<const CLI::Option*> options) const {
  std::ostringstream text;
  text << '\n' << group << '\n';
  for (const CLI::Option* option : options) text << "  " << make_option(option, is_positional);
  return text.str();
}

const char* const main_manual = R"(DESCRIPTION
    demvof couples OpenFOAM (two fluids, volume of fluid) with LIGGGHTS (particles). One YAML case file
    describes a run; `demvof COMMAND --help` tells about each command, docs/case_file.md about each key.

EXIT STATUS
    0   done
    2   the input is wrong; the message names file, line, key, value and what is allowed
    3   the run failed or was interrupted; the message names side, stage and time
    4   one side lost the other

EXAMPLES
    demvof new tank --fluid damBreak --particles in.beads
    demvof check case.yaml
    demvof run case.yaml --out runs/a --set coupling.window=1e-4
    demvof report runs/a
)";

const char* const new_manual = R"(DESCRIPTION
    Makes the folder NAME with a commented case.yaml, a copy of the interFoam case and one of the script with the
    files that it names, and checks the case as `demvof check` does. Each number in case.yaml is a proposal,
    with its reason beside it:

    bulk_grid       the mesh's box, in cells of 3 diameters of the largest particle
    window          no longer than the fluid's step may be at the start, and than a tenth of the time in which
                    something that fell through the box crosses a bulk cell; whole steps of the script
    forces          drag, of a law that knows the bed where there is one; the pressure gradient; added mass
                    where particles are lighter than the liquid
    end_time, interval   controlDict's endTime and writeInterval, in whole windows
    prepare         the commands of the case's Allrun that make mesh and fields, or what its dictionaries ask for

    In the script's copy the last `run` is taken out (the coupled run starts where the script ends), and
    `processors`, `fix couple/cfd` and `fix buoyancy`, which the coupling replaces; it says each line.
    It runs the script and the commands of the case: docs/security.md for cases of strangers.

FILES
    NAME/case.yaml      the case file
    NAME/fluid          constant, system and 0.orig (or 0) of the interFoam case
    NAME/particles      the script and its files

EXIT STATUS
    0 the new case is ready to run, 2 it is written but something is left to do (it says what), or the input
    is wrong, 3 a program failed, 4 one side lost the other

EXAMPLES
    demvof new tank --fluid $FOAM_RUN/damBreak --particles in.beads
    demvof run tank/case.yaml
)";

const char* const check_manual = R"(DESCRIPTION
    Checks every key of the case file, then starts both programs on a copy of the case in a temporary
    folder, lets them read their cases and agree, tries the fluid's first time step without particles, so
    that a scheme, solver or source that the case lacks is found now, and stops. Prints what the run would
    have switched on, what it leaves out and why, and the numbers it found: time steps per window, cells,
    particles. The case's folder is left as it is.

    It executes what the case says (fluid.prepare, shell commands of the script ...): see --no-commands, and
    docs/security.md for cases of strangers.

EXIT STATUS
    0 the case is ready to run, 2 the input is wrong, 3 a program failed, 4 one side lost the other

EXAMPLES
    demvof check case.yaml
    demvof check case.yaml --set coupling.averaging.kernel=linear
)";

const char* const prepare_manual = R"(DESCRIPTION
    Copies the OpenFOAM case (constant, system, and 0.orig or 0) to DIR/fluid, runs the commands of
    fluid.prepare there and decomposes the mesh for several fluid ranks: as system/decomposeParDict says, in
    the proportions of its cut where that is for another number of ranks, with method simple along the mesh's
    longest side where there is no dictionary or its method is a stub. It says what it changes. The original is
    left as it is.
    `demvof run` does this by itself; use it to look at mesh and fields before a run, or before
    starting the two programs by hand.

FILES
    DIR/fluid           the prepared case
    DIR/prepare.log     what the commands printed
    DIR/prepared.json   what it was prepared from

EXIT STATUS
    0 done, 2 the input is wrong or a command failed

EXAMPLES
    demvof prepare case.yaml --out runs/a
)";

const char* const run_manual = R"(DESCRIPTION
    Prepares the fluid case if that is not done yet, starts foam_side and dem_side in one mpirun (through
    demvof_pair, which becomes the one or the other on each rank), shows how far they are, and prints a
    table of the results. Standard output gets a progress bar on a terminal, and a line per tenth of the run
    elsewhere. Without particles foam_side runs alone.

    Ctrl-C (or SIGTERM) stops the run at the end of the window, with everything written; a second one
    ends it at once.

    A run that stopped, or has reached its end, can be continued: with --continue it goes on from the last
    state in DIR/restart, which is written with each field output (output.interval) and at the end; with
    --from N from the one after N windows, if it is still there. A state with a damaged file is refused. Settings
    may change, coupling.end_time for one; the fluid case, its ranks, bulk_grid and coupling.window may not.
    The particle script has to allow it (docs/howto_your_own_case.md).

SLURM
    --slurm writes DIR.sbatch, a job with as many tasks as the run has ranks, and says how to submit it. In it
    `demvof run` starts the programs by mpirun, which knows the job's nodes. --slurm-option adds lines of #SBATCH
    (--time, --partition, --nodes ...; the last one of a name counts). Refused are those that take from the job
    what it needs: fewer --ntasks, another --signal than TERM to the batch script, --array, --chdir, a --time
    that is over before the signal.

    The job begins the run in DIR, or goes on with it from its last state. After a job that met its time limit, or
    was cancelled, submit the same file again; `sbatch --dependency=singleton DIR.sbatch`, several times, is a
    row of such jobs. Who finds the run at its end says so and ends with code 2. A job that Slurm puts back
    into the queue goes on, too.

    120 s before its time limit the run is told to stop at the end of the window, with a state, and the job ends
    with code 3. Where this is too short for a window and for writing: --slurm-option=--signal=B:TERM@600. The same
    by hand is `scancel --batch --signal=TERM JOB`. A plain scancel leaves the window some 6 s.

FILES
    DIR.sbatch          the job (--slurm); DIR.JOB.log is what it prints
    DIR/results.json    everything about the run; DIR/earlier has those of the parts that were continued
    DIR/history.csv     recorded quantities against time
    DIR/fluid           OpenFOAM time folders
    DIR/particles, DIR/bulk   series for ParaView
    DIR/fluid.log, DIR/particles.log   what OpenFOAM and LIGGGHTS printed

ENVIRONMENT
    WM_PROJECT_DIR      of a sourced OpenFOAM environment is respected

EXIT STATUS
    0 done, 2 the input is wrong, 3 failed or interrupted, 4 one side lost the other

EXAMPLES
    demvof run case.yaml
    demvof run case.yaml --fluid-ranks 2 --set coupling.window=1e-4 --out runs/small_window
    demvof run case.yaml --print-command
    demvof run case.yaml --mpirun-option=--hostfile --mpirun-option=hosts
    demvof run case.yaml --continue --set coupling.end_time=2
    demvof run case.yaml --slurm --out runs/a --slurm-option=--time=12:00:00 --slurm-option=--partition=long
)";

const char* const report_manual = R"(DESCRIPTION
    Writes report.html (pictures and tables, one self-contained file) into the run's folder. Several
    folders are compared in one report, in the first folder.

EXIT STATUS
    0 done, 2 a folder is not that of a run, 3 the report could not be made

EXAMPLES
    demvof report runs/a
    demvof report runs/single_scale runs/multiscale
)";

const char* const study_manual = R"(DESCRIPTION
    Makes the runs that a study file lists, one after the other, and reports their errors against a
    reference beside their run times: a table, pictures, and what a multiscale run costs beside the
    cheapest single-scale run that is as good. A finished run is not repeated: a study that was
    interrupted goes on with the same command. A run that fails is a row that says so.

STUDY FILE
    case: case.yaml                 the case, counted from the study file's folder
    set: {coupling.end_time: 0.1}   settings of every run
    quantities: [kinetic_energy]    columns of history.csv whose errors are measured
    reference: {row: finest}        or {exact: {mean_level: 0.30982}}
                                    or {file: points.csv, quantity: liquid_front, time: t, value: x};
                                    also time_scale, value_scale, value_shift:
                                    value_scale * (value + value_shift) at time_scale * time
    repeat: 3                       runs per row; the median of their wall times counts
    rows:
      coarse: {single_scale: yes, set: {bulk_grid.cells: [40, 20, 60]}}
      multi: {converged_in_time: multi_in_time}   which part of the error is the time's: the difference
                                    to another row, the same mesh with short windows and steps
      finest: {set: {...}}
    sweep: {coupling.window: [5e-4, 2e-4]}   further rows, one for each combination

FILES
    DIR/study.json      rows with wall time, memory, errors; sentences
    DIR/study.html      the same with pictures, one self-contained file
    DIR/ROW/run         each row's run, as of demvof run

EXIT STATUS
    0 every row is done, 2 the study file is wrong, 3 a row failed or the study was interrupted

EXAMPLES
    demvof study study.yaml
    demvof study study.yaml --only adaptive
    demvof study study.yaml --no-runs
)";

const char* const schema_manual = R"(DESCRIPTION
    Prints the JSON Schema of the case file; editors that know it complete and check case files.

EXAMPLES
    demvof schema > docs/case_file.schema.json
)";

const char* const reference_manual = R"(DESCRIPTION
    Prints the reference of the case file in Markdown: every key with its values, default and meaning.

EXAMPLES
    demvof reference > docs/case_file.md
)";

}  // namespace demvof
