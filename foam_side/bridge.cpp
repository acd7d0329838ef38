// SPDX-License-Identifier: GPL-3.0-or-later
// Mapping between the fine mesh and the bulk grid (paper, section 6; docs/theory.md).
//
//   to the bulk grid   q_b = sum_f w_f V_fb q_f / sum_f w_f V_fb      V_fb: volume of fine cell f in bulk
//   cell b to the fine mesh   force_f V_f = sum_b F_b w_f V_fb / W_b         W_b = sum_f w_f V_fb
//
// with w = eps rho (coupling.sharing: mass; every fine cell of a bulk cell gets the same
// acceleration) or w = 1 (volume).
//
// In a fine cell that lies in several bulk cells u and grad p have a linear profile (conservative), so that
// its pieces differ: q_fb = q_f + grad q_f . (X_fb - X_f), whose mean is q_f. Or they are values at the
// centre of the bulk cell (sample_fluid.hpp). Either way the particles feel another velocity than the mean
// that the implicit part of the force works on, sum w V u_f / W; the difference is taken from its reference:
//
//   F_b = -J/dt + C (u_ref - (u_told - u_mean) - u)
//
// and a steady state is still not shifted by it. Impulses are exchanged by pieces with every mapping.

#include "foam_side/bridge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/exchange/relaxation.hpp"
#include "foam_side/cell_field.hpp"
#include "foam_side/fine_mesh.hpp"
#include "leastSquaresGrad.H"

