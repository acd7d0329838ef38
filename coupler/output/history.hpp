// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace demvof {

/// One column of history.csv.
struct HistoryColumn {
  std::string name;
  std::string unit;  // "-" for numbers without one
};

/// history.csv: a line of names, a commented line of units, then one row per recorded time.
///
/// Each row reaches the file whole, in one write, before append returns: an interrupted run leaves
/// a valid table. A row that does not fit (disk full) is taken back before the error is thrown.
class History {
 public:
  /// Starts a new file; the column "time" (s) comes first by itself.
  /// continued_from: time from which an earlier run is continued, s; its rows up to then stay.
  /// Throws std::runtime_error when the file cannot be written, or the earlier one has other columns.
  History(std::filesystem::path path, std::vector<HistoryColumn> columns,
          std::optional<double> continued_from = {});
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  const std::vector<HistoryColumn>& columns() const { return columns_; }

  /// values: one per column, in their order and units; written so that they read back exactly.
  /// Throws std::invalid_argument when the number of values is wrong, std::runtime_error when the
  /// row cannot be written.
  void append(double time, const std::vector<double>& values);

 private:
  void write_line(const std::string& line);
  std::filesystem::path path_;
  std::vector<HistoryColumn> columns_;
  int file_ = -1;
};

}  // namespace demvof
