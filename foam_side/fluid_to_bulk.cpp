// SPDX-License-Identifier: GPL-3.0-or-later
// From the fine mesh to the bulk grid (paper, section 6; docs/theory.md).
//
//   q_b = sum_f W_fb q_f / sum_f W_fb      W_fb: weight of the subcell of fine cell f in bulk cell b
//
// with the weights of sharing_weights.hpp: of forces for velocity, acceleration and vorticity, so that what
// the particles do to the fluid they are told with; of the gradient for forces per volume (pressure gradient,
// stress).
//
// Where the surface cuts a bulk cell, liquid (k = 0) and gas (k = 1) are told each by itself: V_fb becomes
// the part of the subcell that is k (surface_to_bulk.hpp), density and viscosity are those of k, and
//
//   grad p_k = mean over k of (grad p - rho g) + rho_k g
//
// so that what fine cells with both fluids have of the other's weight is left out: at rest a wet part feels
// the liquid's hydrostatic gradient and a dry one the gas's, however the surface is smeared. Of grad p and of
// the viscous stress the thinner fluid is not told what the thicker one's viscosity makes there
// (stress_of_other.hpp), and viscosity is always that of k: a wisp of 1e-6 of a liquid of 1e6 Pa s would hold
// a bead in the gas.
//
// With coupling.order 2 grad p and Du/Dt are means over the window (window_means.hpp).
//
// In a fine cell that lies in several bulk cells u and grad p have a linear profile (conservative), so that
// its subcells differ: q_fb = q_f + grad q_f . (X_fb - X_f), whose mean is q_f. Or they are values at the
// centre of the bulk cell (sample_fluid.hpp).

#include "foam_side/fluid_to_bulk.hpp"

#include <cmath>

#include "foam_side/cell_field.hpp"
#include "foam_side/fine_mesh.hpp"
#include "foam_side/fluid_gradients.hpp"
#include "foam_side/sharing_weights.hpp"
#include "foam_side/stress_of_other.hpp"
#include "foam_side/window_means.hpp"
#include "leastSquaresGrad.H"

