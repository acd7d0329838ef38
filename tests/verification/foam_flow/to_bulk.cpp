// SPDX-License-Identifier: GPL-3.0-or-later
// Row `mapping_to_bulk` of the verification table: the fluid on the bulk grid by every strategy, from real
// OpenFOAM meshes that do not nest in the bulk grid, with straight and with distorted cells; and what the
// particles give, shared among the fine cells.

#include <cmath>
#include <map>

#include "coupler/config/enum_names.hpp"
#include "foam_case.hpp"
#include "foam_side/bridge.hpp"
#include "foam_side/fine_mesh.hpp"
#include "pointIOField.H"
#include "tests/support/mpi_main.hpp"
#include "tests/support/record.hpp"

namespace demvof::test {
namespace {

const Vec3 box{0.2, 0.1, 0.3};  // m

Vec3 velocity(const Vec3& x) {
  return {std::sin(20 * x.x) + 30 * x.y * x.z, std::cos(15 * x.z) + 4 * x.y,
          std::exp(5 * x.x) * std::sin(12 * x.z)};
}

/// Moves inner points of the mesh by up to a third of a cell; the walls stay where they are.
void distort(const FoamCase& fluid, double cell) {
  Foam::Time time(Foam::Time::controlDictName, Foam::fileName(fluid.folder()).path(),
                  Foam::fileName(Foam::fileName(fluid.folder()).name()));
  Foam::pointIOField points(Foam::IOobject("points", time.constant(), Foam::polyMesh::meshSubDir, time,
                                           Foam::IOobject::MUST_READ, Foam::IOobject::NO_WRITE, false));
  const double pi = std::acos(-1.0);
  for (vector& p : points) {
    const Vec3 x = to_vec3(p);
    const double s =
        0.3 * cell * std::sin(pi * x.x / box.x) * std::sin(pi * x.y / box.y) * std::sin(pi * x.z / box.z);
    p += s *
         vector(std::sin(90 * x.y + 50 * x.z), std::sin(70 * x.z + 30 * x.x), std::sin(80 * x.x + 40 * x.y));
  }
  points.write();
}

struct Measured {
  double error = 0;      // mean over inner cells, m/s
  double exchanged = 0;  // relative error of the impulse given to the fluid
  double solid = 0;      // relative error of the solid volume on the mesh
};

Measured measure(const FoamCase& fluid, int n, Mapping mapping) {
  const auto flow = fluid.open(scene(true, false, false));
  forAll(flow->U, cell) flow->U[cell] = to_foam(velocity(to_vec3(flow->mesh.C()[cell])));
  flow->U.correctBoundaryConditions();

  CaseParameters parameters;
  parameters.coupling.window = 1e-3;
  parameters.coupling.mapping = {mapping, mapping};
  parameters.coupling.sharing = Sharing::volume;
  parameters.coupling.exchange = ExchangeScheme::explicit_drag;
  const BulkGrid grid({0, 0, 0}, box, {2 * n, n, 3 * n});
  Bridge bridge(*flow, parameters, grid, BulkPartition(grid.cells(), 1), MPI_COMM_WORLD);
  CellValues<BulkParticles> particles;
  Vec3 impulse;
  double volume = 0;
  for (CellId cell = 0; cell < grid.cell_count(); ++cell) {
    const Vec3 x = grid.cell_centre(grid.ijk(cell));
    BulkParticles here;
    here.drag_impulse = 1e-3 * velocity(x);
    here.solid_volume = (0.1 + 0.05 * std::sin(30 * x.x) * std::cos(20 * x.z)) * grid.cell_volume();
    impulse += here.drag_impulse;
    volume += here.solid_volume;
    particles.cells.push_back(cell);
    particles.values.push_back(here);
  }
  bridge.take({particles});

  Measured measured;
  const CellValues<BulkFluid> told = bridge.bulk_fluids().front();
  int count = 0;
  for (std::size_t i = 0; i < told.cells.size(); ++i) {
    const auto ijk = grid.ijk(told.cells[i]);
    bool inner = true;
    for (int axis = 0; axis < 3; ++axis) inner &= ijk[axis] > 0 && ijk[axis] < grid.cells()[axis] - 1;
    if (!inner) continue;
    measured.error += norm(told.values[i].velocity - velocity(grid.cell_centre(ijk)));
    ++count;
  }
  measured.error /= count;
  bridge.particles_to_fine().spread_sources();
  measured.exchanged = norm(bridge.particles_to_fine().impulses().explicit_part + impulse) / norm(impulse);
  bridge.particles_to_fine().void_fraction();
  measured.solid = std::abs(bridge.particles_to_fine().spread().solid_volume / volume - 1);
  return measured;
}

TEST(ToBulk, EveryStrategyReachesItsOrder) {
  Record record(
      "mapping_to_bulk", "Fluid on the bulk grid, from OpenFOAM meshes",
      "A smooth velocity on meshes with 1.5 cells per bulk cell in each direction, straight or distorted by "
      "up to a third of a cell, taken to 8 x 4 x 12 and 16 x 8 x 24 bulk cells by the bridge of foam_side. "
      "Mean error inside and its order; impulses given by the particles and solid volume, both ways of "
      "each strategy, on the fine mesh.",
      "tests/Alltest --verification -- -R foam_mapping");
  const std::map<Mapping, double> least = {{Mapping::nearest, 0.8},
                                           {Mapping::inverse_distance, 0.8},
                                           {Mapping::cell_point, 1.6},
                                           {Mapping::cell_point_face, 1.6},
                                           {Mapping::conservative, 1.8}};
  for (const bool distorted : {false, true}) {
    std::map<Mapping, std::vector<Measured>> found;
    std::vector<double> spacing;
    for (const int n : {4, 8}) {
      const auto cells = [n](int k) { return std::to_string(k * n * 3 / 2); };
      const FoamCase fluid(
          std::string("to_bulk_") + (distorted ? "distorted_" : "straight_") + std::to_string(n),
          {{"nx", cells(2)},
           {"ny", cells(1)},
           {"nz", cells(3)},
           {"walls_U", "{ type zeroGradient; }"},
           {"bottom_U", "{ type zeroGradient; }"}});
      if (distorted) distort(fluid, box.y / n / 1.5);
      spacing.push_back(box.y / n);
      for (const auto& [mapping, name] : enum_names<Mapping>)
        found[mapping].push_back(measure(fluid, n, mapping));
    }
    const std::string mesh = distorted ? "distorted" : "straight";
    for (const auto& [mapping, name] : enum_names<Mapping>) {
      const std::vector<Measured>& m = found[mapping];
      // OpenFOAM's face values are those of the line between two cell centres, beside the middle of a skewed
      // face.
      const bool skewed_faces = distorted && mapping == Mapping::cell_point_face;
      record.at_least(mesh + ", " + name + ": order", std::log2(m[0].error / m[1].error),
                      skewed_faces ? 0.8 : least.at(mapping));
      record.at_most(mesh + ", " + name + ": impulse of the particles against the fluid's", m[1].exchanged,
                     2.5e-13);
      if (interpolates(mapping))
        record.note(mesh + ", " + name + ": solid volume error on the mesh", m[1].solid);
      else
        record.at_most(mesh + ", " + name + ": solid volume error on the mesh", m[1].solid, 1.5e-13);
      record.curve("Velocity on the bulk grid, " + mesh + " cells", "bulk spacing, m", "mean error, m/s",
                   name, spacing, {m[0].error, m[1].error}, "xy");
    }
  }
}

}  // namespace
}  // namespace demvof::test
