// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/failure.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <iostream>
#include <mutex>

#include "coupler/link/run_stage.hpp"

namespace demvof {
namespace {

std::mutex guard;
std::function<void(const Failure&)> last_words;
std::atomic<bool> claimed{false};

}  // namespace

void set_last_words(std::function<void(const Failure&)> words) {
  const std::lock_guard lock(guard);
  last_words = std::move(words);
}

bool claim_failure() {
  return !claimed.exchange(true);
}

void report_failure(int exit_code, const std::string& message, bool quiet) {
  const Failure failure{exit_code, run_stage().stage(), run_stage().time(), message};
  if (!quiet) {
    const std::string text = fmt::format("\n{}\n", message);
    std::fwrite(text.data(), 1, text.size(), stderr);
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

void end_now(int exit_code) {
  std::cout.flush();
  std::fflush(nullptr);
  _exit(exit_code);
}

}  // namespace demvof
