// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/run_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "coupler/base/errors.hpp"

namespace demvof {
namespace {

struct flock byte_lock(long byte) {
  struct flock lock = {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte;
  lock.l_len = 1;
  return lock;
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

[[noreturn]] void in_use(const std::filesystem::path& run, const std::string& by) {
  throw InputError(fmt::format(
      "{}: {} works in this folder; wait for its end, stop it, or choose another --out", run.string(), by));
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& run, Part part) {
  file_ = open((run / lock_file).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) return;  // a folder that cannot be written says so soon enough
  // Who is it: the host, for those that see the folder from another one.
  struct flock lock = byte_lock(static_cast<long>(part));
  if (fcntl(file_, F_SETLK, &lock) != 0) {
    if (errno != EACCES && errno != EAGAIN) return;
    const std::string by = holder(static_cast<long>(part)).value_or("another process");
    close(file_);
    in_use(run, by);
  }
  if (part == Part::command)
    if (const auto other = other_holder()) {
      close(file_);
      in_use(run, *other);
    }
  const std::string text = fmt::format("{}\n", host_name());
  if (ftruncate(file_, 0) != 0 || pwrite(file_, text.data(), text.size(), 0) < 0) return;
}

RunLock::~RunLock() {
  if (file_ >= 0) close(file_);
}

std::optional<std::string> RunLock::holder(long part) const {
  struct flock lock = byte_lock(part);
  if (fcntl(file_, F_GETLK, &lock) != 0 || lock.l_type == F_UNLCK) return std::nullopt;
  std::array<char, 256> host{};
  if (pread(file_, host.data(), host.size() - 1, 0) < 0) host[0] = '\0';
  std::string name = host.data();
  name = name.substr(0, name.find('\n'));
  return fmt::format("process {} on {}", lock.l_pid, name.empty() ? "some host" : name);
}

std::optional<std::string> RunLock::other_holder() const {
  if (file_ < 0) return std::nullopt;
  for (const Part part : {Part::command, Part::fluid, Part::particles})
    if (const auto by = holder(static_cast<long>(part))) return by;
  return std::nullopt;
}

}  // namespace demvof
