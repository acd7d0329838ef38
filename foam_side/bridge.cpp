// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/bridge.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "coupler/base/mpi_check.hpp"
#include "foam_side/pressure_gradient.hpp"
#include "foam_side/vectors.hpp"
#include "foam_side/window_means.hpp"

namespace demvof {
namespace {

/// Cells with particles in any of the fluids.
template <class List, class Cells>
std::vector<CellId> united(const List& fluids, const Cells& cells_of) {
  std::vector<CellId> all;
  for (const auto& fluid : fluids) {
    std::vector<CellId> more;
    std::set_union(all.begin(), all.end(), cells_of(fluid).begin(), cells_of(fluid).end(),
                   std::back_inserter(more));
    all = std::move(more);
  }
  return all;
}

}  // namespace

Bridge::Bridge(Flow& flow, const CaseParameters& parameters, const BulkGrid& grid,
               const BulkPartition& partition, MPI_Comm world)
    : flow_(flow),
      owes_pressure_(flow.porosity && parameters.forces.pressure_gradient),
      tells_jump_(parameters.forces.capillary),
      of_order_two_(parameters.coupling.order == 2),
      accelerates_(need_acceleration(parameters.forces)),
      world_(world),
      window_(parameters.coupling.window),
      cut_(flow.mesh, parameters.coupling.mapping, grid, partition, world),
      openings_(cut_),
      surface_(flow, cut_),
      fluid_to_bulk_(flow, cut_, surface_, parameters.forces, parameters.coupling.sharing),
      particles_to_fine_(flow, cut_, surface_, parameters.coupling),
      left_over_(surface_.fluids()),
      seen_(surface_.fluids(),
            SeenFluid({parameters.coupling.schedule, parameters.coupling.exchange, parameters.coupling.window,
                       flow.porosity != nullptr, parameters.coupling.order, parameters.forces.added_mass})),
      owed_pressure_(surface_.fluids()),
      shift_(surface_.fluids()) {}

void Bridge::remap() {
  cut_.renew();
  surface_.look();
  fluid_to_bulk_.renew();
  particles_to_fine_.renew();
}

void Bridge::take(std::vector<CellValues<BulkParticles>> particles) {
  for (std::size_t k = 0; k < particles.size(); ++k) {
    seen_[k].refer_to_own_cell(particles[k]);
    left_over_[k].return_to_fluid(particles[k]);
    owed_pressure_[k].return_to_fluid(particles[k]);
  }
  cut_.activate(united(
      particles, [](const auto& fluid) -> const auto& { return fluid.cells; }));
  std::vector<ParticlesToFine::InFluid> taken;
  for (std::size_t k = 0; k < particles.size(); ++k)
    taken.push_back({std::move(particles[k]), shift_[k], seen_[k].ahead(), {}});
  particles_to_fine_.take(std::move(taken));
}

void Bridge::collect_impulse() {
  const std::vector<CellValues<Vec3>> impulse = particles_to_fine_.collect_impulse();
  for (std::size_t k = 0; k < impulse.size(); ++k)
    left_over_[k].collect(impulse[k], particles_to_fine_.particles(static_cast<int>(k)));
}

bool Bridge::owe(const Vec3& position, const Vec3& impulse) {
  const CellId cell = cut_.grid().id(cut_.grid().locate(position));
  for (std::size_t k = 0; k < left_over_.size(); ++k) {
    const CellValues<BulkParticles>& particles = particles_to_fine_.particles(static_cast<int>(k));
    const BulkParticles* here = find(particles, cell);
    const bool takes = here && here->drag_factor > 0;
    if (!particles_to_fine_.hands_back() || !Foam::returnReduce(takes, Foam::orOp<bool>())) continue;
    if (takes) {
      left_over_[k].collect({{cell}, {-impulse}}, particles);
      particles_to_fine_.count_given(impulse);
    }
    return true;
  }
  return false;
}

void Bridge::collect_pressure() {
  if (of_order_two_) add_to_window_means(flow_, tells_jump_ || !flow_.porosity, accelerates_);
  if (!flow_.porosity) return;
  const Foam::vectorField gradient = pressure_gradient(flow_, tells_jump_);
  const auto left = particles_to_fine_.left_to_particles(gradient);
  for (std::size_t k = 0; k < left.by_fluid.size(); ++k) {
    if (owes_pressure_)
      owed_pressure_[k].collect(left.by_fluid[k], flow_.time.deltaTValue());
    else
      for (const OwedPressure::Left& cell : left.by_fluid[k].values) unclaimed_ += cell.impulse;
  }
  if (owes_pressure_)
    smeared_weight_ += left.smeared_weight;
  else
    unclaimed_ -= left.smeared_weight;
  if (!flow_.scene.surface_tension || tells_jump_) return;
  const Foam::vectorField whole = pressure_gradient(flow_, true);
  const double dt = flow_.time.deltaTValue();
  forAll(whole, cell) tension_ +=
      dt * (1 - flow_.porosity->eps[cell]) * flow_.mesh.V()[cell] * to_vec3(whole[cell] - gradient[cell]);
}

Bridge::PressureImpulses Bridge::pressure_impulses() const {
  PressureImpulses all;
  for (const OwedPressure& fluid : owed_pressure_) {
    all.seen += fluid.seen();
    all.owed += fluid.owed_in_all();
    all.returned += fluid.returned();
    all.turnover += fluid.turnover();
    all.held_back.cells += fluid.held_back().cells;
    all.held_back.impulse += fluid.held_back().impulse;
    all.held_back.told += fluid.held_back().told;
  }
  all.tension = tension_;
  all.smeared_weight = smeared_weight_;
  all.seen += unclaimed_;
  for (Vec3* part : {&all.seen, &all.owed, &all.returned, &all.tension, &all.smeared_weight})
    *part = to_vec3(Foam::returnReduce(to_foam(*part), Foam::sumOp<vector>()));
  Foam::reduce(all.turnover, Foam::sumOp<double>());
  Foam::reduce(all.held_back.cells, Foam::sumOp<long>());
  Foam::reduce(all.held_back.impulse, Foam::sumOp<double>());
  Foam::reduce(all.held_back.told, Foam::sumOp<double>());
  return all;
}

void Bridge::end_window() {
  collect_impulse();
  particles_to_fine_.end_window();
  for (std::size_t k = 0; k < left_over_.size(); ++k)
    left_over_[k].end_window(particles_to_fine_.particles(static_cast<int>(k)));
  for (std::size_t k = 0; k < left_over_.size(); ++k)
    owed_pressure_[k].end_window(particles_to_fine_.particles(static_cast<int>(k)));
}

WindowChange Bridge::change(double largest_speed) {
  surface_.look();
  means_ = fluid_to_bulk_.means();
  struct Cell {                                                      // of all fluids
    double late = 0, solid_volume = 0, moved = 0, fluid_volume = 0;  // sum of V dv, m4/s; m3
  };
  std::map<CellId, Cell> cells;
  for (int k = 0; k < static_cast<int>(means_.size()); ++k) {
    const CellValues<BulkFluid>& now = means_[k].fluid;
    const ParticlesToFine::InFluid& particles = particles_to_fine_.state()[k];
    for (std::size_t i = 0; i < now.cells.size(); ++i) {
      const CellId id = now.cells[i];
      const BulkParticles* here = find(particles.particles, id);
      const SeenFluid::Cell* told = find(seen_[k].cells(), id);
      if (!here || !(now.values[i].density > 0)) continue;
      const double* before = find(particles.before, id);
      Cell& cell = cells[id];
      cell.moved += here->solid_volume - (before ? *before : 0);
      cell.fluid_volume += means_[k].fluid_volume[i];
      cell.solid_volume += here->solid_volume;
      if (told)
        cell.late += here->solid_volume *
                     late_velocity(*here, now.values[i].velocity - told->expected_at_end(),
                                   now.values[i].pressure_gradient - told->pressure_gradient, window_);
    }
  }
  WindowChange change;
  LateVelocities late;
  for (const auto& [id, cell] : cells) {
    if (cell.solid_volume > 0) late.add(cell.late / cell.solid_volume, cell.solid_volume);
    change.void_fraction = std::max(change.void_fraction, std::abs(cell.moved) / cell.fluid_volume);
  }
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, late.volumes.data(), static_cast<int>(late.volumes.size()),
                          MPI_DOUBLE, MPI_SUM, world_),
            "MPI_Allreduce");
  change.velocity = late.all_but(1e-2);
  Foam::reduce(change.void_fraction, Foam::maxOp<double>());
  const Vec3 width = cut_.grid().spacing();
  change.way = largest_speed * window_ / std::min({width.x, width.y, width.z});
  return change;
}

