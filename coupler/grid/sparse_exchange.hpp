// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Messages between ranks of one program where each has something for a few others only. No rank holds, sends
// or receives a number per rank: what it costs follows the neighbours, not the size of the program.
//
// Both calls are collective, block, and throw RunError when an MPI call fails.

#include <mpi.h>

#include <cstddef>
#include <map>
#include <vector>

namespace demvof {

/// What goes to one rank, or came from one.
struct Parcel {
  int rank;
  std::vector<double> numbers;
};

/// Delivers parcels to ranks that do not know that something comes, at most one to each; a rank may send to
/// itself. Returned: what came, by rank. Non-blocking consensus of Hoefler, Siebert and Lumsdaine (Scalable
/// communication protocols for dynamic sparse data exchange, PPoPP 2010).
std::vector<Parcel> exchange_with_unknown(MPI_Comm world, std::vector<Parcel> parcels);

/// Some of a list's rows, which go to one rank or come from it.
struct RowsOfRank {
  int rank;
  std::size_t first, count;  // rows
};

/// Rows that belong to ranks, sorted by rank; those of one rank stay in their order.
struct RowsByRank {
  std::vector<std::size_t> rows;    // their numbers
  std::vector<RowsOfRank> of_rank;  // of that list
};
/// rank_of(i): of row i < count.
template <class Rank>
RowsByRank rows_by_rank(std::size_t count, const Rank& rank_of) {
  std::map<int, std::vector<std::size_t>> rows;
  auto last = rows.end();  // neighbours in the list mostly go to one rank
  for (std::size_t i = 0; i < count; ++i) {
    const int rank = rank_of(i);
    if (last == rows.end() || last->first != rank) last = rows.try_emplace(rank).first;
    last->second.push_back(i);
  }
  RowsByRank sorted;
  for (const auto& [rank, of_rank] : rows) {
    sorted.of_rank.push_back({rank, sorted.rows.size(), of_rank.size()});
    sorted.rows.insert(sorted.rows.end(), of_rank.begin(), of_rank.end());
  }
  return sorted;
}

/// Sends rows of width numbers to ranks that know, from their own list, how many come. out and in: the whole
/// lists; each rank stands in `to` and in `from` at most once.
void exchange_with_known(MPI_Comm world, const std::vector<RowsOfRank>& to, const double* out,
                         const std::vector<RowsOfRank>& from, double* in, int width);

}  // namespace demvof
