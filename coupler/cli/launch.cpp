// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/launch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <regex>
#include <stdexcept>

#include "coupler/base/errors.hpp"
#include "coupler/base/printable.hpp"
#include "coupler/cli/child_process.hpp"
#include "coupler/cli/mpirun.hpp"
#include "coupler/cli/prepare.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

std::string sibling(const std::string& program) {
  const fs::path path = fs::read_symlink("/proc/self/exe").parent_path() / program;
  if (!fs::exists(path))
    throw std::runtime_error(
        fmt::format("{} is not there: build and install {} beside demvof", path.string(), program));
  return path.string();
}

volatile std::sig_atomic_t stop_requests = 0;
void on_stop_signal(int) {
  stop_requests = stop_requests + 1;
}

/// From now on stop signals are counted, also when the programs have ended: what they have done is still
/// said.
void count_stop_signals() {
  stop_requests = 0;
  struct sigaction action = {};
  action.sa_handler = on_stop_signal;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
}

/// Lines out of a stream of bytes. What mpirun says in blocks between rows of dashes is set aside: the
/// programs' own messages say it better, and it is shown only when there are none.
class Lines {
 public:
  explicit Lines(const std::function<void(const std::string&)>& on_line) : on_line_(on_line) {}

  void add(const char* bytes, std::size_t count) {
    rest_.append(bytes, count);
    for (std::size_t end; (end = rest_.find('\n')) != std::string::npos; rest_.erase(0, end + 1))
      line(rest_.substr(0, end));
  }
  /// Whether the programs said anything.
  bool finish() {
    if (!rest_.empty()) line(rest_);
    rest_.clear();
    return said_something_;
  }
  /// What was set aside.
  const std::vector<std::string>& chatter() const { return chatter_; }

 private:
  void line(const std::string& text) {
    const bool rule = text.size() >= 60 && text.find_first_not_of('-') == std::string::npos;
    if (rule) {
      in_block_ = !in_block_;
    } else if (in_block_ || text.rfind("mpirun: Forwarding signal", 0) == 0) {
      chatter_.push_back(text);
      std::smatch found;
      if (std::regex_search(text, found, lost_host_))
        on_line_("mpirun lost host " + found[1].str() +
                 ": it does not answer, or nothing runs there any more");
    } else {
      said_something_ = said_something_ || !text.empty();
      on_line_(text);
    }
  }
  const std::regex lost_host_{"Remote daemon: .* on node (\\S+)"};
  std::function<void(const std::string&)> on_line_;
  std::string rest_;
  std::vector<std::string> chatter_;
  bool in_block_ = false, said_something_ = false;
};

/// mpirun may not end when its programs have: Open MPI 4 waits for itself for ever in its clean-up when a
/// rank was killed while it introduced itself, and for hosts that do not answer. (There its other half ends
/// what it has started when it is without mpirun.)
class Forgotten {
 public:
  /// True once mpirun has had programs, and has been without any for 10 s. Asked often, it looks once a
  /// second.
  bool operator()(const ChildProcess& mpirun, const std::vector<std::string>& programs) {
    constexpr double patience = 10;
    const auto now = std::chrono::steady_clock::now();
    const auto since = [now](auto then) { return std::chrono::duration<double>(now - then).count(); };
    if (since(last_look_) < 1) return false;
    last_look_ = now;
    if (mpirun.has_children(programs)) {
      last_seen_ = now;
      begun_ = true;
    }
    return begun_ && since(last_seen_) > patience;
  }

 private:
  std::chrono::steady_clock::time_point last_look_, last_seen_;
  bool begun_ = false;
};

/// Passes on what is in the pipe now, waiting a quarter of a second at most.
void read_some(int pipe, Lines& lines, int milliseconds) {
  pollfd wanted = {pipe, POLLIN, 0};
  if (poll(&wanted, 1, milliseconds) <= 0) return;
  char buffer[4096];
  ssize_t count;
  while ((count = read(pipe, buffer, sizeof buffer)) > 0) lines.add(buffer, static_cast<std::size_t>(count));
  // At the end of the stream poll returns at once: do not spin until the program is gone.
  if (count == 0) usleep(static_cast<useconds_t>(milliseconds) * 1000);
}

}  // namespace

