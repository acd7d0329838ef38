// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/replacement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/base/errors.hpp"
#include "coupler/base/sphere.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "foam_side/fine_mesh.hpp"
#include "foam_side/quantities.hpp"

namespace demvof {
namespace {

// Cells per diameter below which a drop is none any more. Between this and drop_resolution its shape is
// coarse: the run goes on and says so.
constexpr double least_resolution = 2;

/// A fine cell around a drop.
struct Nearby {
  label cell;
  double distance;  // of its centre from the drop's, m
  double width;     // m
  double room;      // gas in it that can become liquid, or liquid that can become gas, m3
  /// Share of the cell inside a sphere: exact for a plane across a cube.
  double inside(double radius) const { return std::clamp(0.5 + (radius - distance) / width, 0.0, 1.0); }
};

double sum_inside(const std::vector<Nearby>& nearby, double radius) {
  double sum = 0;
  for (const Nearby& n : nearby) sum += n.inside(radius) * n.room;
  return Foam::returnReduce(sum, Foam::sumOp<double>());
}

/// One particle being replaced or coming back.
class Exchange {
 public:
  Exchange(Flow& flow, const Droplet& droplet)
      : flow_(flow), droplet_(droplet), centre_(to_foam(droplet.position)) {}

  double volume() const { return sphere_volume(droplet_.radius); }
  /// Step 1; returns the liquid that came with it, signed, m3.
  double fill(const scalarField& solid_fraction);
  /// Step 2; gas becomes liquid (amount > 0, m3), or liquid gas. Returns the coarsest cell's width, m.
  double turn(double amount);
  const vector& impulse() const { return impulse_; }  // this rank's, N s

 private:
  double eps(label cell) const { return flow_.porosity ? flow_.porosity->eps[cell] : 1.0; }
  std::vector<Nearby> find_room(double amount) const;
  void turn(label cell, double liquid);

  Flow& flow_;
  const Droplet& droplet_;
  vector centre_;
  vector impulse_ = vector::zero;
};

double Exchange::fill(const scalarField& solid_fraction) {
  Porosity& porosity = *flow_.porosity;
  double liquid = 0;
  forAll(solid_fraction, cell) {
    const double change = droplet_.sign * solid_fraction[cell];
    if (change == 0) continue;
    const double volume = change * flow_.mesh.V()[cell];
    porosity.eps[cell] += change;
    porosity.goal.field()[cell] += change;
    liquid += flow_.alpha[cell] * volume;
    impulse_ += volume * flow_.rho[cell] * flow_.U[cell];
  }
  return Foam::returnReduce(liquid, Foam::sumOp<double>());
}

/// Cells around the drop, far enough that there is room for the amount.
std::vector<Nearby> Exchange::find_room(double amount) const {
  const auto& mesh = flow_.mesh;
  const double whole_mesh = Foam::mag(mesh.bounds().span());
  for (double reach = 2 * droplet_.radius;; reach *= 1.5) {
    std::vector<Nearby> nearby;
    forAll(mesh.C(), cell) {
      const double distance = Foam::mag(mesh.C()[cell] - centre_), v = mesh.V()[cell];
      if (distance > reach) continue;
      const double share = amount > 0 ? 1 - flow_.alpha[cell] : double(flow_.alpha[cell]);
      nearby.push_back({cell, distance, std::cbrt(v), std::max(0.0, share) * eps(cell) * v});
    }
    double width = 0;
    for (const Nearby& n : nearby) width = std::max(width, n.width);
    Foam::reduce(width, Foam::maxOp<double>());
    if (sum_inside(nearby, reach - width) >= std::abs(amount)) return nearby;
    if (reach > whole_mesh)
      throw RunError(fmt::format("phase interchange: the box has no {} left for {:.3g} m3",
                                 amount > 0 ? "gas" : "liquid", std::abs(amount)));
  }
}

void Exchange::turn(label cell, double liquid) {
  const double v = eps(cell) * flow_.mesh.V()[cell];
  const double rho1 = flow_.mixture.rho1().value(), rho2 = flow_.mixture.rho2().value();
  const double mass = v * flow_.rho[cell];
  vector& u = flow_.U[cell];
  // What becomes liquid brings its velocity along, what becomes gas keeps the cell's.
  const vector brought = liquid > 0 ? to_foam(droplet_.velocity) : u;
  const vector gained = liquid * (rho1 * brought - rho2 * u);
  u = (mass * u + gained) / (mass + liquid * (rho1 - rho2));
  impulse_ += gained;
  flow_.alpha[cell] += liquid / v;
  flow_.rho[cell] += liquid / v * (rho1 - rho2);
}

double Exchange::turn(double amount) {
  if (amount == 0) return 0;
  const std::vector<Nearby> nearby = find_room(amount);
  double low = 0, high = 2 * droplet_.radius;
  while (sum_inside(nearby, high) < std::abs(amount)) high *= 1.5;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (sum_inside(nearby, middle) < std::abs(amount) ? low : high) = middle;
  }
  const double scale = amount / sum_inside(nearby, high);
  double coarsest = 0;
  for (const Nearby& n : nearby) {
    const double share = n.inside(high);
    if (share <= 0 || n.room <= 0) continue;
    coarsest = std::max(coarsest, n.width);
    turn(n.cell, scale * share * n.room);
  }
  Foam::reduce(coarsest, Foam::maxOp<double>());
  return coarsest;
}

/// Liquid of each cell, m3.
scalarField liquid_volumes(const Flow& flow) {
  scalarField liquid(flow.alpha.primitiveField() * flow.mesh.V().field());
  if (flow.porosity) liquid *= flow.porosity->eps.primitiveField();
  return liquid;
}

/// eps_f u.S from the cells.
tmp<surfaceScalarField> cell_flux(const Flow& flow) {
  tmp<surfaceScalarField> flux = fvc::flux(flow.U);
  if (flow.porosity) flux.ref() *= face_void_fraction(flow.porosity->eps);
  return flux;
}

/// Boundaries and mixture that follow from new cells; the total pressure stays.
void update_boundaries(Flow& flow, const scalarField& old_density) {
  if (flow.porosity) flow.porosity->eps.correctBoundaryConditions();
  flow.alpha.correctBoundaryConditions();
  flow.U.correctBoundaryConditions();
  flow.mixture.alpha2() = 1.0 - flow.alpha;
  flow.mixture.incompressibleTwoPhaseMixture::correct();
  flow.rho == flow.alpha* flow.mixture.rho1() + flow.mixture.alpha2() * flow.mixture.rho2();
  flow.p_rgh.primitiveFieldRef() -= (flow.rho.primitiveField() - old_density) * flow.gh.primitiveField();
  flow.face_force.clear();
  if (!flow.scene.interface_advection)
    flow.face_force = -flow.ghf * fvc::snGrad(flow.rho) * flow.mesh.magSf();
}

}  // namespace

