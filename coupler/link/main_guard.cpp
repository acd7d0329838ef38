// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/main_guard.hpp"

#include <fmt/format.h>

#include <exception>
#include <optional>
#include <string>

#include "coupler/base/errors.hpp"
#include "coupler/base/words_of.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/link/run_stage.hpp"

namespace demvof {
namespace {

std::string stopped(const OwnWorld& world, const std::string& why) {
  return fmt::format("{} stopped {}:\n{}", program_name(world.side()), run_stage().describe(), why);
}

/// Wrong input is wrong for both sides, whichever of them is the first to end.
int code_without_partner() {
  const std::optional<Failure> cause = cause_heard();
  return cause && cause->exit_code == exit_input ? exit_input : exit_partner_lost;
}

}  // namespace

int guarded_main(OwnWorld& world, const std::function<int()>& body) {
  try {
    const int code = body();
    world.finalise();
    return code;
  } catch (const InputError& error) {
    world.fail(exit_input,
               fmt::format("{}: the input is wrong:\n{}", program_name(world.side()), error.what()));
  } catch (const PartnerFailed& error) {
    world.fail(code_without_partner(), error.what(), true);
  } catch (const PartnerLost& error) {
    world.fail(code_without_partner(), error.what());
  } catch (const FellowFailed& error) {
    world.fail(error.exit_code, error.what(), true);
  } catch (const SolverStopped& error) {
    world.fail(
        exit_failed,
        stopped(world, fmt::format("{}.\nWhat to try: the solver wrote the reason to {}.", error.what(),
                                   world.side() == Side::fluid ? "fluid.log" : "particles.log")));
  } catch (const std::exception& error) {
    world.fail(exit_failed, stopped(world, words_of(error)));
  } catch (...) {
    world.fail(exit_failed, stopped(world, "an exception of unknown kind"));
  }
}

}  // namespace demvof
