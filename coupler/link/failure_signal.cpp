// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/failure_signal.hpp"

#include <chrono>
#include <thread>

#include "coupler/base/mpi_check.hpp"

namespace demvof {
namespace {

constexpr int tag = 911;
constexpr std::size_t longest = 3000;  // short enough to leave without the receiver's help

}  // namespace

void FailureSignal::send(const Failure& failure) noexcept {
  try {
    int size = 0, rank = 0;
    if (MPI_Comm_size(both_, &size) != MPI_SUCCESS || MPI_Comm_rank(both_, &rank) != MPI_SUCCESS) return;
    Failure said = failure;
    said.message = said.message.substr(0, longest);
    texts_.push_back(to_text(said));
    const std::string& text = texts_.back();
    for (int to = 0; to < size; ++to) {
      if (to == rank) continue;
      MPI_Request request;
      // A rank that cannot be told is found out by its watch.
      if (MPI_Isend(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, tag, both_, &request) ==
          MPI_SUCCESS)
        requests_.push_back(request);
    }
  } catch (...) {
  }
}

std::optional<FailureSignal::Notice> FailureSignal::receive() {
  int heard = 0, length = 0;
  MPI_Status status;
  check_mpi(MPI_Iprobe(MPI_ANY_SOURCE, tag, both_, &heard, &status), "MPI_Iprobe for failure notices");
  if (!heard) return std::nullopt;
  check_mpi(MPI_Get_count(&status, MPI_CHAR, &length), "MPI_Get_count of a notice");
  std::string text(length, ' ');
  check_mpi(MPI_Recv(text.data(), length, MPI_CHAR, status.MPI_SOURCE, tag, both_, MPI_STATUS_IGNORE),
            "MPI_Recv of a notice");
  return Notice{status.MPI_SOURCE, failure_from(text).value_or(Failure{})};
}

void FailureSignal::flush(double seconds) noexcept {
  using clock = std::chrono::steady_clock;
  const auto end = clock::now() + std::chrono::duration<double>(seconds);
  int sent = requests_.empty();
  while (!sent && clock::now() < end) {
    if (MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &sent, MPI_STATUSES_IGNORE) !=
        MPI_SUCCESS)
      return;
    if (!sent) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace demvof