namespace demvof {

namespace {

// Change of alpha across a fine cell from which on it holds interface: wisps and round-off do not.
constexpr double least_change = 0.1;

/// Sums over the fine cells of a bulk cell that give its BulkFluid.
struct FluidSums {
  Vec3 weighted_velocity;      // sum W u
  Vec3 weighted_rise;          // sum W offset . grad u
  double weight = 0;           // sum W of forces
  Vec3 pressure_gradient;      // sum W grad p
  double gradient_weight = 0;  // sum W of the gradient
  double rho = 0, mu = 0;      // sum W rho, sum W mu
  double property_weight = 0;  // sum W of properties
  double eps = 0, volume = 0;  // sum V eps, sum V
};

/// The same for BulkFluidGradients.
struct GradientSums {
  BulkFluidGradients weighted;
  double weight = 0, gradient_weight = 0;  // sum W of forces and of the gradient
};

BulkFluid mean(const FluidSums& sum) {
  BulkFluid cell;
  cell.velocity = sum.weighted_velocity / sum.weight;
  cell.pressure_gradient = sum.pressure_gradient / sum.gradient_weight;
  cell.density = sum.rho / sum.property_weight;
  cell.viscosity = sum.mu / sum.property_weight;
  cell.void_fraction = sum.eps / sum.volume;
  return cell;
}

tmp<Foam::tensorField> slopes(const volVectorField& field) {
  const tmp<Foam::volTensorField> slope =
      Foam::fv::leastSquaresGrad<vector>(field.mesh()).calcGrad(field, "slopeOfBulk");
  return tmp<Foam::tensorField>::New(slope().primitiveField());
}

}  // namespace

FluidToBulk::FluidToBulk(Flow& flow, const BulkCut& cut, const SurfaceToBulk& surface,
                         const ForceParameters& forces, Sharing sharing)
    : flow_(flow), cut_(cut), surface_(surface), forces_(forces), sharing_(sharing) {
  renew();
}

void FluidToBulk::renew() {
  if (interpolates(cut_.to_bulk())) sampler_ = std::make_unique<FluidSampler>(flow_.mesh, cut_);
}

std::vector<FluidToBulk::Means> FluidToBulk::means() const {
  const SharingWeights weights(flow_, surface_, cut_, sharing_);
  const Foam::vectorField* mean_of_window = find_mean_gradient(flow_);
  const Foam::vectorField whole =
      mean_of_window ? Foam::vectorField(*mean_of_window + flow_.rho.primitiveField() * flow_.g.value())
                     : pressure_gradient(flow_, forces_.capillary || !flow_.porosity);
  const tmp<scalarField> viscosity = dynamic_viscosity(flow_);
  tmp<Foam::tensorField> velocity_slope;
  if (cut_.has_profiles()) velocity_slope = slopes(flow_.U);
  std::vector<Means> all;
  for (int k = 0; k < surface_.fluids(); ++k) {
    const Foam::vectorField gradient(
        whole -
        stress_of_other(flow_, k, mean_of_window ? find_mean_stress(flow_) : find_stress_in_cells(flow_)));
    tmp<Foam::tensorField> gradient_slope;
    if (cut_.has_profiles()) {
      // Without the weight, which jumps at a surface and has no slope beside it.
      const Foam::vectorField driving(gradient - flow_.rho.primitiveField() * flow_.g.value());
      gradient_slope = slopes(
          with_boundary("pressureGradientOfBulk", flow_.mesh, Foam::dimPressure / Foam::dimLength, driving));
    }
    const double rho_k = density_of(flow_, k);
    const tmp<scalarField> viscosity_k =
        surface_.fluids() > 1 ? dynamic_viscosity(flow_, k) : tmp<scalarField>(viscosity());
    std::vector<FluidSums> sums(cut_.cells().cells().size());
    for (const Subcell& subcell : cut_.subcells()) {
      const double v = surface_.share(k, subcell) * subcell.volume;
      if (v == 0) continue;
      FluidSums& sum = sums[subcell.slot];
      const bool cut = surface_.is_cut(subcell.slot);
      const SharingWeights::Of w = weights.of(k, subcell);
      const double rho = density_between_particles(flow_, subcell.fine);
      sum.weighted_velocity += w.force * to_vec3(flow_.U[subcell.fine]);
      sum.weight += w.force;
      sum.pressure_gradient += w.gradient * to_vec3(gradient[subcell.fine]);
      if (cut) sum.pressure_gradient += w.gradient * (rho_k - rho) * to_vec3(flow_.g.value());
      sum.gradient_weight += w.gradient;
      sum.rho += w.property * (cut ? rho_k : rho);
      sum.mu += w.property * viscosity_k()[subcell.fine];
      sum.property_weight += w.property;
      sum.eps += (flow_.porosity ? flow_.porosity->eps[subcell.fine] : 1.0) * v;
      sum.volume += v;
      if (!cut_.has_profiles()) continue;
      const vector offset = to_foam(subcell.offset);
      sum.weighted_rise += w.force * to_vec3(offset & velocity_slope()[subcell.fine]);
      if (!cut) sum.pressure_gradient += w.gradient * to_vec3(offset & gradient_slope()[subcell.fine]);
    }
    const CellValues<FluidSums> owned = cut_.cells().sum_to_owners(sums);
    Means& means = all.emplace_back();
    for (std::size_t i = 0; i < owned.cells.size(); ++i) {
      const FluidSums& sum = owned.values[i];
      if (!(sum.volume > 0)) continue;
      means.fluid.cells.push_back(owned.cells[i]);
      means.fluid.values.push_back(mean(sum));
      means.shift.push_back(means.fluid.values.back().velocity);
      means.fluid.values.back().velocity += sum.weighted_rise / sum.weight;
      means.fluid_volume.push_back(sum.eps);
    }
    if (sampler_) sample_points(gradient, viscosity_k(), means);
  }
  for (Means& means : all)
    for (std::size_t i = 0; i < means.shift.size(); ++i)
      means.shift[i] = means.fluid.values[i].velocity - means.shift[i];
  return all;
}

/// Puts values at the centres of the bulk cells in place of means. A cell whose centre no fine cell holds, or
/// that the surface cuts, keeps its means.
void FluidToBulk::sample_points(const Foam::vectorField& gradient, const scalarField& viscosity,
                                Means& means) const {
  std::vector<FluidSample> samples = sampler_->sample(flow_, gradient, viscosity);
  for (std::size_t slot = 0; slot < samples.size(); ++slot)
    if (surface_.is_cut(static_cast<int>(slot))) samples[slot] = {};
  const CellValues<FluidSample> sums = cut_.cells().sum_to_owners(samples);
  for (std::size_t i = 0; i < means.fluid.cells.size(); ++i) {
    const FluidSample* sum = find(sums, means.fluid.cells[i]);
    if (!sum || sum->cells == 0) continue;
    BulkFluid& cell = means.fluid.values[i];
    cell.velocity = sum->velocity / sum->cells;
    cell.pressure_gradient = sum->pressure_gradient / sum->cells;
    cell.density = sum->density / sum->cells;
    cell.viscosity = sum->viscosity / sum->cells;
  }
}

std::vector<CellValues<BulkFluidGradients>> FluidToBulk::gradients() const {
  FluidGradients fine = fluid_gradients(flow_, forces_);
  if (const Foam::vectorField* mean_of_window = find_mean_acceleration(flow_))
    fine.acceleration = *mean_of_window;
  const SharingWeights weights(flow_, surface_, cut_, sharing_);
  std::vector<CellValues<BulkFluidGradients>> all;
  for (int k = 0; k < surface_.fluids(); ++k) {
    Foam::vectorField stress_force(fine.stress_force);
    if (forces_.viscous_stress) stress_force -= others_stress_share(flow_, k) * fine.viscous_force;
    std::vector<GradientSums> sums(cut_.cells().cells().size());
    for (const Subcell& subcell : cut_.subcells()) {
      const double v = surface_.share(k, subcell) * subcell.volume;
      if (v == 0) continue;
      GradientSums& sum = sums[subcell.slot];
      const SharingWeights::Of w = weights.of(k, subcell);
      sum.weighted.stress_force += w.gradient * to_vec3(stress_force[subcell.fine]);
      sum.weighted.acceleration += w.force * to_vec3(fine.acceleration[subcell.fine]);
      sum.weighted.vorticity += w.force * to_vec3(fine.vorticity[subcell.fine]);
      sum.weight += w.force;
      sum.gradient_weight += w.gradient;
    }
    const CellValues<GradientSums> owned = cut_.cells().sum_to_owners(sums);
    CellValues<BulkFluidGradients>& bulk = all.emplace_back();
    for (std::size_t i = 0; i < owned.cells.size(); ++i) {
      const GradientSums& sum = owned.values[i];
      if (!(sum.gradient_weight > 0)) continue;  // as in means
      bulk.cells.push_back(owned.cells[i]);
      bulk.values.push_back({sum.weighted.stress_force / sum.gradient_weight,
                             sum.weighted.acceleration / sum.weight, sum.weighted.vorticity / sum.weight});
    }
  }
  return all;
}

CellValues<BulkInterface> FluidToBulk::interface() const {
  const tmp<volVectorField> gradient = fvc::grad(flow_.alpha);
  std::vector<BulkInterface> sums(cut_.cells().cells().size());
  for (const Subcell& subcell : cut_.subcells()) {
    const Vec3 steepness = to_vec3(gradient()[subcell.fine]);
    if (norm(steepness) * std::cbrt(flow_.mesh.V()[subcell.fine]) < least_change) continue;
    const double area = norm(steepness) * subcell.volume;
    BulkInterface& sum = sums[subcell.slot];
    sum.area += area;
    sum.position += area * to_vec3(flow_.mesh.C()[subcell.fine]);
    sum.velocity += area * to_vec3(flow_.U[subcell.fine]);
    sum.gradient += subcell.volume * steepness;
  }
  const CellValues<BulkInterface> owned = cut_.cells().sum_to_owners(sums);
  CellValues<BulkInterface> holding;
  for (std::size_t i = 0; i < owned.cells.size(); ++i) {
    if (owned.values[i].area == 0) continue;
    holding.cells.push_back(owned.cells[i]);
    holding.values.push_back(owned.values[i]);
  }
  return holding;
}

}  // namespace demvof
