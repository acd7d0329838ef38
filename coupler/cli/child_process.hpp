// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace demvof {

struct ChildOptions {
  std::filesystem::path directory;                 // to run in; empty: here
  std::map<std::string, std::string> environment;  // set unless the user's environment has it
  int output = -1;             // file descriptor for stdout and stderr; -1: this program's
  bool silent_errors = false;  // with an output: stderr goes nowhere
  bool own_group = false;      // Ctrl-C on the terminal does not reach it
};

/// One program started by this one. It reads nothing from the terminal, and is terminated when this program
/// dies.
class ChildProcess {
 public:
  /// command: program (looked up in PATH) and arguments. Throws std::runtime_error when it cannot start.
  ChildProcess(const std::vector<std::string>& command, const ChildOptions& options = {});
  /// Terminates the program if it still runs, and waits for it.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void send_signal(int number) const;
  /// The exit code once it has ended (128 + number for a signal, as a shell says it).
  std::optional<int> poll();
  int wait();
  /// Whether any program of these names that it has started itself still runs on this host.
  bool has_children(const std::vector<std::string>& names) const;
  /// The signal that ended it; 0: none, or not yet.
  int killed_by() const { return killed_by_; }

 private:
  void keep(int status);

  pid_t id_ = -1;
  std::optional<int> exit_code_;
  int killed_by_ = 0;
};

struct ChildOutput {
  int code;          // as wait()
  std::string text;  // what it wrote to stdout
};
/// Runs a command to its end. Throws std::runtime_error when it cannot start.
ChildOutput output_of(const std::vector<std::string>& command, const ChildOptions& options = {});

/// The command as one line for a POSIX shell.
std::string shell_line(const std::vector<std::string>& command);

}  // namespace demvof