namespace demvof {

namespace {

// Below this the drag and pressure terms of the porous equations lose their meaning (closest packing
// of spheres of one size leaves 0.26).
constexpr double smallest_void_fraction = 0.05;

// A bulk cell is full of fluid mesh up to what the corners of a mesh, as written in its file, leave open.
constexpr double full = 1 - 1e-6;

/// Sums over the fine cells of a bulk cell that give its BulkFluid.
struct FluidSums {
  Vec3 weighted_velocity;  // sum w V u
  Vec3 weighted_rise;      // sum w V offset . grad u
  double weight = 0;       // sum w V
  Vec3 pressure_gradient;  // sum V grad p
  double eps_rho = 0;      // sum V eps rho
  double eps_mu = 0;       // sum V eps mu
  double eps = 0;          // sum V eps
  double volume = 0;       // sum V
};

BulkFluid means(const FluidSums& sum) {
  BulkFluid cell;
  cell.velocity = sum.weighted_velocity / sum.weight;
  cell.pressure_gradient = sum.pressure_gradient / sum.volume;
  cell.density = sum.eps_rho / sum.eps;
  cell.viscosity = sum.eps_mu / sum.eps;
  cell.void_fraction = sum.eps / sum.volume;
  return cell;
}

tmp<Foam::tensorField> slopes(const volVectorField& field) {
  const tmp<Foam::volTensorField> slope =
      Foam::fv::leastSquaresGrad<vector>(field.mesh()).calcGrad(field, "slopeOfBulk");
  return tmp<Foam::tensorField>::New(slope().primitiveField());
}

}  // namespace

Bridge::Bridge(Flow& flow, const CaseParameters& parameters, const BulkGrid& grid,
               const BulkPartition& partition, MPI_Comm world)
    : flow_(flow), parameters_(parameters), world_(world), grid_(grid), partition_(partition) {
  remap();
}

void Bridge::remap() {
  const MappingParameters& mapping = parameters_.coupling.mapping;
  remap_ = std::make_unique<Remap>(world_, grid_, partition_, fine_mesh(flow_.mesh), mapping);
  if (interpolates(mapping.to_bulk))
    sampler_ = std::make_unique<FluidSampler>(flow_.mesh, *remap_, mapping.to_bulk);
  reconstructs_ =
      mapping.to_bulk == Mapping::conservative && Foam::returnReduce(remap_->straddles(), Foam::orOp<bool>());
  distribute();
}

CellValues<double> Bridge::open_shares() const {
  const Remap cut(world_, grid_, partition_, fine_mesh(flow_.mesh),
                  {Mapping::nearest, Mapping::conservative});
  std::vector<double> here(cut.cells().cells().size(), 0.0);
  for (const Piece& piece : cut.pieces()) here[piece.slot] += piece.volume;
  const CellValues<double> met = cut.cells().sum_to_owners(here);
  CellValues<double> open;
  int rank;
  check_mpi(MPI_Comm_rank(world_, &rank), "MPI_Comm_rank");
  std::size_t next = 0;
  for (CellId cell = partition_.begin(rank); cell < partition_.end(rank); ++cell) {
    const bool known = next < met.cells.size() && met.cells[next] == cell;
    const double share = known ? met.values[next++] / grid_.cell_volume() : 0.0;
    if (share >= full) continue;
    open.cells.push_back(cell);
    open.values.push_back(share);
  }
  return open;
}

void Bridge::take(CellValues<BulkParticles> particles) {
  return_left_over(particles);
  owned_ = std::move(particles);
  solid_volume_before_ = std::move(solid_volume_);
  solid_volume_ = {owned_.cells, std::vector<double>(owned_.values.size())};
  for (std::size_t i = 0; i < owned_.values.size(); ++i)
    solid_volume_.values[i] = owned_.values[i].solid_volume;
  felt_shift_ = shift_;
  distribute();
}

void Bridge::distribute() {
  const TouchedCells& cells = remap_->cells();
  const CellValues<double> marks{owned_.cells, std::vector<double>(owned_.cells.size(), 1.0)};
  const std::vector<double> active = cells.fetch_from_owners(marks, 0.0);
  touched_ = cells.fetch_from_owners(owned_, BulkParticles{});
  if (sampler_ || reconstructs_) felt_shift_here_ = cells.fetch_from_owners(felt_shift_, Vec3{});
  pieces_.clear();
  std::copy_if(remap_->pieces().begin(), remap_->pieces().end(), std::back_inserter(pieces_),
               [&](const Piece& piece) { return active[piece.slot] > 0; });
  coefficient_part_.assign(pieces_.size(), 0.0);
}

scalarField Bridge::void_fraction_of(const CellValues<double>& solid_volume, Spread& spread) const {
  const std::vector<double> solid_fraction =
      remap_->to_fine(remap_->cells().fetch_from_owners(solid_volume, 0.0), 1);
  scalarField eps(flow_.mesh.nCells());
  spread = {};
  forAll(eps, cell) {
    spread.negative_cells += solid_fraction[cell] < 0;
    eps[cell] = 1 - std::max(solid_fraction[cell], 0.0);
    spread.solid_volume += (1 - eps[cell]) * flow_.mesh.V()[cell];
    if (eps[cell] >= smallest_void_fraction) continue;
    const vector& at = flow_.mesh.C()[cell];
    throw RunError(fmt::format(
        "void fraction {:.3g} in the fine cell at ({:.5g} {:.5g} {:.5g}) m leaves no room for the fluid "
        "(smallest possible: {}). Try a coarser bulk_grid, a larger coupling.averaging.width or a smaller "
        "coupling.averaging.maximum_solid_fraction.",
        eps[cell], at.x(), at.y(), at.z(), smallest_void_fraction));
  }
  Foam::reduce(spread.solid_volume, Foam::sumOp<double>());
  Foam::reduce(spread.negative_cells, Foam::sumOp<long>());
  return eps;
}

std::vector<double> Bridge::fine_weights() const {
  std::vector<double> weight(static_cast<std::size_t>(flow_.mesh.nCells()), 1.0);
  if (parameters_.coupling.sharing == Sharing::mass)
    for (std::size_t cell = 0; cell < weight.size(); ++cell) {
      const int index = static_cast<int>(cell);
      weight[cell] = eps(index) * flow_.rho[index];
    }
  return weight;
}

void Bridge::spread_sources() {
  const std::vector<double> weight = fine_weights();
  std::vector<double> total(touched_.size());  // sum w V over the fine cells of a bulk cell
  for (const Piece& piece : pieces_) total[piece.slot] += weight[piece.fine] * piece.volume;
  total = remap_->cells().fetch_from_owners(remap_->cells().sum_to_owners(total), 0.0);
  const CouplingParameters& coupling = parameters_.coupling;
  std::vector<FluidSource> sources(touched_.size());
  for (std::size_t slot = 0; slot < sources.size(); ++slot) {
    sources[slot] = fluid_source(coupling.exchange, touched_[slot], coupling.window);
    if (sampler_ || reconstructs_) sources[slot].reference_velocity -= felt_shift_here_[slot];
  }

  ParticleSource& source = *flow_.source;
  source.force = Foam::dimensionedVector(source.force.dimensions(), Foam::Zero);
  source.coefficient = dimensionedScalar(source.coefficient.dimensions(), Foam::Zero);
  source.reference = Foam::dimensionedVector(source.reference.dimensions(), Foam::Zero);
  const auto& volume = flow_.mesh.V();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    const FluidSource& bulk = sources[piece.slot];
    const double share = weight[piece.fine] * piece.volume / (total[piece.slot] * volume[piece.fine]);
    coefficient_part_[i] = share * bulk.coefficient;
    source.force[piece.fine] += share * to_foam(bulk.explicit_force);
    source.coefficient[piece.fine] += coefficient_part_[i];
    source.reference[piece.fine] += coefficient_part_[i] * to_foam(bulk.reference_velocity);
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double whole = source.coefficient[pieces_[i].fine];
    coefficient_part_[i] = whole > 0 ? coefficient_part_[i] / whole : 0;
  }
  forAll(source.coefficient, cell) if (source.coefficient[cell] > 0) source.reference[cell] /=
      source.coefficient[cell];
}

