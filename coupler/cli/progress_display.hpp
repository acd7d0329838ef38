// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "coupler/output/progress.hpp"

namespace demvof {

enum class Display { bar, lines, nothing };

/// A bar on a terminal, a line every tenth of the run elsewhere.
Display suitable_display(bool quiet);

/// Shows progress.json on standard output. What is there before is another run's, or the same one's before it
/// goes on, and not shown.
class ProgressDisplay {
 public:
  ProgressDisplay(std::filesystem::path progress_file, Display display);
  void update();
  /// Prints a line of the programs without tearing the bar.
  void print(const std::string& line);
  /// Leaves the last state of the bar standing.
  void finish();

 private:
  void erase_bar();
  std::filesystem::path file_;
  std::filesystem::file_time_type before_;
  Display display_;
  std::string bar_;        // as it stands on the terminal
  int tenths_shown_ = -1;  // of the run
};

/// One line, at most width characters: bar, simulated time, speed, time left, Courant number, particles.
std::string progress_line(const Progress& progress, int width);
/// "1:05", "2:03:00"
std::string clock_text(double seconds);

}  // namespace demvof