LaunchCommand launch_command(const CaseParameters& parameters, const std::vector<std::string>& arguments,
                             int time_to_write, const std::vector<std::string>& mpirun_words) {
  LaunchCommand command;
  command.environment = foam_environment();
  command.pair = parameters.particles.has_value();
  const auto add = [&command](const std::vector<std::string>& words) {
    command.words.insert(command.words.end(), words.begin(), words.end());
  };
  const auto add_program = [&](const std::string& program) {
    add({sibling(program), parameters.file});
    add(arguments);
  };
  if (!command.pair && parameters.fluid.ranks == 1) {
    if (!mpirun_words.empty())
      throw InputError("demvof run: --mpirun-option: one rank of foam_side alone is started without mpirun");
    add_program("foam_side");
    return command;
  }
  const Mpirun mpirun = find_mpirun();
  if (geteuid() == 0)
    command.environment.insert({{"OMPI_ALLOW_RUN_AS_ROOT", "1"}, {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}});
  const int fluid_ranks = parameters.fluid.ranks,
            particle_ranks = command.pair ? parameters.particles->ranks : 0;
  add({"mpirun"});
  add(mpirun_options(mpirun, parameters.coupling.time_out, time_to_write));
  add(mpirun_words);
  add({"-np", std::to_string(fluid_ranks + particle_ranks)});
  if (command.pair) add({sibling("demvof_pair"), "-np", std::to_string(fluid_ranks)});
  add_program("foam_side");
  command.programs = {"demvof_pair", "foam_side"};
  if (command.pair) {
    command.programs.emplace_back("dem_side");
    add({"+", "-np", std::to_string(particle_ranks)});
    add_program("dem_side");
  }
  return command;
}

std::string shell_line(const LaunchCommand& command) {
  std::string line;
  for (const auto& [name, value] : command.environment)
    if (!getenv(name.c_str())) line += fmt::format("{}={} ", name, shell_line({value}));
  return line + shell_line(command.words);
}

int run_exit_code(int code, bool pair, bool ended_by_user) {
  if (code == 0 || code == 2 || code == 3 || code == 4) return code;
  // A side killed by a signal is a lost partner for the other.
  return code > 128 && pair && !ended_by_user ? 4 : 3;
}

int confirmed(const End& end, const std::string& status) {
  const bool completed = status == "completed";
  if (completed && end.code == 3 && end.user_asked) return 0;
  return end.code == 0 && !completed ? 3 : end.code;
}

std::string end_of_mpirun(const LaunchCommand& command, int code, int killed_by, bool said_something) {
  if (command.words.front() != "mpirun" || (killed_by == 0 && (code == 0 || said_something))) return {};
  const std::string how = killed_by
                              ? fmt::format("was killed by signal {} ({})", killed_by, strsignal(killed_by))
                              : fmt::format("ended with exit code {}", code);
  if (said_something) return fmt::format("mpirun itself {}; the programs ended with it.", how);
  return fmt::format(
      "mpirun itself {} before the programs said a word. The command was\n    {}\n"
      "What to try: the same mpirun with a program as plain as `hostname`.",
      how, shell_line(command));
}

End launch(const LaunchCommand& command, const Watch& watch) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  fcntl(pipe_ends[0], F_SETFL, O_NONBLOCK);
  ChildOptions options;
  options.environment = command.environment;
  options.output = pipe_ends[1];
  options.own_group = true;

  count_stop_signals();
  ChildProcess programs(command.words, options);
  close(pipe_ends[1]);
  const auto show = [&watch](const std::string& text) { watch.on_line(printable_lines(text)); };
  Lines lines(show);
  Forgotten forgotten;
  int passed_on = 0;
  bool killed = false;
  std::optional<int> code;
  while (!(code = programs.poll())) {
    read_some(pipe_ends[0], lines, 250);
    if (stop_requests > passed_on) {
      programs.send_signal(passed_on == 0 ? SIGUSR1 : SIGTERM);
      watch.on_line(passed_on == 0 ? "stopping at the end of the window; once more to end at once"
                                   : "ending at once");
      ++passed_on;
    }
    if (command.words.front() == "mpirun" && !killed && forgotten(programs, command.programs)) {
      watch.on_line("mpirun does not end though its programs have: killing it");
      programs.send_signal(SIGKILL);
      killed = true;
    }
    watch.on_tick();
  }
  read_some(pipe_ends[0], lines, 0);
  close(pipe_ends[0]);
  const bool said_something = lines.finish();
  std::string mpirun_said;
  if (*code != 0 && passed_on == 0 && !said_something) {
    for (const std::string& text : lines.chatter()) show(text);
    mpirun_said = fmt::format("{}", fmt::join(lines.chatter(), "\n"));
  }
  if (passed_on == 0 && !killed)
    if (const std::string end =
            end_of_mpirun(command, *code, programs.killed_by(), said_something || !mpirun_said.empty());
        !end.empty())
      show(end);
  return {run_exit_code(*code, command.pair, passed_on > 0), passed_on > 0, mpirun_said};
}

}  // namespace demvof
