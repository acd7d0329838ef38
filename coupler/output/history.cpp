// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

/// The rows of an earlier run up to a time, with its head.
std::string rows_until(const std::filesystem::path& path, const std::string& head, double last) {
  std::ifstream lines(path);
  std::string line, text;
  for (int row = 0; std::getline(lines, line); ++row)
    if (row < 2 || std::stod(line) <= last * (1 + 1e-9)) text += line + "\n";
  if (text.rfind(head, 0) != 0)
    throw std::runtime_error(fmt::format(
        "{} has other columns than this run writes: leave output.history as it was", path.string()));
  return text;
}

}  // namespace

History::History(std::filesystem::path path, std::vector<HistoryColumn> columns,
                 std::optional<double> continued_from)
    : path_(std::move(path)), columns_(std::move(columns)) {
  std::string names = "time", units = "# s";
  for (const HistoryColumn& column : columns_) {
    names += "," + column.name;
    units += "," + column.unit;
  }
  const std::string head = names + "\n" + units + "\n";
  write_file_atomically(path_, continued_from ? rows_until(path_, head, *continued_from) : head);
  file_ = open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file_ < 0)
    throw std::runtime_error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
}

History::~History() {
  if (file_ >= 0) close(file_);
}

void History::append(double time, const std::vector<double>& values) {
  if (values.size() != columns_.size())
    throw std::invalid_argument(
        fmt::format("{}: {} values for {} columns", path_.string(), values.size(), columns_.size()));
  std::string row = fmt::format("{}", time);  // the shortest text that reads back exactly
  for (double value : values) row += fmt::format(",{}", value);
  write_line(row + "\n");
}

void History::write_line(const std::string& line) {
  const off_t before = lseek(file_, 0, SEEK_END);
  ssize_t written;
  do written = write(file_, line.data(), line.size());
  while (written < 0 && errno == EINTR);
  if (written == static_cast<ssize_t>(line.size())) return;
  const std::string reason = written < 0 ? std::strerror(errno) : "no space left for a whole row";
  const bool restored = written <= 0 || ftruncate(file_, before) == 0;
  throw std::runtime_error(fmt::format("cannot append to {}: {}{}", path_.string(), reason,
                                       restored ? "" : " (its last row is incomplete)"));
}

}  // namespace demvof
