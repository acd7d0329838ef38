// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/link/own_world.hpp"

namespace demvof {

/// The partner is gone (killed, failed, silent beyond the time-out). Exit code 4.
struct PartnerLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A solver library (OpenFOAM, LIGGGHTS) ended the program on its own. Exit code 3.
struct SolverStopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The run failed while in a known stage. Exit code 3. what(): side, stage, time, what to try.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One fact that both sides must agree on before a run. Numbers agree within the relative tolerance
/// (absolute where the larger magnitude is below 1e-300); tolerance < 0: compare text exactly.
struct HandshakeItem {
  std::string key;      // as in the case file where there is such a key
  std::string value;    // text, or numbers separated by blanks
  double tolerance = -1;
};

struct LinkStatistics {
  double waiting_seconds = 0;       // this rank, waiting for the partner
  double exchange_seconds = 0;      // this rank, packing and moving data, waiting apart
  std::int64_t bytes_sent = 0, bytes_received = 0;  // this rank
  std::int64_t cells_sent = 0, cells_received = 0;
};

/// How a side wants the run to go on; travels with every window.
enum class Continue : int { run = 0, stop_requested = 1, failed = 2 };

/// The way between the two programs: an MPI intercommunicator on which each owner of bulk cells
/// talks only to the partner's owners of the same cells. Waiting is passive and bounded.
class Link {
 public:
  /// Collective over both programs.
  Link(const OwnWorld& world, CellId bulk_cells, double time_out_seconds);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Ownership of bulk cells in this program and in the partner.
  const BulkPartition& mine() const { return mine_; }
  const BulkPartition& theirs() const { return theirs_; }

  /// Compares every item with the partner's; items that only one side gives are not compared.
  /// Throws InputError on both sides, on all ranks, with one line per disagreement:
  /// the key and both values. facts: free text for the partner (JSON), returned is the partner's.
  std::string handshake(const std::vector<HandshakeItem>& items, const std::string& facts);

  /// Sends the values of cells owned by this rank. Every rank calls it, with or without cells.
  template <class T> void send(const CellValues<T>& owned);
  /// Receives the values for the cells owned by this rank, as the partner sent them.
  template <class T> CellValues<T> receive();

  /// Both roots swap a text at the same point of the loop; returned on all ranks.
  std::string swap_text(const std::string& mine);

  /// Called by both sides at the end of a window: true when both want to run on. A stop asked for
  /// on any rank of either side (signal) ends both after the same window.
  bool agree_to_continue(Continue wish);

  /// Tells every partner rank that this side fails, without waiting for an answer, from any rank.
  void cry_for_help(const std::string& reason) noexcept;
  /// The orderly end of the link, when both sides are done.
  void close();

  const LinkStatistics& statistics() const { return statistics_; }

 private:
  void send_rows(const std::vector<CellId>& cells, const double* rows, int width);
  void receive_rows(std::vector<CellId>& cells, std::vector<double>& rows, int width);
  BulkPartition mine_, theirs_;
  LinkStatistics statistics_;
  // the rest is the implementer's choice
};

}  // namespace demvof