void Bridge::set_window(double window) {
  pace_ = window_ > 0 ? std::min(1.0, window / window_) : 1;
  window_ = window;
  for (SeenFluid& fluid : seen_) fluid.set_window(window);
  particles_to_fine_.set_window(window);
}

void Bridge::follow_gravity(const Vec3& gravity) {
  const Vec3 change = set_gravity(flow_, gravity);
  for (SeenFluid& fluid : seen_) fluid.change_gravity(change);
  if (norm(change) > 0) means_.clear();
}

std::vector<CellValues<BulkFluid>> Bridge::bulk_fluids() {
  if (means_.empty()) {
    surface_.look();
    means_ = fluid_to_bulk_.means();
  }
  tension_ = unclaimed_ = smeared_weight_ = {};
  std::vector<CellValues<BulkFluid>> fluids;
  int k = 0;
  for (FluidToBulk::Means& means : std::exchange(means_, {})) {
    shift_[k] = {means.fluid.cells, std::move(means.shift)};
    left_over_[k].hand_over(means.fluid);
    seen_[k].relax(means.fluid, means.fluid_volume, particles_to_fine_.particles(k));
    if (owes_pressure_)
      owed_pressure_[k].tell(means.fluid, seen_[k].factors(), particles_to_fine_.particles(k), window_,
                             pace_);
    fluids.push_back(std::move(means.fluid));
    ++k;
  }
  return fluids;
}

