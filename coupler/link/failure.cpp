// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/failure.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "coupler/base/printable.hpp"
#include "coupler/link/run_stage.hpp"

namespace demvof {
namespace {

std::mutex guard;
std::function<void(const Failure&)> last_words;
std::atomic<bool> claimed{false};
std::optional<Failure> cause;

}  // namespace

Failure failure_here(Side side, int exit_code, const std::string& message) {
  return {exit_code, side, run_stage().stage(), run_stage().time(), message};
}

std::string to_text(const Failure& failure) {
  const nlohmann::json json = {{"exit_code", failure.exit_code},
                               {"side", side_name(failure.side)},
                               {"stage", failure.stage},
                               {"time", failure.time},
                               {"message", failure.message}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<Failure> failure_from(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    const Side side = json.at("side") == side_name(Side::fluid) ? Side::fluid : Side::particles;
    const auto& time = json.at("time");
    return Failure{json.at("exit_code"), side, json.at("stage"), time.is_number() ? time.get<double>() : 0,
                   json.at("message")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

void set_last_words(std::function<void(const Failure&)> words) {
  const std::lock_guard lock(guard);
  last_words = std::move(words);
}

bool claim_failure() {
  return !claimed.exchange(true);
}

void report_failure(const Failure& failure, const std::string& text, bool quiet) {
  if (!quiet) {
    const std::string lines = fmt::format("\n{}\n", printable_lines(text));
    std::fwrite(lines.data(), 1, lines.size(), stderr);
    std::fflush(stderr);
  }
  const std::lock_guard lock(guard);
  if (!last_words) return;
  try {
    last_words(failure);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "The failure could not be recorded: %s\n", error.what());
  }
}

// By the watching thread, too, while the main thread writes: the log's last words may then stand twice, or
// not at all. Without, all that is in the buffer would be lost, and mostly says why.
void end_now(int exit_code) {
  std::cout.flush();
  std::fflush(nullptr);
  _exit(exit_code);
}

void heard_of(const Failure& failure) {
  const std::lock_guard lock(guard);
  if (!cause) cause = failure;
}

std::optional<Failure> cause_heard() {
  const std::lock_guard lock(guard);
  return cause;
}

}  // namespace demvof
