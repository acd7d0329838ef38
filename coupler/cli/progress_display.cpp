// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/progress_display.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace demvof {
namespace {

double done_fraction(const Progress& progress) {
  const double whole = progress.end_time - progress.begin_time;
  return whole > 0 ? std::clamp((progress.time - progress.begin_time) / whole, 0.0, 1.0) : 0;
}

int terminal_width() {
  winsize size = {};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string facts(const Progress& p) {
  std::string text =
      fmt::format("{:3.0f} %  t {:.4g} of {:.4g} s", 100 * done_fraction(p), p.time, p.end_time);
  if (p.speed > 0) text += fmt::format("  {:.2g} s/s  {} left", p.speed, clock_text(p.remaining_seconds));
  text += fmt::format("  Co {:.2g}", p.worst_courant);
  if (p.particles > 0) text += fmt::format("  {} particles", p.particles);
  return text;
}

/// Tells a file from one that has taken its place.
std::filesystem::file_time_type time_of(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::last_write_time(file, none);
}

}  // namespace

std::string clock_text(double seconds) {
  const long whole = std::lround(std::min(seconds, 3.6e9));
  const long hours = whole / 3600, minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string progress_line(const Progress& progress, int width) {
  const std::string text = facts(progress);
  const int room = std::min(30, width - static_cast<int>(text.size()) - 3);  // brackets and a blank
  if (room < 5) return text.substr(0, static_cast<std::size_t>(std::max(0, width)));
  const int filled = static_cast<int>(done_fraction(progress) * room);
  return fmt::format("[{}{}] {}", std::string(static_cast<std::size_t>(filled), '='),
                     std::string(static_cast<std::size_t>(room - filled), ' '), text);
}

Display suitable_display(bool quiet) {
  return quiet ? Display::nothing : isatty(STDOUT_FILENO) ? Display::bar : Display::lines;
}

ProgressDisplay::ProgressDisplay(std::filesystem::path progress_file, Display display)
    : file_(std::move(progress_file)), before_(time_of(file_)), display_(display) {}

void ProgressDisplay::update() {
  if (display_ == Display::nothing || time_of(file_) == before_) return;
  const auto progress = read_progress(file_);
  if (!progress) return;
  if (display_ == Display::lines) {
    const int tenths = static_cast<int>(10 * done_fraction(*progress) + 1e-9);
    if (tenths > tenths_shown_) fmt::print("{}\n", facts(*progress));
    tenths_shown_ = std::max(tenths_shown_, tenths);
  } else {
    const std::string bar = progress_line(*progress, terminal_width() - 1);
    if (bar == bar_) return;
    erase_bar();
    bar_ = bar;
    fmt::print("{}", bar_);
  }
  std::fflush(stdout);
}

void ProgressDisplay::print(const std::string& line) {
  erase_bar();
  fmt::print("{}\n{}", line, bar_);
  std::fflush(stdout);
}

void ProgressDisplay::finish() {
  update();
  if (!bar_.empty()) fmt::print("\n");
  bar_.clear();
}

void ProgressDisplay::erase_bar() {
  if (!bar_.empty()) fmt::print("\r{:{}}\r", "", bar_.size());
}

}  // namespace demvof