void replace_particles(
    Flow& flow, const std::vector<Droplet>& droplets,
    const std::function<scalarField(const Vec3& position, double volume)>& solid_fraction_of,
    const std::function<bool(const Vec3& position, const Vec3& impulse)>& owe, ReplacementBooks& books) {
  if (droplets.empty()) return;
  const scalarField old_density(flow.rho.primitiveField());
  const surfaceScalarField old_flux(cell_flux(flow));
  const volVectorField old_velocity(flow.U);
  const Vec3 momentum = fluid_momentum(flow);
  vector impulse = vector::zero;
  for (const Droplet& droplet : droplets) {
    Exchange exchange(flow, droplet);
    const double volume = droplet.sign * exchange.volume();
    const scalarField before(liquid_volumes(flow));
    double filled = 0;
    if (flow.porosity) filled = exchange.fill(solid_fraction_of(droplet.position, exchange.volume()));
    const double coarsest = exchange.turn(volume - filled), diameter = 2 * droplet.radius;
    if (droplet.sign > 0 && coarsest > 0) {
      books.worst_resolution = std::min(books.worst_resolution, diameter / coarsest);
      if (diameter < least_resolution * coarsest)
        throw RunError(fmt::format(
            "phase interchange: a particle of {:.4g} m becomes liquid at ({:.5g} {:.5g} {:.5g}) m in fine "
            "cells "
            "of {:.4g} m; replacement needs {} cells per diameter. Try a finer mesh there, or "
            "coupling.phase_interchange: porous",
            diameter, droplet.position.x, droplet.position.y, droplet.position.z, coarsest, drop_resolution));
    }
    const vector given = Foam::returnReduce(exchange.impulse(), Foam::sumOp<vector>());
    impulse += given;
    if (!owe(droplet.position, to_vec3(given))) books.from_outside += to_vec3(given);

    const double change =
        Foam::gSum(scalarField(liquid_volumes(flow) - before));  // cell by cell: less round-off
    books.worst_volume_error = std::max(books.worst_volume_error, std::abs(change / volume - 1));
    (droplet.sign > 0 ? books.became_liquid : books.took_place_back) += 1;
    (droplet.sign > 0 ? books.liquid_in : books.liquid_out) += std::abs(volume);
  }
  update_boundaries(flow, old_density);
  flow.phi += cell_flux(flow) - old_flux;
  if (flow.face_velocity) *flow.face_velocity += fvc::interpolate(flow.U - old_velocity);
  if (flow.velocity_flux) *flow.velocity_flux += fvc::dotInterpolate(flow.mesh.Sf(), flow.U - old_velocity);
  if (!flow.porosity)
    fit_flux(flow, projection_mobility(flow), nullptr);  // else with the window's void fraction

  books.impulse += to_vec3(impulse);
  const Vec3 after = fluid_momentum(flow), open = after - momentum - to_vec3(impulse);
  const double size = std::max({norm(after), norm(momentum), Foam::mag(impulse)});
  if (size > 0) books.worst_impulse_error = std::max(books.worst_impulse_error, norm(open) / size);
}

void require_mesh_resolves_particles(const Foam::fvMesh& mesh, double diameter) {
  if (mesh.dynamic() || diameter <= 0) return;  // checked where a particle becomes liquid
  const double finest = std::cbrt(Foam::gMin(mesh.V().field()));
  if (finest * least_resolution <= diameter) return;
  throw InputError(fmt::format(
      "coupling.phase_interchange: replacement needs {} fine cells per particle diameter, the mesh "
      "has {:.2g} (diameter {:.4g} m, finest cell {:.4g} m): give a mesh of {:.4g} m or finer at the "
      "interface, or another phase interchange",
      drop_resolution, diameter / finest, diameter, finest, diameter / drop_resolution));
}

}  // namespace demvof
