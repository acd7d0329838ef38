// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <thread>

namespace demvof {

/// A file that a library writes which does not look whether its writes succeed: it is given the name of a
/// pipe, and what comes out there goes to the file under our own eyes.
///
///   PipedFile file(path);
///   library.write(file.name());
///   file.finish();
class PipedFile {
 public:
  /// Throws std::runtime_error when there is no pipe to be had.
  explicit PipedFile(std::filesystem::path path);
  ~PipedFile();  // without finish(): leaves no file
  PipedFile(const PipedFile&) = delete;
  PipedFile& operator=(const PipedFile&) = delete;

  /// To be opened for writing, once, from begin to end; valid in this process.
  std::string name() const;
  /// When the library has closed it: brings the file to the disk and publishes it (write_file.hpp).
  /// Throws std::runtime_error with path and reason when any part of it could not be written, or it is empty.
  void finish();

 private:
  void copy();
  void close_writer();

  std::filesystem::path path_, part_;
  int reader_ = -1, writer_ = -1;
  long size_ = 0;      // bytes
  std::string error_;  // of the first write that failed
  std::thread copier_;
};

}  // namespace demvof
