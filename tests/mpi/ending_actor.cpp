// SPDX-License-Identifier: GPL-3.0-or-later
// One side of a pair that ends in a given way; endings_test.py starts two of them and looks at how
// each comes to its end. Usage: ending_actor fluid|particles ROLE
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "coupler/base/errors.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/link/link.hpp"
#include "coupler/link/main_guard.hpp"
#include "coupler/link/run_stage.hpp"

namespace {

using namespace demvof;
using namespace std::chrono_literals;

// Runs windows of 10 ms until one side asks for a stop; at the given window something happens.
int windows(Link& link, const std::string& id, int at_window, const std::function<void()>& event) {
  const CellValues<double> nothing;
  for (int window = 1;; ++window) {
    run_stage().set("windows", 0.001 * window);
    link.send(nothing);
    link.receive<double>();
    std::this_thread::sleep_for(10ms);
    if (window == at_window) event();
    if (!link.agree_to_continue(Continue::run)) break;
  }
  std::ofstream("stopped." + id) << run_stage().time() << std::endl;
  link.close();
  return exit_failed;
}

// A solver in a long computation that never looks at the link.
int compute(Link&) {
  run_stage().set("DEM steps", 0.125);
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(10ms);
  return exit_done;
}

void diverge() {
  throw RunError("the flow diverged");
}

struct EndsMpiWhenDestroyed {
  ~EndsMpiWhenDestroyed() { MPI_Finalize(); }
};

int act(const std::string& role, OwnWorld& world) {
  const std::string id = fmt::format("{}.{}", side_name(world.side()), world.rank());
  set_last_words([id](const Failure& failure) {
    std::ofstream("last_words." + id) << failure.exit_code << '\n'
                                      << failure.stage << '\n'
                                      << failure.message;
  });
  std::ofstream("pid." + id) << getpid() << std::endl;
  if (role == "bad_input") throw InputError("case.yaml:7: coupling.window = -1: must be positive");

  Link link(world, {4, 5, 5}, role == "impatient" ? 1.0 : 60.0);
  link.swap_text("");
  if (role == "disagree")
    link.handshake({{"coupling.window", world.side() == Side::fluid ? "1e-4" : "2e-4", 1e-9}}, "");
  std::ofstream("ready." + id) << std::endl;
  const auto in_window_5 = [&](const std::function<void()>& event) { return windows(link, id, 5, event); };
  const std::map<std::string, std::function<int()>> roles{
      {"windows", [&] { return in_window_5([] {}); }},
      {"compute", [&] { return compute(link); }},
      {"impatient", [&] { return in_window_5([] {}); }},
      {"run_error", [&] { return in_window_5(diverge); }},
      // LIGGGHTS, Error::all and Error::one; OpenFOAM, error::abort and a serial error::exit.
      {"finalize", [&] { return in_window_5([] { MPI_Finalize(), std::exit(1); }); }},
      {"abort", [&] { return in_window_5([] { MPI_Abort(MPI_COMM_WORLD, 1); }); }},
      {"exit", [&] { return in_window_5([] { std::exit(1); }); }},
      {"finalize_while_unwinding",
       [&] {
         return in_window_5([] {
           const EndsMpiWhenDestroyed library;
           diverge();
         });
       }},
      {"terminate", [&] { return in_window_5([]() noexcept { diverge(); }); }},
      {"last_rank_fails",
       [&] {
         return in_window_5([&] {
           if (world.rank() == world.size() - 1) diverge();
         });
       }},
  };
  return roles.at(role)();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 1;
  const std::string side = argv[1], role = argv[2];
  OwnWorld world(argc, argv, side == "fluid" ? Side::fluid : Side::particles);
  return guarded_main(world, [&] { return act(role, world); });
}
