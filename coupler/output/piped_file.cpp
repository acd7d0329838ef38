// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/piped_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), reason));
}

bool write_all(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

PipedFile::PipedFile(std::filesystem::path path) : path_(std::move(path)), part_(part_name(path_)) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) cannot_write(path_, std::strerror(errno));
  reader_ = ends[0];
  writer_ = ends[1];
  sigset_t all, before;  // signals are for the main thread
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  copier_ = std::thread([this] { copy(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

PipedFile::~PipedFile() {
  if (!copier_.joinable()) return;
  close_writer();
  copier_.join();
  unlink(part_.c_str());
}

std::string PipedFile::name() const {
  return fmt::format("/proc/self/fd/{}", writer_);
}

void PipedFile::close_writer() {
  if (writer_ >= 0) close(writer_);
  writer_ = -1;
}

// After an error it reads on: the library would wait for ever at a pipe that nobody empties.
void PipedFile::copy() {
  const int file = open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) error_ = std::strerror(errno);
  std::array<char, 65536> buffer;
  ssize_t count;
  while ((count = read(reader_, buffer.data(), buffer.size())) > 0 || (count < 0 && errno == EINTR)) {
    if (count < 0) continue;
    size_ += count;
    if (error_.empty() && !write_all(file, buffer.data(), static_cast<std::size_t>(count)))
      error_ = std::strerror(errno);
  }
  if (file >= 0 && (fsync(file) != 0 && error_.empty())) error_ = std::strerror(errno);
  if (file >= 0 && (close(file) != 0 && error_.empty())) error_ = std::strerror(errno);
  close(reader_);
}

void PipedFile::finish() {
  close_writer();
  copier_.join();
  if (error_.empty() && size_ == 0) error_ = "nothing was written";
  if (!error_.empty()) {
    unlink(part_.c_str());
    cannot_write(path_, error_);
  }
  publish_file(part_, path_);
}

}  // namespace demvof
