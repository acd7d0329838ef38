// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/write_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace demvof {

void publish_file(const std::filesystem::path& complete, const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(complete, path, error);
  if (error)
    throw std::runtime_error(
        fmt::format("cannot rename {} to {}: {}", complete.string(), path.string(), error.message()));
}

std::filesystem::path part_name(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  part += fmt::format(".{}.part", getpid());
  return part;
}

void bring_to_disk(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  // Some file systems know nothing to do for a folder, and say so.
  const bool done = file >= 0 && (fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP);
  const int reason = errno;
  if (file >= 0) close(file);
  if (!done)
    throw std::runtime_error(
        fmt::format("cannot bring {} to the disk: {}", path.string(), std::strerror(reason)));
}

void write_file_atomically(const std::filesystem::path& path, const std::string& content, Durable durable) {
  const std::filesystem::path part = part_name(path);
  errno = 0;
  std::ofstream file(part, std::ios::binary);
  file << content;
  file.close();
  if (!file) {
    const std::string reason = errno ? std::strerror(errno) : "unknown reason";
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), reason));
  }
  if (durable == Durable::yes) bring_to_disk(part);
  publish_file(part, path);
  if (durable == Durable::yes)
    bring_to_disk(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."));
}

}  // namespace demvof
