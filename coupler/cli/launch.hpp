// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"

namespace demvof {

/// How the programs of a run are started.
struct LaunchCommand {
  std::vector<std::string> words;
  std::map<std::string, std::string> environment;  // set unless the user's environment has it
  bool pair = false;                               // two programs in one mpirun
  std::vector<std::string> programs;               // names of those that mpirun starts
};

/// mpirun with foam_side and, with particles, dem_side through demvof_pair, all from the folder of this
/// program; one foam_side rank alone is started without mpirun. arguments: given to both, after the case
/// file; time_to_write: that ranks have when another has ended badly, s; mpirun_words: the user's own options
/// of mpirun. Throws std::runtime_error when a program is not there, InputError when there are options for an
/// mpirun that is not needed.
LaunchCommand launch_command(const CaseParameters& parameters, const std::vector<std::string>& arguments,
                             int time_to_write, const std::vector<std::string>& mpirun_words = {});

/// As a user would type it, environment included.
std::string shell_line(const LaunchCommand& command);

struct Watch {
  std::function<void(const std::string&)> on_line;  // each line that the programs print
  std::function<void()> on_tick;                    // about four times a second
};

struct End {
  int code;                      // 0, 2, 3 or 4 (README)
  bool user_asked;               // for it
  std::string mpirun_said = {};  // about the programs' end, when they said nothing
};

/// Starts the programs and waits for their end. The first Ctrl-C, SIGTERM or hang-up of the terminal
/// asks them to stop at the end of the window, the second ends them.
End launch(const LaunchCommand& command, const Watch& watch);

/// The run's exit code from that of mpirun, or of a program alone.
int run_exit_code(int code, bool pair, bool ended_by_user);

/// The exit code of a run whose results.json has this status: mpirun's word and results.json have to agree
/// before a run counts as done. A stop that the user asked for when all was done may have met mpirun in its
/// end.
int confirmed(const End& end, const std::string& status);

/// What to say when mpirun itself was killed by a signal, or ended badly before the programs said a word;
/// empty otherwise. said_something: they, or mpirun of itself.
std::string end_of_mpirun(const LaunchCommand& command, int code, int killed_by, bool said_something);

}  // namespace demvof