void Bridge::collect_impulse() {
  volVectorField::Internal& given = flow_.source->implicit_impulse;
  const auto& volume = flow_.mesh.V();
  forAll(given, cell) collected_sum_ += volume[cell] * to_vec3(given[cell]);
  if (hands_back_left_over(parameters_.coupling.exchange)) {
    std::vector<Vec3> impulse(touched_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      impulse[pieces_[i].slot] -=
          coefficient_part_[i] * volume[pieces_[i].fine] * to_vec3(given[pieces_[i].fine]);
    const CellValues<Vec3> owned = remap_->cells().sum_to_owners(impulse);
    for (std::size_t i = 0; i < owned.cells.size(); ++i) collected_[owned.cells[i]] += owned.values[i];
  }
  given = Foam::dimensionedVector(given.dimensions(), Foam::Zero);
}

void Bridge::end_window() {
  collect_impulse();
  implicit_impulse_ = std::exchange(collected_sum_, Vec3{});
  left_over_ = {};
  for (const auto& [cell, impulse] : std::exchange(collected_, {})) {
    const BulkParticles* particles = find(owned_, cell);
    if (!particles) continue;
    left_over_.cells.push_back(cell);
    left_over_.values.push_back({impulse, particles->solid_volume});
  }
}

/// The fluid gets it as if the particles had been given so much less drag.
void Bridge::return_left_over(CellValues<BulkParticles>& particles) {
  for (std::size_t i = 0; i < left_over_.cells.size(); ++i) {
    const CellId cell = left_over_.cells[i];
    LeftOver& owed = left_over_.values[i];
    const auto place = std::lower_bound(particles.cells.begin(), particles.cells.end(), cell);
    const auto slot = place - particles.cells.begin();
    const bool there = place != particles.cells.end() && *place == cell;
    const double now = there ? particles.values[slot].solid_volume : 0;
    const Vec3 returned = (1 - share_for_particles(owed.solid_volume, now)) * owed.impulse;
    if (norm(returned) == 0) continue;
    if (!there) {
      particles.cells.insert(place, cell);
      particles.values.insert(particles.values.begin() + slot, BulkParticles{});
    }
    particles.values[slot].drag_impulse -= returned;
    owed.impulse -= returned;
  }
}

CellValues<BulkFluid> Bridge::bulk_fluid() {
  const std::vector<double> weight = fine_weights();
  const Foam::vectorField gradient = pressure_gradient(flow_);
  const tmp<scalarField> viscosity = dynamic_viscosity(flow_);
  tmp<Foam::tensorField> velocity_slope, gradient_slope;
  if (reconstructs_) {
    velocity_slope = slopes(flow_.U);
    gradient_slope = slopes(
        with_boundary("pressureGradientOfBulk", flow_.mesh, Foam::dimPressure / Foam::dimLength, gradient));
  }
  std::vector<FluidSums> sums(touched_.size());
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    FluidSums& sum = sums[piece.slot];
    const double v = piece.volume, eps_v = eps(piece.fine) * v;
    sum.weighted_velocity += weight[piece.fine] * v * to_vec3(flow_.U[piece.fine]);
    sum.weight += weight[piece.fine] * v;
    sum.pressure_gradient += v * to_vec3(gradient[piece.fine]);
    sum.eps_rho += eps_v * density(piece.fine);
    sum.eps_mu += eps_v * viscosity()[piece.fine];
    sum.eps += eps_v;
    sum.volume += v;
    if (!reconstructs_) continue;
    const vector offset = to_foam(piece.offset);
    sum.weighted_rise += weight[piece.fine] * v * to_vec3(offset & velocity_slope()[piece.fine]);
    sum.pressure_gradient += v * to_vec3(offset & gradient_slope()[piece.fine]);
  }
  const CellValues<FluidSums> owned = remap_->cells().sum_to_owners(sums);
  CellValues<BulkFluid> fluid;
  shift_ = {};
  for (std::size_t i = 0; i < owned.cells.size(); ++i) {
    if (!(owned.values[i].volume > 0)) continue;
    fluid.cells.push_back(owned.cells[i]);
    fluid.values.push_back(means(owned.values[i]));
    shift_.values.push_back(fluid.values.back().velocity);
    fluid.values.back().velocity += owned.values[i].weighted_rise / owned.values[i].weight;
    if (const LeftOver* owed = find(left_over_, owned.cells[i]))
      fluid.values.back().left_over = owed->impulse;
  }
  left_over_ = {};
  if (sampler_) sample_points(gradient, viscosity, fluid);
  shift_.cells = fluid.cells;
  for (std::size_t i = 0; i < fluid.cells.size(); ++i)
    shift_.values[i] = fluid.values[i].velocity - shift_.values[i];
  relax(fluid);
  return fluid;
}

