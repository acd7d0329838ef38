// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/bridge.hpp"

#include <utility>

namespace demvof {

Bridge::Bridge(Flow& flow, const CaseParameters& parameters, const BulkGrid& grid,
               const BulkPartition& partition, MPI_Comm world)
    : cut_(flow.mesh, parameters.coupling.mapping, grid, partition, world),
      fluid_to_bulk_(flow, cut_, parameters.forces, parameters.coupling.sharing),
      particles_to_fine_(flow, cut_, parameters.coupling),
      told_({parameters.coupling.schedule, parameters.coupling.exchange, parameters.coupling.window,
             grid.cell_volume(), flow.porosity != nullptr}) {}

void Bridge::remap() {
  cut_.renew();
  fluid_to_bulk_.renew();
  particles_to_fine_.renew();
}

void Bridge::take(CellValues<BulkParticles> particles) {
  left_over_.return_to_fluid(particles);
  cut_.activate(particles.cells);
  particles_to_fine_.take(std::move(particles), shift_);
}

void Bridge::collect_impulse() {
  left_over_.collect(particles_to_fine_.collect_impulse(), particles_to_fine_.particles());
}

void Bridge::end_window() {
  collect_impulse();
  particles_to_fine_.end_window();
  left_over_.end_window(particles_to_fine_.particles());
}

CellValues<BulkFluid> Bridge::bulk_fluid() {
  CellValues<BulkFluid> fluid = fluid_to_bulk_.means(shift_);
  left_over_.hand_over(fluid);
  told_.relax(fluid, particles_to_fine_.particles());
  return fluid;
}

CellValues<BulkFluidGradients> Bridge::bulk_fluid_gradients() {
  CellValues<BulkFluidGradients> gradients = fluid_to_bulk_.gradients();
  told_.relax(gradients);
  return gradients;
}

CellId Bridge::active_cells() const {
  return Foam::returnReduce(static_cast<label>(particles_to_fine_.particles().cells.size()),
                            Foam::sumOp<label>());
}

ToldFluid::Relaxed Bridge::relaxed() const {
  return {Foam::returnReduce(told_.relaxed().smallest, Foam::minOp<double>()),
          Foam::returnReduce(told_.relaxed().cells, Foam::sumOp<long>())};
}

Bridge::State Bridge::state() const {
  return {particles_to_fine_.particles(), left_over_.owed(), particles_to_fine_.felt_shift(), told_.cells()};
}

void Bridge::go_on_from(State state) {
  cut_.activate(state.particles.cells);
  particles_to_fine_.go_on_from(std::move(state.particles), std::move(state.felt_shift));
  left_over_.go_on_from(std::move(state.left_over));
  told_.go_on_from(std::move(state.told));
}

}  // namespace demvof
