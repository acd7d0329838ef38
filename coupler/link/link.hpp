// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <list>
#include <string>
#include <type_traits>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "coupler/link/exchange_plan.hpp"
#include "coupler/link/own_world.hpp"
#include "coupler/link/waiting.hpp"

namespace demvof {

/// One fact that both sides must agree on before a run. Numbers agree within the relative tolerance
/// (absolute where the larger magnitude is below 1e-300); tolerance < 0: compare text exactly.
struct HandshakeItem {
  std::string key;    // as in the case file where there is such a key
  std::string value;  // text, or numbers separated by blanks
  double tolerance = -1;
};

struct LinkStatistics {
  double waiting_seconds = 0;                       // this rank, waiting for the partner
  double exchange_seconds = 0;                      // this rank, packing and moving data, waiting apart
  std::int64_t bytes_sent = 0, bytes_received = 0;  // this rank, bulk cells
  std::int64_t cells_sent = 0, cells_received = 0;
};

/// How a side wants the run to go on; travels with every window.
enum class Continue : int { run = 0, stop_requested = 1, failed = 2 };

/// The way between the two programs: an MPI intercommunicator on which each owner of bulk cells
/// talks only to the partner's owners of the same cells. Waiting is passive and bounded.
///
/// Every call may throw PartnerLost (the partner cried for help, was killed, or was silent beyond the
/// time-out), FellowFailed (a rank of this side cried for help) and RunError (an MPI call failed).
class Link {
 public:
  /// Collective over both programs. Throws InputError when there is no partner.
  /// bulk_cells: of the grid, per direction.
  Link(const OwnWorld& world, const std::array<int, 3>& bulk_cells, double time_out_seconds);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Ownership of bulk cells in this program and in the partner.
  const BulkPartition& mine() const { return mine_; }
  const BulkPartition& theirs() const { return theirs_; }

  /// Compares every item with the partner's; items that only one side gives are not compared. The
  /// larger of the two tolerances counts. Throws InputError on both sides, on all ranks, with one line
  /// per disagreement: the key and both values. facts: free text for the partner (JSON), returned is
  /// the partner's.
  std::string handshake(const std::vector<HandshakeItem>& items, const std::string& facts);

  /// Sends the values of cells owned by this rank. Every rank calls it, with or without cells.
  template <class T>
  void send(const CellValues<T>& owned) {
    send_rows(owned.cells, reinterpret_cast<const double*>(owned.values.data()), row_width<T>());
  }
  /// Waits until the partner has everything that was sent: whoever computes for long after a send calls it,
  /// since MPI may not move a message while nobody is inside MPI.
  void deliver() { finish_sends(); }
  /// Receives the values for the cells owned by this rank, as the partner sent them.
  template <class T>
  CellValues<T> receive() {
    CellValues<T> received;
    std::vector<double> rows;
    receive_rows(received.cells, rows, row_width<T>());
    received.values.resize(received.cells.size());
    if (!rows.empty()) std::memcpy(static_cast<void*>(received.values.data()), rows.data(), 8 * rows.size());
    return received;
  }

  /// One record of rank 0 for all ranks of the partner.
  template <class T>
  void send_record(const T& record) {
    static_assert(std::is_trivially_copyable_v<T>);
    send_bytes(&record, sizeof(T));
  }
  template <class T>
  T receive_record() {
    static_assert(std::is_trivially_copyable_v<T>);
    T record;
    receive_bytes(&record, sizeof(T));
    return record;
  }

  /// Both sides swap a text at the same point of the loop: rank 0's counts, the partner's is returned
  /// on all ranks.
  std::string swap_text(const std::string& mine);

  /// Called by both sides at the end of a window: true when both want to run on. A stop asked for
  /// on any rank of either side (signal) ends both after the same window.
  bool agree_to_continue(Continue wish = Continue::run);
  /// What the last agreement came to: the gravest wish of all ranks of both sides.
  Continue agreement() const { return agreement_; }

  /// Returns when every rank of both sides has called it. why: what a rank waits for.
  void meet(const char* why);

  /// Tells every partner rank that this side fails, without waiting for an answer, from any rank.
  void signal_failure(const std::string& reason) noexcept { world_.signal_failure(reason); }
  /// The orderly end of the link, when both sides are done and have written what they want to keep:
  /// afterwards either may end, and a launcher in a hurry kills the other as soon as one has.
  void close();

  const LinkStatistics& statistics() const { return statistics_; }

 private:
  using Words = std::vector<std::uint64_t>;  // cell numbers and doubles travel as words of 8 bytes
  void send_rows(const std::vector<CellId>& cells, const double* rows, int width);
  void receive_rows(std::vector<CellId>& cells, std::vector<double>& rows, int width);
  void post(int to, int tag, Words message);
  Words take(int from, int tag, const char* what);
  void finish_sends();
  void wait_for(MPI_Request& request, const char* what);
  void send_bytes(const void* bytes, std::size_t size);
  void receive_bytes(void* bytes, std::size_t size);
  void broadcast(void* bytes, std::size_t size);
  std::string from_rank_0(std::string text);
  void meet_before_the_end();

  const OwnWorld& world_;
  BulkPartition mine_, theirs_;
  std::vector<int> counterparts_;
  Waiting waiting_;
  LinkStatistics statistics_;
  Continue agreement_ = Continue::run;
  // Messages under way: they are done when the partner has them.
  std::list<Words> sent_;
  std::vector<MPI_Request> requests_;
};

}  // namespace demvof
