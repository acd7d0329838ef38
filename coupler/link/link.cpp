// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/link.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/grid/sparse_exchange.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/link/signals.hpp"
#include "coupler/link/text_message.hpp"

namespace demvof {
namespace {

constexpr int tag_rows = 1, tag_text = 2, tag_record = 3;
constexpr std::size_t header_words = 2;  // of a message with rows: row width, number of cells
constexpr std::uint64_t word = sizeof(std::uint64_t);

RankOrder order_of(Side side) {
  return side == Side::fluid ? RankOrder::x_fastest : RankOrder::z_fastest;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Link::Link(const OwnWorld& world, const std::array<int, 3>& bulk_cells, double time_out_seconds)
    : world_(world),
      mine_(bulk_cells, world.size(), order_of(world.side())),
      theirs_(bulk_cells, world.partner_size(), order_of(partner_of(world.side()))),
      waiting_(world, time_out_seconds) {
  if (world.partner_size() == 0)
    throw InputError(
        fmt::format("{} was started without {}.\n"
                    "What to do: demvof run case.yaml, or mpirun -np 2 demvof_pair -np 1 foam_side case.yaml "
                    "+ -np 1 dem_side case.yaml",
                    program_name(world.side()), program_name(partner_of(world.side()))));
  counterparts_ = counterparts(mine_, world.rank(), theirs_);
  prctl(PR_SET_TIMERSLACK, 1000UL);  // ns: the kernel's 50 us would blunt the short pauses of a wait
}

Link::~Link() {
  // Left by an exception: what is still under way must not be overwritten before the process ends.
  if (!requests_.empty()) new std::list<Words>(std::move(sent_));
}

void Link::post(int to, int tag, Words message) {
  sent_.push_back(std::move(message));
  requests_.emplace_back();
  check_mpi(MPI_Isend(sent_.back().data(), static_cast<int>(sent_.back().size()), MPI_UINT64_T, to, tag,
                      world_.pair().partner, &requests_.back()),
            "MPI_Isend to the partner");
}

Link::Words Link::take(int from, int tag, const char* what) {
  MPI_Message message;
  MPI_Status status;
  statistics_.waiting_seconds += waiting_.wait(
      [&] {
        int there = 0;
        check_mpi(MPI_Improbe(from, tag, world_.pair().partner, &there, &message, &status), "MPI_Improbe");
        return there != 0;
      },
      [&] { return fmt::format("{} from {}", what, world_.partner(from).name()); });
  int count = 0;
  check_mpi(MPI_Get_count(&status, MPI_UINT64_T, &count), "MPI_Get_count");
  Words words(count);
  MPI_Request request;
  check_mpi(MPI_Imrecv(words.data(), count, MPI_UINT64_T, &message, &request), "MPI_Imrecv");
  waiting_.wait(
      [&] {
        int done = 0;
        check_mpi(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "MPI_Test of a receive");
        return done != 0;
      },
      [&] { return fmt::format("the rest of {} from {}", what, world_.partner(from).name()); });
  return words;
}

void Link::wait_for(MPI_Request& request, const char* what) {
  statistics_.waiting_seconds += waiting_.wait(
      [&] {
        int done = 0;
        check_mpi(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "MPI_Test");
        return done != 0;
      },
      [&] { return std::string(what); });
}

void Link::finish_sends() {
  if (requests_.empty()) return;
  statistics_.waiting_seconds += waiting_.wait(
      [&] {
        int done = 0;
        check_mpi(
            MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE),
            "MPI_Testall of the messages sent");
        return done != 0;
      },
      [&] { return fmt::format("{} to take what was sent", program_name(partner_of(world_.side()))); });
  requests_.clear();
  sent_.clear();
}

void Link::send_rows(const std::vector<CellId>& cells, const double* rows, int width) {
  for (const CellId cell : cells)
    if (mine_.owner(cell) != world_.rank()) throw std::logic_error("Link::send: a bulk cell of another rank");
  finish_sends();
  const double begin = now();
  const RowsByRank by_rank =
      rows_by_rank(cells.size(), [&](std::size_t i) { return theirs_.owner(cells[i]); });
  auto next = by_rank.of_rank.begin();
  for (const int other : counterparts_) {
    RowsOfRank part{other, 0, 0};
    if (next != by_rank.of_rank.end() && next->rank == other) part = *next++;
    Words message(header_words + part.count * (1 + width));
    message[0] = width;
    message[1] = part.count;
    for (std::size_t i = 0; i < part.count; ++i) {
      const std::size_t row = by_rank.rows[part.first + i];
      std::memcpy(&message[header_words + i], &cells[row], word);
      std::memcpy(&message[header_words + part.count + i * width], rows + row * width, word * width);
    }
    statistics_.bytes_sent += static_cast<std::int64_t>(word * message.size());
    statistics_.cells_sent += static_cast<std::int64_t>(part.count);
    post(other, tag_rows, std::move(message));
  }
  statistics_.exchange_seconds += now() - begin;
}

void Link::receive_rows(std::vector<CellId>& cells, std::vector<double>& rows, int width) {
  const double begin = now(), waited_before = statistics_.waiting_seconds;
  std::vector<Words> messages;
  std::vector<std::pair<CellId, const std::uint64_t*>> row_of;  // of each cell
  for (const int other : counterparts_) {
    const Words& message = messages.emplace_back(take(other, tag_rows, "bulk cells"));
    const std::size_t count = message.size() < header_words ? 0 : message[1];
    if (message.size() != header_words + count * (1 + width) ||
        message[0] != static_cast<std::uint64_t>(width))
      throw std::logic_error("Link::receive: the partner sent another kind of record");
    const std::uint64_t* numbers = message.data() + header_words;
    for (std::size_t i = 0; i < count; ++i)
      row_of.emplace_back(static_cast<CellId>(numbers[i]), numbers + count + i * width);
    statistics_.bytes_received += static_cast<std::int64_t>(word * message.size());
  }
  std::sort(row_of.begin(), row_of.end());
  rows.resize(row_of.size() * width);
  for (const auto& [cell, row] : row_of) {
    std::memcpy(&rows[cells.size() * width], row, word * width);
    cells.push_back(cell);
  }
  statistics_.cells_received += static_cast<std::int64_t>(cells.size());
  statistics_.exchange_seconds += now() - begin - (statistics_.waiting_seconds - waited_before);
}

std::string Link::swap_text(const std::string& mine) {
  finish_sends();
  if (world_.rank() != 0) return from_rank_0({});
  post(0, tag_text, words_of(mine));
  return from_rank_0(text_in(take(0, tag_text, "a report")));
}

void Link::send_bytes(const void* bytes, std::size_t size) {
  finish_sends();
  if (world_.rank() != 0) return;
  Words message((size + word - 1) / word);
  std::memcpy(message.data(), bytes, size);
  post(0, tag_record, std::move(message));
}

void Link::receive_bytes(void* bytes, std::size_t size) {
  finish_sends();
  if (world_.rank() == 0) {
    const Words message = take(0, tag_record, "a report");
    if (message.size() != (size + word - 1) / word)
      throw std::logic_error("Link::receive_record: the partner sent another kind of record");
    std::memcpy(bytes, message.data(), size);
  }
  broadcast(bytes, size);
}

void Link::broadcast(void* bytes, std::size_t size) {
  MPI_Request request;
  check_mpi(MPI_Ibcast(bytes, static_cast<int>(size), MPI_BYTE, 0, world_.comm(), &request), "MPI_Ibcast");
  wait_for(request, "rank 0 of this program");
}

std::string Link::from_rank_0(std::string text) {
  auto length = static_cast<std::uint64_t>(text.size());
  broadcast(&length, sizeof(length));
  text.resize(length);
  broadcast(text.data(), length);
  return text;
}

void Link::meet(const char* why) {
  MPI_Request request;
  check_mpi(MPI_Ibarrier(world_.pair().both, &request), "MPI_Ibarrier");
  wait_for(request, why);
}

// A verdict that all ranks of both sides come to ends them all: nobody leaves before everybody has it.
// Who is through may already be crying while others still wait here, and that is no news to them.
void Link::meet_before_the_end() {
  try {
    meet("the others to hear of the disagreement");
  } catch (const PartnerFailed&) {
  } catch (const FellowFailed&) {
  }
}

bool Link::agree_to_continue(Continue wish) {
  waiting_.set_up_done();
  if (wish == Continue::run && stop_requested()) wish = Continue::stop_requested;
  int gravest[] = {static_cast<int>(wish), in_a_hurry()};
  MPI_Request request;
  check_mpi(MPI_Iallreduce(MPI_IN_PLACE, gravest, 2, MPI_INT, MPI_MAX, world_.pair().both, &request),
            "MPI_Iallreduce");
  wait_for(request, "all ranks of both sides to end the window");
  agreement_ = static_cast<Continue>(gravest[0]);
  world_.pair().in_a_hurry = gravest[1] != 0;
  return agreement_ == Continue::run;
}

void Link::close() {
  finish_sends();
  meet("all ranks of both sides to end the run");
  world_.pair().watch->stand_down();
}

}  // namespace demvof
