// SPDX-License-Identifier: GPL-3.0-or-later
// From the bulk grid to the fine mesh (paper, section 6; docs/theory.md).
//
//   force_f V_f = sum_b F_b w_f V_fb / W_b,   W_b = sum_f w_f V_fb      w: sharing_weights.hpp
//
// The velocity that the particles feel may differ from the mean that the implicit part of the force works on,
// sum w V u_f / W (a linear profile in the fine cells, a value at a point: fluid_to_bulk.cpp); the difference
// is taken from its reference:
//
//   F_b = -J/dt + C (u_ref - (u_seen - u_mean) - u)
//
// and a steady state is still not shifted by it. With order 2 u_ref goes with the fluid that is expected
// (continuation.hpp). In the fine cells of a bulk cell u_ref has a shape of mean
// 0,
//
//   lambda (u_f - u_b) + (1 - lambda) grad v . (x_f - X_b)
//
// u: of the window's start, lambda: momentum_exchange.hpp, v: velocity of the solid. Impulses are exchanged
// by subcells with every mapping.

#include "foam_side/particles_to_fine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupler/base/sphere.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "foam_side/fine_mesh.hpp"
#include "foam_side/nearest_fluid.hpp"
#include "foam_side/sharing_weights.hpp"
#include "foam_side/stress_of_other.hpp"

