// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace demvof {
namespace {

/// After fork, in the child, until the new program takes over.
[[noreturn]] void become(char* const* arguments, const ChildOptions& options, const char* directory,
                         int error_pipe) {
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  if (options.output >= 0) {
    dup2(options.output, STDOUT_FILENO);
    dup2(options.silent_errors ? open("/dev/null", O_WRONLY) : options.output, STDERR_FILENO);
  }
  if (options.own_group) setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 0);
  // OpenFOAM complains of a PWD that is somewhere else.
  if (!options.directory.empty()) setenv("PWD", directory, 1);
  if (options.directory.empty() || chdir(options.directory.c_str()) == 0) execvp(arguments[0], arguments);
  const int error = errno;
  if (write(error_pipe, &error, sizeof error) < 0) _exit(126);
  _exit(127);
}

}  // namespace

void ChildProcess::keep(int status) {
  if (WIFSIGNALED(status)) killed_by_ = WTERMSIG(status);
  exit_code_ = killed_by_ ? 128 + killed_by_ : WEXITSTATUS(status);
}

ChildProcess::ChildProcess(const std::vector<std::string>& command, const ChildOptions& options) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  std::string directory;
  if (!options.directory.empty()) directory = std::filesystem::absolute(options.directory).lexically_normal();

  int error_pipe[2];
  if (pipe2(error_pipe, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  id_ = fork();
  if (id_ == 0) become(arguments.data(), options, directory.c_str(), error_pipe[1]);
  close(error_pipe[1]);
  int error = id_ < 0 ? errno : 0;
  // The pipe closes without a word when the program takes over.
  if (id_ > 0 && read(error_pipe[0], &error, sizeof error) > 0) wait();
  close(error_pipe[0]);
  if (error) throw std::runtime_error(fmt::format("cannot start {}: {}", command[0], std::strerror(error)));
}

ChildProcess::~ChildProcess() {
  if (poll()) return;
  send_signal(SIGTERM);
  while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ChildProcess::send_signal(int number) const {
  if (!exit_code_) kill(id_, number);
}

std::optional<int> ChildProcess::poll() {
  int status = 0;
  if (!exit_code_ && waitpid(id_, &status, WNOHANG) == id_) keep(status);
  return exit_code_;
}

// /proc/PID/stat: "pid (name) state parent ...", and the name, the first bytes of it, may hold anything.
bool ChildProcess::has_children(const std::vector<std::string>& names) const {
  constexpr std::size_t longest_name = 15;
  const auto wanted = [&names](const std::string& name) {
    return std::any_of(names.begin(), names.end(),
                       [&name](const std::string& one) { return name == one.substr(0, longest_name); });
  };
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", none)) {
    std::ifstream file(entry.path() / "stat");
    std::string line;
    if (!std::getline(file, line)) continue;
    const std::size_t begin = line.find('(') + 1, end = line.rfind(')');
    if (begin > end || end == std::string::npos || !wanted(line.substr(begin, end - begin))) continue;
    std::istringstream fields(line.substr(end + 1));
    char state = 'X';
    pid_t parent = 0;
    fields >> state >> parent;
    if (parent == id_ && state != 'Z' && state != 'X') return true;
  }
  return false;
}

int ChildProcess::wait() {
  int status = 0;
  while (!exit_code_) {
    if (waitpid(id_, &status, 0) == id_)
      keep(status);
    else if (errno != EINTR)
      throw std::runtime_error(fmt::format("cannot wait for a program: {}", std::strerror(errno)));
  }
  return *exit_code_;
}

ChildOutput output_of(const std::vector<std::string>& command, const ChildOptions& options) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  ChildOptions with_pipe = options;
  with_pipe.output = pipe_ends[1];
  with_pipe.silent_errors = true;
  ChildOutput output{};
  try {
    ChildProcess program(command, with_pipe);
    close(pipe_ends[1]);
    pipe_ends[1] = -1;
    char buffer[4096];
    for (ssize_t count; (count = read(pipe_ends[0], buffer, sizeof buffer)) != 0;) {
      if (count > 0) output.text.append(buffer, static_cast<std::size_t>(count));
      if (count < 0 && errno != EINTR) break;
    }
    output.code = program.wait();
  } catch (...) {
    close(pipe_ends[0]);
    if (pipe_ends[1] >= 0) close(pipe_ends[1]);
    throw;
  }
  close(pipe_ends[0]);
  return output;
}

std::string shell_line(const std::vector<std::string>& command) {
  static const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  std::string line;
  for (const std::string& word : command) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace demvof
