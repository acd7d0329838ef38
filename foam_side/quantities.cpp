// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals and extremes of the fluid (paper, eqs. 45-51; docs/outputs.md). The paper calls the
// integrals of squares L2 norms without taking the root; here they carry the name of what they are.

#include "foam_side/quantities.hpp"

#include <algorithm>
#include <cmath>

#include "foam_side/fine_mesh.hpp"
#include "foam_side/open_momentum.hpp"
#include "processorCyclicPolyPatch.H"

namespace demvof {

namespace {

constexpr double interface_band = 0.01;  // interface cells: band < alpha < 1 - band

double void_fraction(const Flow& flow, label cell) {
  return flow.porosity ? flow.porosity->eps[cell] : 1.0;
}

/// Share of the fluid in a cell's volume. (With volume_adding the equations see none, but the liquid does.)
double fluid_share(const Flow& flow, label cell) {
  return flow.ghost ? flow.ghost->eps[cell] : void_fraction(flow, cell);
}

/// Largest x of the alpha = 0.5 surface on this rank, m: where the line between two cell centres, on one side
/// or both of a cut between ranks, crosses it, or a boundary face that liquid touches.
double liquid_front(const Flow& flow) {
  const auto& mesh = flow.mesh;
  double front = mesh.bounds().min().x();
  const auto look_between = [&front](double alpha, double x, double next_alpha, double next_x) {
    const double a = alpha - 0.5, b = next_alpha - 0.5;
    if ((a < 0) != (b < 0)) front = std::max(front, x + (next_x - x) * a / (a - b));
  };
  for (label face = 0; face < mesh.nInternalFaces(); ++face) {
    const label own = mesh.owner()[face], next = mesh.neighbour()[face];
    look_between(flow.alpha[own], mesh.C()[own].x(), flow.alpha[next], mesh.C()[next].x());
  }
  for (const auto& at_patch : flow.alpha.boundaryField()) {
    const Foam::fvPatch& patch = at_patch.patch();
    const Foam::labelUList& cells = patch.faceCells();
    if (Foam::isA<Foam::processorPolyPatch>(patch.patch()) &&
        !Foam::isA<Foam::processorCyclicPolyPatch>(patch.patch())) {
      const scalarField there(at_patch.patchNeighbourField());
      const Foam::vectorField way(patch.delta());
      forAll(cells, i) {
        const double x = mesh.C()[cells[i]].x();
        look_between(flow.alpha[cells[i]], x, there[i], x + way[i].x());
      }
    } else if (!patch.coupled()) {
      forAll(cells, i) if (flow.alpha[cells[i]] >= 0.5) front = std::max(front, patch.Cf()[i].x());
    }
  }
  return front;
}

}  // namespace

vector lowest_corner(const Flow& flow) {
  const auto& box = flow.mesh.bounds();
  vector corner = box.min();
  for (int axis = 0; axis < 3; ++axis)
    if (flow.g.value()[axis] > 0) corner[axis] = box.max()[axis];
  return corner;
}

Quantities fluid_quantities(const Flow& flow) {
  const auto& mesh = flow.mesh;
  const vector origin = lowest_corner(flow), g = flow.g.value();
  double kinetic = 0, potential = 0, squared = 0, squared_x = 0, squared_liquid = 0, squared_gas = 0;
  double pressure = 0, solid = 0, liquid = 0, in_interface = 0, below_surface = 0, volume = 0;
  double fastest = -1;
  vector fastest_at = vector::zero;
  for (label cell = 0; cell < mesh.nCells(); ++cell) {
    const double v = mesh.V()[cell], eps = void_fraction(flow, cell), alpha = flow.alpha[cell];
    const double share = fluid_share(flow, cell);
    const vector& u = flow.U[cell];
    const double uu = u & u;
    kinetic += 0.5 * eps * flow.rho[cell] * uu * v;
    potential -= eps * flow.rho[cell] * (g & (mesh.C()[cell] - origin)) * v;
    squared += eps * uu * v;
    squared_x += eps * u.x() * u.x() * v;
    squared_liquid += eps * alpha * uu * v;
    squared_gas += eps * (1 - alpha) * uu * v;
    pressure += flow.p[cell] * flow.p[cell] * v;
    solid += (1 - share) * v;
    liquid += share * alpha * v;
    below_surface += alpha * v;
    volume += v;
    if (alpha > interface_band && alpha < 1 - interface_band) in_interface += share * alpha * v;
    if (uu > fastest) {
      fastest = uu;
      fastest_at = mesh.C()[cell];
    }
  }
  scalarField sums(12);
  sums[0] = kinetic, sums[1] = potential, sums[2] = squared, sums[3] = squared_x, sums[4] = squared_liquid;
  sums[5] = squared_gas, sums[6] = pressure, sums[7] = solid, sums[8] = liquid, sums[9] = in_interface;
  sums[10] = below_surface, sums[11] = volume;
  Foam::Pstream::listCombineGather(sums, Foam::plusEqOp<scalar>());
  Foam::Pstream::listCombineScatter(sums);
  const double fastest_anywhere = Foam::returnReduce(fastest, Foam::maxOp<double>());
  if (fastest < fastest_anywhere) fastest_at = vector::uniform(-Foam::VGREAT);
  const vector at = Foam::returnReduce(fastest_at, Foam::maxOp<vector>());
  const double front = Foam::returnReduce(liquid_front(flow), Foam::maxOp<double>());

  // Floor area of the mesh: its volume over its extent along the axis that gravity is closest to.
  const vector size = Foam::cmptMag(g);
  const int axis = size.z() >= Foam::max(size.x(), size.y()) ? 2 : size.y() >= size.x() ? 1 : 0;
  const double height = size[axis] > 0 ? mesh.bounds().span()[axis] : 0;
  return {{"kinetic_energy", sums[0]},
          {"potential_energy", sums[1]},
          {"velocity_squared_integral", sums[2]},
          {"velocity_squared_integral_x", sums[3]},
          {"velocity_squared_integral_liquid", sums[4]},
          {"velocity_squared_integral_gas", sums[5]},
          {"pressure_squared_integral", sums[6]},
          {"solid_volume_mesh", sums[7]},
          {"liquid_volume", sums[8]},
          {"liquid_in_interface_cells", sums[9]},
          {"mean_level", sums[10] * height / sums[11]},
          {"liquid_front", front},
          {"max_speed", std::sqrt(std::max(0.0, fastest_anywhere))},
          {"max_speed_x", at.x()},
          {"max_speed_y", at.y()},
          {"max_speed_z", at.z()}};
}

double liquid_volume(const Flow& flow) {
  double liquid = 0;
  for (label cell = 0; cell < flow.mesh.nCells(); ++cell)
    liquid += fluid_share(flow, cell) * flow.alpha[cell] * flow.mesh.V()[cell];
  return Foam::returnReduce(liquid, Foam::sumOp<double>());
}

bool solid_at_interface(const Flow& flow) {
  constexpr double least_solid = 1e-6;
  bool found = false;
  for (label cell = 0; flow.porosity && cell < flow.mesh.nCells() && !found; ++cell) {
    const double alpha = flow.alpha[cell];
    found =
        alpha > interface_band && alpha < 1 - interface_band && void_fraction(flow, cell) < 1 - least_solid;
  }
  return Foam::returnReduce(found, Foam::orOp<bool>());
}

Vec3 fluid_momentum(const Flow& flow) {
  vector momentum = vector::zero;
  for (label cell = 0; cell < flow.mesh.nCells(); ++cell)
    momentum += void_fraction(flow, cell) * flow.rho[cell] * flow.mesh.V()[cell] * flow.U[cell];
  if (const Foam::vectorField* open = find_open_momentum(flow))
    for (label cell = 0; cell < flow.mesh.nCells(); ++cell) momentum += flow.mesh.V()[cell] * (*open)[cell];
  return to_vec3(Foam::returnReduce(momentum, Foam::sumOp<vector>()));
}

}  // namespace demvof