std::vector<CellValues<BulkFluidGradients>> Bridge::bulk_fluid_gradients() {
  std::vector<CellValues<BulkFluidGradients>> gradients = fluid_to_bulk_.gradients();
  for (std::size_t k = 0; k < gradients.size(); ++k) seen_[k].relax(gradients[k]);
  return gradients;
}

CellId Bridge::active_cells() const {
  const std::vector<CellId> cells = united(
      particles_to_fine_.state(), [](const auto& fluid) -> const auto& { return fluid.particles.cells; });
  return Foam::returnReduce(static_cast<label>(cells.size()), Foam::sumOp<label>());
}

Vec3 Bridge::kept_left_over() const {
  Vec3 kept;
  for (const LeftOver& fluid : left_over_) kept += fluid.kept();
  return to_vec3(Foam::returnReduce(to_foam(kept), Foam::sumOp<vector>()));
}

SeenFluid::Relaxed Bridge::relaxed() const {
  SeenFluid::Relaxed all;
  for (const SeenFluid& seen : seen_) {
    all.smallest = std::min(all.smallest, seen.relaxed().smallest);
    all.cells += seen.relaxed().cells;
  }
  return {Foam::returnReduce(all.smallest, Foam::minOp<double>()),
          Foam::returnReduce(all.cells, Foam::sumOp<long>())};
}

std::vector<Bridge::State> Bridge::state() const {
  std::vector<State> state;
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    const ParticlesToFine::InFluid& fluid = particles_to_fine_.state()[k];
    state.push_back({fluid.particles, left_over_[k].owed(), fluid.felt_shift, fluid.before, seen_[k].cells(),
                     owed_pressure_[k].state()});
  }
  return state;
}

void Bridge::go_on_from(std::vector<State> state) {
  cut_.activate(united(
      state, [](const State& fluid) -> const auto& { return fluid.particles.cells; }));
  std::vector<ParticlesToFine::InFluid> particles;
  for (std::size_t k = 0; k < state.size(); ++k) {
    particles.push_back({std::move(state[k].particles),
                         std::move(state[k].felt_shift),
                         {},
                         std::move(state[k].solid_volume_before)});
    left_over_[k].go_on_from(std::move(state[k].left_over));
    seen_[k].go_on_from(std::move(state[k].seen));
    owed_pressure_[k].go_on_from(state[k].owed_pressure);
  }
  particles_to_fine_.go_on_from(std::move(particles));
}

}  // namespace demvof
