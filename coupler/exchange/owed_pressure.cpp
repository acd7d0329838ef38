// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/owed_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "coupler/exchange/momentum_exchange.hpp"

namespace demvof {
namespace {

// Most by which a told gradient is changed, of the steepest that has been in the cell. A cell whose particles
// lie in the other fluid but for a millionth owes them round-off over nothing: up to 1e9 Pa/m, which would be
// handed to a particle that the surface has wetted since.
constexpr double most_of_gradient = 10;

}  // namespace

void OwedPressure::tell(CellValues<BulkFluid>& fluid, const std::vector<double>& relaxation,
                        const CellValues<BulkParticles>& particles, double window, double pace) {
  seen_ = {};
  heard_.clear();
  held_back_ = {};
  for (std::size_t i = 0; i < fluid.cells.size(); ++i) {
    const CellId cell = fluid.cells[i];
    const BulkParticles* here = find(particles, cell);
    if (!here || !(here->solid_volume > 0) || !(fluid.values[i].density > 0)) continue;
    Vec3& gradient = fluid.values[i].pressure_gradient;
    const Vec3 given = -(here->solid_volume * window) * gradient;
    heard_[cell] = {here->solid_volume, gradient};
    open_[cell] -= given;
    seen_ += given;
    held_back_.told += norm(given);
    const auto owed = owed_.find(cell);
    if (owed == owed_.end()) continue;
    Vec3 part = 0.5 * pace * relaxation[i] * owed->second.impulse;
    const double steepest = std::max(steepest_[cell], norm(gradient));
    const double most = most_of_gradient * steepest * here->solid_volume * window;
    if (const double size = norm(part); size > most) {
      part *= most / size;
      ++held_back_.cells;
      held_back_.impulse += size - most;
    }
    gradient -= part / (here->solid_volume * window);
    owed->second.impulse -= part;
    seen_ += part;
  }
}

void OwedPressure::collect(const CellValues<Left>& left, double step) {
  for (std::size_t i = 0; i < left.cells.size(); ++i) {
    const CellId cell = left.cells[i];
    const auto& [impulse, exposed, solid_volume] = left.values[i];
    const auto heard = heard_.find(cell);
    const double moved =
        solid_volume - (heard == heard_.end() ? 0 : heard->second.solid_volume);  // V_e - V_s
    Vec3 not_theirs;
    if (exposed > 0) steepest_[cell] = std::max(steepest_[cell], norm(impulse) / exposed);
    if (exposed > 0)
      not_theirs = moved * step / exposed * impulse;
    else if (heard != heard_.end())
      not_theirs = -moved * step * heard->second.gradient;
    if (norm(not_theirs) > 0) elsewhere_[cell] += not_theirs;
    if (norm(impulse - not_theirs) > 0) open_[cell] += impulse - not_theirs;
  }
}

void OwedPressure::end_window(const CellValues<BulkParticles>& particles) {
  for (const auto& [cell, impulse] : open_) owed_[cell].impulse += impulse;
  open_.clear();
  returned_ = std::exchange(on_its_way_, Vec3{});
  turnover_ = std::exchange(turnover_on_its_way_, 0.0);
  for (auto owed = owed_.begin(); owed != owed_.end();) {
    const BulkParticles* here = find(particles, owed->first);
    // Where no particle is there is none to take a part of it.
    owed->second.solid_volume = here && here->solid_volume > 0 ? here->solid_volume : HUGE_VAL;
    owed = norm(owed->second.impulse) > 0 ? std::next(owed) : owed_.erase(owed);
  }
  for (auto steepest = steepest_.begin(); steepest != steepest_.end();)
    steepest = owed_.count(steepest->first) > 0 ? std::next(steepest) : steepest_.erase(steepest);
}

void OwedPressure::return_to_fluid(CellValues<BulkParticles>& particles) {
  const auto give = [&](CellId cell, const Vec3& back) {
    const auto place = std::lower_bound(particles.cells.begin(), particles.cells.end(), cell);
    const auto slot = place - particles.cells.begin();
    if (place == particles.cells.end() || *place != cell) {
      particles.cells.insert(place, cell);
      particles.values.insert(particles.values.begin() + slot, BulkParticles{});
    }
    particles.values[slot].drag_impulse -= back;
    on_its_way_ += back;
    turnover_on_its_way_ += norm(back);
  };
  for (auto& [cell, owed] : owed_) {
    const BulkParticles* here = find(particles, cell);
    const Vec3 back =
        (1 - share_for_particles(owed.solid_volume, here ? here->solid_volume : 0)) * owed.impulse;
    if (norm(back) == 0) continue;
    give(cell, back);
    owed.impulse -= back;
  }
  for (const auto& [cell, impulse] : elsewhere_) give(cell, impulse);
  elsewhere_.clear();
}

Vec3 OwedPressure::owed_in_all() const {
  Vec3 sum = on_its_way_;
  for (const auto& [cell, owed] : owed_) sum += owed.impulse;
  for (const auto& [cell, impulse] : elsewhere_) sum += impulse;
  return sum;
}

namespace {

template <class T>
CellValues<T> as_cells(const std::map<CellId, T>& of) {
  CellValues<T> all;
  for (const auto& [cell, value] : of) {
    all.cells.push_back(cell);
    all.values.push_back(value);
  }
  return all;
}

template <class T>
std::map<CellId, T> as_map(const CellValues<T>& of) {
  std::map<CellId, T> all;
  for (std::size_t i = 0; i < of.cells.size(); ++i) all[of.cells[i]] = of.values[i];
  return all;
}

}  // namespace

OwedPressure::State OwedPressure::state() const {
  return {as_cells(owed_), as_cells(elsewhere_), as_cells(steepest_), on_its_way_, turnover_on_its_way_};
}

void OwedPressure::go_on_from(const State& state) {
  owed_ = as_map(state.owed);
  elsewhere_ = as_map(state.elsewhere);
  steepest_ = as_map(state.steepest);
  on_its_way_ = state.on_its_way;
  turnover_on_its_way_ = state.turnover;
}

}  // namespace demvof
