// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/sparse_exchange.hpp"

#include <sched.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include "coupler/base/mpi_check.hpp"

namespace demvof {
namespace {

constexpr int tag_known = 0, tag_unknown = 1;

/// A communicator of our own beside the program's, so that nothing is taken for a solver's message.
struct Channel {
  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0, ranks = 1;
  int round = 0;  // of exchange_with_unknown: who is in the next one already uses the other tag
};

int forget(MPI_Comm, int, void* channel, void*) {
  const std::unique_ptr<Channel> last(static_cast<Channel*>(channel));
  return MPI_Comm_free(&last->comm);
}

/// Made at the first call for this communicator, and kept with it.
Channel& channel_of(MPI_Comm world) {
  static const int key = [] {
    int made = MPI_KEYVAL_INVALID;
    check_mpi(MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, forget, &made, nullptr),
              "MPI_Comm_create_keyval");
    return made;
  }();
  Channel* channel = nullptr;
  int known = 0;
  check_mpi(MPI_Comm_get_attr(world, key, static_cast<void*>(&channel), &known), "MPI_Comm_get_attr");
  if (known) return *channel;
  auto made = std::make_unique<Channel>();
  check_mpi(MPI_Comm_dup(world, &made->comm), "MPI_Comm_dup");
  check_mpi(MPI_Comm_set_name(made->comm, "demvof neighbours"), "MPI_Comm_set_name");
  check_mpi(MPI_Comm_rank(made->comm, &made->rank), "MPI_Comm_rank");
  check_mpi(MPI_Comm_size(made->comm, &made->ranks), "MPI_Comm_size");
  check_mpi(MPI_Comm_set_attr(world, key, made.get()), "MPI_Comm_set_attr");
  return *made.release();
}

int message_length(std::size_t numbers) {
  if (numbers > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw RunError(std::to_string(numbers) +
                   " numbers for one rank: more than a message takes; use more ranks");
  return static_cast<int>(numbers);
}

/// A parcel that has arrived, if there is one.
bool take(const Channel& channel, int tag, std::vector<Parcel>& received) {
  MPI_Message message;
  MPI_Status status;
  int there = 0, count = 0;
  check_mpi(MPI_Improbe(MPI_ANY_SOURCE, tag, channel.comm, &there, &message, &status), "MPI_Improbe");
  if (!there) return false;
  check_mpi(MPI_Get_count(&status, MPI_DOUBLE, &count), "MPI_Get_count");
  received.push_back({status.MPI_SOURCE, std::vector<double>(static_cast<std::size_t>(count))});
  check_mpi(MPI_Mrecv(received.back().numbers.data(), count, MPI_DOUBLE, &message, MPI_STATUS_IGNORE),
            "MPI_Mrecv");
  return true;
}

}  // namespace

std::vector<Parcel> exchange_with_unknown(MPI_Comm world, std::vector<Parcel> parcels) {
  Channel& channel = channel_of(world);
  if (channel.ranks == 1) return parcels;
  const int tag = tag_unknown + channel.round;
  channel.round = 1 - channel.round;

  std::vector<Parcel> received;
  std::vector<MPI_Request> sent;
  for (Parcel& parcel : parcels) {
    if (parcel.rank == channel.rank) {
      received.push_back(std::move(parcel));
      continue;
    }
    sent.emplace_back();
    check_mpi(MPI_Issend(parcel.numbers.data(), message_length(parcel.numbers.size()), MPI_DOUBLE,
                         parcel.rank, tag, channel.comm, &sent.back()),
              "MPI_Issend");
  }
  // Once all that this rank sent has been taken it says so; when all have said so nothing is under way.
  MPI_Request all_taken = MPI_REQUEST_NULL;
  for (bool said = false;;) {
    if (take(channel, tag, received)) continue;
    int done = 0;
    if (said) {
      check_mpi(MPI_Test(&all_taken, &done, MPI_STATUS_IGNORE), "MPI_Test");
      if (done) break;
    } else {
      check_mpi(MPI_Testall(static_cast<int>(sent.size()), sent.data(), &done, MPI_STATUSES_IGNORE),
                "MPI_Testall");
      if (done) check_mpi(MPI_Ibarrier(channel.comm, &all_taken), "MPI_Ibarrier");
      said = done != 0;
    }
    sched_yield();
  }
  std::sort(received.begin(), received.end(),
            [](const Parcel& a, const Parcel& b) { return a.rank < b.rank; });
  return received;
}

void exchange_with_known(MPI_Comm world, const std::vector<RowsOfRank>& to, const double* out,
                         const std::vector<RowsOfRank>& from, double* in, int width) {
  const Channel& channel = channel_of(world);
  std::vector<MPI_Request> requests;
  for (const RowsOfRank& rows : from) {
    if (rows.rank == channel.rank) continue;
    requests.emplace_back();
    check_mpi(MPI_Irecv(in + rows.first * width, message_length(rows.count * width), MPI_DOUBLE, rows.rank,
                        tag_known, channel.comm, &requests.back()),
              "MPI_Irecv");
  }
  for (const RowsOfRank& rows : to) {
    const double* begin = out + rows.first * width;
    if (rows.rank == channel.rank) {
      const auto own = std::find_if(from.begin(), from.end(),
                                    [&](const RowsOfRank& other) { return other.rank == channel.rank; });
      std::copy_n(begin, rows.count * width, in + own->first * width);
      continue;
    }
    requests.emplace_back();
    check_mpi(MPI_Isend(begin, message_length(rows.count * width), MPI_DOUBLE, rows.rank, tag_known,
                        channel.comm, &requests.back()),
              "MPI_Isend");
  }
  check_mpi(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE),
            "MPI_Waitall");
}

}  // namespace demvof
