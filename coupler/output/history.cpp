// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace demvof {

History::History(std::filesystem::path path, std::vector<HistoryColumn> columns)
    : path_(std::move(path)), columns_(std::move(columns)) {
  file_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0)
    throw std::runtime_error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
  std::string names = "time", units = "# s";
  for (const HistoryColumn& column : columns_) {
    names += "," + column.name;
    units += "," + column.unit;
  }
  write_line(names + "\n" + units + "\n");
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