/// A cell whose particles were told nothing before is told the fluid as it is.
void Bridge::relax(CellValues<BulkFluid>& fluid) {
  CellValues<Told> told;
  told.cells = fluid.cells;
  relaxation_.assign(fluid.cells.size(), 1.0);
  relaxed_ = {};
  for (std::size_t i = 0; i < fluid.cells.size(); ++i) {
    BulkFluid& cell = fluid.values[i];
    const BulkParticles* particles = find(owned_, fluid.cells[i]);
    const Told* before = find(told_, fluid.cells[i]);
    told.values.push_back({cell.velocity, cell.pressure_gradient, before ? before->acceleration : Vec3{}});
    if (!particles || !before) continue;
    const double fluid_volume = cell.void_fraction * grid_.cell_volume();
    const double gain = flow_.porosity ? making_way_gain(*particles, cell.density, fluid_volume) : 0;
    const double response =
        hands_back_left_over(parameters_.coupling.exchange)
            ? particles->drag_response * parameters_.coupling.window / (cell.density * fluid_volume)
            : 0;
    const double omega = relaxation_factor(parameters_.coupling.schedule, gain, response);
    relaxation_[i] = omega;
    if (omega == 1) continue;
    relaxed_.smallest = std::min(relaxed_.smallest, omega);
    ++relaxed_.cells;
    Told& now = told.values.back();
    cell.velocity = now.velocity = before->velocity + omega * (cell.velocity - before->velocity);
    cell.pressure_gradient = now.pressure_gradient =
        before->pressure_gradient + omega * (cell.pressure_gradient - before->pressure_gradient);
  }
  told_ = std::move(told);
}

/// Puts values at the centres of the bulk cells in place of means. A cell whose centre no fine cell holds
/// keeps its means.
void Bridge::sample_points(const Foam::vectorField& gradient, const scalarField& viscosity,
                           CellValues<BulkFluid>& fluid) const {
  const CellValues<FluidSample> sums =
      remap_->cells().sum_to_owners(sampler_->sample(flow_, gradient, viscosity));
  std::size_t at = 0;
  for (std::size_t i = 0; i < fluid.cells.size(); ++i) {
    while (sums.cells[at] != fluid.cells[i]) ++at;
    const FluidSample& sum = sums.values[at];
    if (sum.cells == 0) continue;
    BulkFluid& cell = fluid.values[i];
    cell.velocity = sum.velocity / sum.cells;
    cell.pressure_gradient = sum.pressure_gradient / sum.cells;
    cell.density = sum.density / sum.cells;
    cell.viscosity = sum.viscosity / sum.cells;
  }
}

Bridge::Impulses Bridge::impulses() const {
  const ParticleSource& source = *flow_.source;
  vector explicit_force = vector::zero, implicit_impulse = to_foam(implicit_impulse_);
  forAll(source.force, cell) explicit_force += flow_.mesh.V()[cell] * source.force[cell];
  Foam::reduce(explicit_force, Foam::sumOp<vector>());
  Foam::reduce(implicit_impulse, Foam::sumOp<vector>());
  return {parameters_.coupling.window * to_vec3(explicit_force), to_vec3(implicit_impulse)};
}

void Bridge::go_on_from(State state) {
  owned_ = std::move(state.particles);
  left_over_ = std::move(state.left_over);
  felt_shift_ = std::move(state.felt_shift);
  told_ = std::move(state.told);
  distribute();
}

Bridge::Relaxed Bridge::relaxed() const {
  return {Foam::returnReduce(relaxed_.smallest, Foam::minOp<double>()),
          Foam::returnReduce(relaxed_.cells, Foam::sumOp<long>())};
}

CellId Bridge::active_cells() const {
  return Foam::returnReduce(static_cast<label>(owned_.cells.size()), Foam::sumOp<label>());
}

}  // namespace demvof
