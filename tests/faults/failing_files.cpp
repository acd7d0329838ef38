// SPDX-License-Identifier: GPL-3.0-or-later
// In front of the C library (LD_PRELOAD), makes file operations fail:
//   DEMVOF_FAULT="OPERATION TEXT COUNT ERROR"
// OPERATION: open (for writing), write, fsync or rename (to a name); the COUNT-th and all later ones on files
// whose path holds TEXT. ERROR: a number of errno.h; 0: the process is killed at the first of them. COUNT
// counts in each process by itself.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Fault {
  std::array<char, 16> operation{};
  std::array<char, 256> text{};
  int first = 0, error = 0;
};

const Fault& fault() {
  static const Fault given = [] {
    Fault read;
    const char* words = std::getenv("DEMVOF_FAULT");
    // Whoever started the programs sees to the end of their run.
    if (words && std::strcmp(program_invocation_short_name, "demvof") != 0)
      std::sscanf(words, "%15s %255s %d %d", read.operation.data(), read.text.data(), &read.first,
                  &read.error);
    return read;
  }();
  return given;
}

bool fails(const char* operation, const char* path) {
  static std::atomic<int> count{0};
  if (std::strcmp(fault().operation.data(), operation) != 0 || !std::strstr(path, fault().text.data()))
    return false;
  if (++count < fault().first) return false;
  if (fault().error == 0) kill(getpid(), SIGKILL);
  errno = fault().error;
  return true;
}

bool fails(const char* operation, int file) {
  if (fault().first == 0) return false;
  std::array<char, 64> link{};
  std::array<char, 4096> path{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", file);
  const int before = errno;
  const ssize_t length = readlink(link.data(), path.data(), path.size() - 1);
  errno = before;
  return length > 0 && fails(operation, path.data());
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool makes_file(int flags) {
  return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  return fails("write", file) ? -1 : real(file, bytes, count);
}

ssize_t writev(int file, const iovec* parts, int count) {
  static const auto real = next<ssize_t (*)(int, const iovec*, int)>("writev");
  return fails("write", file) ? -1 : real(file, parts, count);
}

int open(const char* path, int flags, ...) {
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  va_list more;
  va_start(more, flags);
  const int mode = (flags & O_CREAT) != 0 ? va_arg(more, int) : 0;
  va_end(more);
  return makes_file(flags) && fails("open", path) ? -1 : real(path, flags, mode);
}

int fsync(int file) {
  static const auto real = next<int (*)(int)>("fsync");
  return fails("fsync", file) ? -1 : real(file);
}

int rename(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  return fails("rename", to) ? -1 : real(from, to);
}

FILE* fopen(const char* path, const char* mode) {
  static const auto real = next<FILE* (*)(const char*, const char*)>("fopen");
  return mode[0] != 'r' && fails("open", path) ? nullptr : real(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  static const auto real = next<FILE* (*)(const char*, const char*)>("fopen64");
  return mode[0] != 'r' && fails("open", path) ? nullptr : real(path, mode);
}
}
