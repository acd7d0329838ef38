// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/write_file.hpp"

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

void write_file_atomically(const std::filesystem::path& path, const std::string& content) {
  // The process id keeps two programs that write the same file out of each other's way.
  std::filesystem::path part = path;
  part += fmt::format(".{}.part", getpid());
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
  publish_file(part, path);
}

}  // namespace demvof