namespace demvof {

ParticlesToFine::ParticlesToFine(Flow& flow, const BulkCut& cut, SurfaceToBulk& surface,
                                 const CouplingParameters& coupling)
    : flow_(flow),
      cut_(cut),
      surface_(surface),
      coupling_(coupling),
      window_(coupling.window),
      state_(surface.fluids()) {
  distribute();
}

void ParticlesToFine::take(std::vector<InFluid> particles) {
  // At the start the particles are where they were.
  for (std::size_t k = 0; k < particles.size(); ++k)
    particles[k].before = solid_volume(taken_ ? state_[k].particles : particles[k].particles);
  go_on_from(std::move(particles));
}

void ParticlesToFine::go_on_from(std::vector<InFluid> state) {
  state_ = std::move(state);
  taken_ = true;
  distribute();
}

void ParticlesToFine::distribute() {
  const TouchedCells& cells = cut_.cells();
  touched_.clear();
  felt_shift_here_.clear();
  ahead_here_.clear();
  for (const InFluid& fluid : state_) {
    touched_.push_back(cells.fetch_from_owners(fluid.particles, BulkParticles{}));
    if (cut_.shifts_velocity()) felt_shift_here_.push_back(cells.fetch_from_owners(fluid.felt_shift, Vec3{}));
    if (coupling_.order == 2) ahead_here_.push_back(cells.fetch_from_owners(fluid.ahead, Vec3{}));
  }
  coefficient_part_.assign(state_.size(), std::vector<double>(cut_.subcells().size(), 0.0));
}

/// Volume and flux of the solid of each touched cell, of all fluids.
std::vector<ParticlesToFine::Solid> ParticlesToFine::solid() const {
  std::vector<Solid> all(cut_.cells().cells().size());
  for (const std::vector<BulkParticles>& touched : touched_)
    for (std::size_t slot = 0; slot < all.size(); ++slot) {
      all[slot].volume += touched[slot].solid_volume;
      all[slot].flux += touched[slot].solid_flux;
    }
  return all;
}

/// Per subcell of the cut, m/s: how much faster than in all of their bulk cell the particles are there.
std::vector<Vec3> ParticlesToFine::own_shape() const {
  const std::vector<Solid> solids = solid();
  constexpr int width = 4;  // 1 where there are particles; v
  std::vector<double> rows;
  for (const Solid& cell : solids) {
    const Vec3 v = cell.volume > 0 ? cell.flux / cell.volume : Vec3{};
    rows.insert(rows.end(), {cell.volume > 0 ? 1.0 : 0.0, v.x, v.y, v.z});
  }
  const std::vector<double> rise = cut_.remap().rises(cut_.subcells(), rows, width);
  std::vector<Vec3> shape;
  for (std::size_t i = 0; i < rise.size(); i += width) {
    const std::size_t cell = std::size_t(cut_.subcells()[i / width].slot) * width;
    Vec3& here = shape.emplace_back();  // neighbours without particles do not count
    for (int axis = 0; axis < 3 && rows[cell] > 0; ++axis)
      here[axis] = rise[i + 1 + axis] - rise[i] * rows[cell + 1 + axis];
  }
  return shape;
}

Foam::vectorField ParticlesToFine::solid_flux_density() const {
  const std::vector<Solid> solids = solid();
  std::vector<double> rows;
  for (const Solid& cell : solids) rows.insert(rows.end(), {cell.flux.x, cell.flux.y, cell.flux.z});
  const std::vector<double> density = cut_.remap().to_fine(rows, 3);
  Foam::vectorField result(flow_.mesh.nCells());
  forAll(result, cell) result[cell] = {density[3 * cell], density[3 * cell + 1], density[3 * cell + 2]};
  return result;
}

Foam::vectorField ParticlesToFine::solid_velocity() const {
  Foam::vectorField flux(flow_.mesh.nCells(), Foam::Zero);
  scalarField volume(flow_.mesh.nCells(), 0.0);
  for (const std::vector<BulkParticles>& touched : touched_)
    for (const Subcell& subcell : cut_.remap().subcells()) {
      const double share = subcell.volume / cut_.remap().bulk_volume()[subcell.slot];
      flux[subcell.fine] += share * to_foam(touched[subcell.slot].solid_flux);
      volume[subcell.fine] += share * touched[subcell.slot].solid_volume;
    }
  forAll(flux, cell) if (volume[cell] > 0) flux[cell] /= volume[cell];
  return flux;
}

/// Adds what is due to the fluid of bulk cells that the mesh has left to the cells nearest to them.
/// with_fluid: cells owned by this rank; sources: by touched cell.
void ParticlesToFine::give_to_fluid_beside(int k, const std::vector<CellId>& with_fluid,
                                           std::vector<FluidSource>& sources) {
  const CellValues<BulkParticles>& particles = state_[k].particles;
  std::vector<ForceOnCell> alone;
  double size = 0;  // of the forces, N
  for (std::size_t i = 0; i < particles.cells.size(); ++i) {
    const Vec3 force = fluid_source(coupling_.exchange, particles.values[i], window_).explicit_force;
    size += norm(force);
    if (norm(force) > 0 && !std::binary_search(with_fluid.begin(), with_fluid.end(), particles.cells[i]))
      alone.push_back({static_cast<double>(particles.cells[i]), force});
  }
  const std::vector<ForceOnCell> taken = to_nearest_fluid(cut_.grid(), alone, with_fluid);
  if (!taken.empty()) beside_.whole += window_ * Foam::returnReduce(size, Foam::sumOp<double>());
  const std::vector<CellId>& touched = cut_.cells().cells();
  for (const auto& [cell, force] : taken) {
    ++beside_.cells;
    beside_.impulse += window_ * norm(force);
    const auto place = std::lower_bound(touched.begin(), touched.end(), static_cast<CellId>(cell));
    if (place != touched.end() && *place == static_cast<CellId>(cell))
      sources[place - touched.begin()].explicit_force += force;
  }
}

void ParticlesToFine::spread_sources() {
  const std::vector<Subcell>& subcells = cut_.subcells();
  ParticleSource& source = *flow_.source;
  source.force = Foam::dimensionedVector(source.force.dimensions(), Foam::Zero);
  source.coefficient = dimensionedScalar(source.coefficient.dimensions(), Foam::Zero);
  source.reference = Foam::dimensionedVector(source.reference.dimensions(), Foam::Zero);
  const auto& volume = flow_.mesh.V();
  surface_.look();
  const SharingWeights weights(flow_, surface_, cut_, coupling_.sharing);
  beside_ = {};
  const bool changes = hands_back();  // the implicit part is for what changes
  const std::vector<Vec3> own_shapes = changes ? own_shape() : std::vector<Vec3>();
  for (int k = 0; k < surface_.fluids(); ++k) {
    std::vector<FluidSource> sources(touched_[k].size());
    for (std::size_t slot = 0; slot < sources.size(); ++slot) {
      sources[slot] = fluid_source(coupling_.exchange, touched_[k][slot], window_);
      if (cut_.shifts_velocity()) sources[slot].reference_velocity -= felt_shift_here_[k][slot];
      if (coupling_.order == 2) sources[slot].reference_velocity += (2 * done() - 1) * ahead_here_[k][slot];
    }
    // What the particles of a bulk cell have of their own in its fine cells.
    const auto shape = [&](std::size_t i) {
      if (!changes) return Vec3{};
      const double following = sources[subcells[i].slot].following;
      return following * to_vec3(flow_.U[subcells[i].fine]) + (1 - following) * own_shapes[i];
    };
    // Sums of w V over the fine cells of a bulk cell: of fluid k, and of all that is there when k has left
    // it; of w V times the shape for fluid k.
    struct Totals {
      double own = 0, all = 0;
      Vec3 shape;
    };
    std::vector<Totals> total(touched_[k].size());
    for (std::size_t i = 0; i < subcells.size(); ++i) {
      const Subcell& subcell = subcells[i];
      const double own = weights.of(k, subcell).force;
      total[subcell.slot].own += own;
      total[subcell.slot].shape += own * shape(i);
      total[subcell.slot].all += weights.of_any(subcell);
    }
    const CellValues<Totals> owned = cut_.cells().sum_to_owners(total);
    total = cut_.cells().fetch_from_owners(owned, Totals{});
    if (flow_.scene.mesh_moves) {  // else no bulk cell is left by it
      std::vector<CellId> with_fluid;
      for (std::size_t i = 0; i < owned.cells.size(); ++i)
        if (owned.values[i].all > 0) with_fluid.push_back(owned.cells[i]);
      give_to_fluid_beside(k, with_fluid, sources);
    }
    for (std::size_t i = 0; i < subcells.size(); ++i) {
      const Subcell& subcell = subcells[i];
      const FluidSource& bulk = sources[subcell.slot];
      const Totals& sum = total[subcell.slot];
      const double part =
          sum.own > 0 ? weights.of(k, subcell).force / sum.own : weights.of_any(subcell) / sum.all;
      const double share = part / volume[subcell.fine];
      coefficient_part_[k][i] = share * bulk.coefficient;
      source.force[subcell.fine] += share * to_foam(bulk.explicit_force);
      source.coefficient[subcell.fine] += coefficient_part_[k][i];
      Vec3 reference = bulk.reference_velocity;
      if (sum.own > 0) reference += shape(i) - sum.shape / sum.own;
      source.reference[subcell.fine] += coefficient_part_[k][i] * to_foam(reference);
    }
  }
  for (std::vector<double>& parts : coefficient_part_)
    for (std::size_t i = 0; i < subcells.size(); ++i) {
      const double whole = source.coefficient[subcells[i].fine];
      parts[i] = whole > 0 ? parts[i] / whole : 0;
    }
  forAll(source.coefficient, cell) if (source.coefficient[cell] > 0) source.reference[cell] /=
      source.coefficient[cell];
}

std::vector<CellValues<Vec3>> ParticlesToFine::collect_impulse() {
  volVectorField::Internal& given = flow_.source->implicit_impulse;
  const auto& volume = flow_.mesh.V();
  forAll(given, cell) collected_sum_ += volume[cell] * to_vec3(given[cell]);
  std::vector<CellValues<Vec3>> taken;
  if (hands_back_left_over(coupling_.exchange)) {
    const std::vector<Subcell>& subcells = cut_.subcells();
    for (const std::vector<double>& parts : coefficient_part_) {
      std::vector<Vec3> impulse(cut_.cells().cells().size());
      for (std::size_t i = 0; i < subcells.size(); ++i)
        impulse[subcells[i].slot] -= parts[i] * volume[subcells[i].fine] * to_vec3(given[subcells[i].fine]);
      taken.push_back(cut_.cells().sum_to_owners(impulse));
    }
  }
  given = Foam::dimensionedVector(given.dimensions(), Foam::Zero);
  return taken;
}

bool ParticlesToFine::hands_back() const {
  return hands_back_left_over(coupling_.exchange);
}

// -(1 - eps) V grad p dt of a fine cell goes to its subcells as they have solid of each fluid: the sum over a
// bulk cell is that of its own solid, however fine cells lie in bulk cells.
ParticlesToFine::LeftToParticles ParticlesToFine::left_to_particles(const Foam::vectorField& gradient) const {
  const std::vector<Subcell>& subcells = cut_.remap().subcells();
  const int fluids = static_cast<int>(state_.size());
  const std::vector<std::vector<double>> part = solid_in_subcells(solid_volumes(done())).by_fluid;
  std::vector<double> sum(static_cast<std::size_t>(flow_.mesh.nCells()), 0.0);
  for (int k = 0; k < fluids; ++k)
    for (std::size_t i = 0; i < subcells.size(); ++i) sum[subcells[i].fine] += part[k][i];
  const double dt = flow_.time.deltaTValue();
  LeftToParticles left;
  for (int k = 0; k < fluids; ++k) {
    const Foam::vectorField stress = stress_of_other(flow_, k, find_stress_in_cells(flow_));
    std::vector<OwedPressure::Left> here(cut_.cells().cells().size());
    for (std::size_t i = 0; i < subcells.size(); ++i) {
      const label cell = subcells[i].fine;
      if (!(sum[cell] > 0)) continue;
      const double exposed =
          part[k][i] / sum[cell] * dt * (1 - flow_.porosity->eps[cell]) * flow_.mesh.V()[cell];
      Vec3 others;  // of the weight of the other fluid in the fine cell
      if (surface_.is_cut(subcells[i].slot))
        others = (density_of(flow_, k) - density_between_particles(flow_, cell)) * to_vec3(flow_.g.value());
      others -= to_vec3(stress[cell]);
      here[subcells[i].slot].impulse -= exposed * (to_vec3(gradient[cell]) + others);
      left.smeared_weight -= exposed * others;
      here[subcells[i].slot].exposed += exposed;
    }
    CellValues<OwedPressure::Left>& cells = left.by_fluid.emplace_back(cut_.cells().sum_to_owners(here));
    for (std::size_t i = 0; i < cells.cells.size(); ++i) {
      const double* then = find(state_[k].before, cells.cells[i]);
      const BulkParticles* now = find(state_[k].particles, cells.cells[i]);
      cells.values[i].solid_volume =
          (1 - done()) * (then ? *then : 0) + done() * (now ? now->solid_volume : 0);
    }
  }
  return left;
}

void ParticlesToFine::end_window() {
  implicit_impulse_ = std::exchange(collected_sum_, Vec3{});
}

ParticlesToFine::Impulses ParticlesToFine::impulses() const {
  const ParticleSource& source = *flow_.source;
  vector explicit_force = vector::zero, implicit_impulse = to_foam(implicit_impulse_);
  forAll(source.force, cell) explicit_force += flow_.mesh.V()[cell] * source.force[cell];
  Foam::reduce(explicit_force, Foam::sumOp<vector>());
  Foam::reduce(implicit_impulse, Foam::sumOp<vector>());
  return {window_ * to_vec3(explicit_force), to_vec3(implicit_impulse)};
}

}  // namespace demvof
