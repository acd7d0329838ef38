// SPDX-License-Identifier: GPL-3.0-or-later
// Cells that move between ranks take everything along: every registered field on cells with its old values,
// the values across the new cuts, the velocity on faces, and the knowledge of which cells were one.

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "dynamicRefineFvMesh.H"
#include "foam_case.hpp"
#include "foam_side/balance_mesh.hpp"
#include "syncTools.H"
#include "tests/support/mpi_main.hpp"
#include "wallDist.H"

namespace demvof::test {
namespace {

using Place = std::array<long, 3>;  // nm
template <class Type>
using Values = std::map<Place, Type>;

Place place(const vector& x) {
  return {std::lround(1e9 * x.x()), std::lround(1e9 * x.y()), std::lround(1e9 * x.z())};
}

/// Values at places, of all ranks, on all ranks. Where two ranks have the same place, those of the last one.
template <class Type>
Values<Type> everywhere(const Foam::vectorField& places, const Foam::Field<Type>& values) {
  Foam::List<Foam::vectorField> all_places(Foam::Pstream::nProcs());
  Foam::List<Foam::Field<Type>> all_values(Foam::Pstream::nProcs());
  all_places[Foam::Pstream::myProcNo()] = places;
  all_values[Foam::Pstream::myProcNo()] = values;
  Foam::Pstream::gatherList(all_places);
  Foam::Pstream::scatterList(all_places);
  Foam::Pstream::gatherList(all_values);
  Foam::Pstream::scatterList(all_values);
  Values<Type> map;
  forAll(all_values, rank) forAll(all_values[rank], i) map[place(all_places[rank][i])] = all_values[rank][i];
  return map;
}

/// Fields on cells by name; patch values do not count.
template <class Field>
void add_cell_fields(const Foam::fvMesh& mesh,
                     std::map<std::string, Values<typename Field::value_type>>& all) {
  for (const Foam::word& name : mesh.sortedNames<Field>()) {
    const Foam::Field<typename Field::value_type>& values = mesh.lookupObject<Field>(name);
    all[name] = everywhere(mesh.C().primitiveField(), values);
  }
}

struct State {
  std::map<std::string, Values<scalar>> scalars;
  std::map<std::string, Values<vector>> vectors, faces;
};

State state_of(const Flow& flow) {
  const Foam::fvMesh& mesh = flow.mesh;
  State state;
  add_cell_fields<volScalarField>(mesh, state.scalars);
  add_cell_fields<volScalarField::Internal>(mesh, state.scalars);
  add_cell_fields<volVectorField>(mesh, state.vectors);
  add_cell_fields<volVectorField::Internal>(mesh, state.vectors);
  scalarField levels(mesh.nCells());
  const auto& level = dynamic_cast<const Foam::dynamicRefineFvMesh&>(mesh).meshCutter().cellLevel();
  forAll(levels, cell) levels[cell] = level[cell];
  state.scalars["level"] = everywhere(mesh.C().primitiveField(), levels);
  // What the flux is made of anew (settle_flux). Other fields on faces are made anew, too, or live in a stage
  // only.
  Foam::vectorField places(mesh.nFaces()), values(mesh.nFaces());
  for (label face = 0; face < mesh.nFaces(); ++face) {
    const label patch = face < mesh.nInternalFaces() ? -1 : mesh.boundaryMesh().whichPatch(face);
    places[face] = mesh.faceCentres()[face];
    values[face] =
        patch < 0 ? (*flow.face_velocity)[face]
                  : flow.face_velocity->boundaryField()[patch][face - mesh.boundaryMesh()[patch].start()];
  }
  state.faces["Uf"] = everywhere(places, values);
  return state;
}

/// tolerance: relative.
template <class Type>
void expect_same(const std::map<std::string, Values<Type>>& before,
                 const std::map<std::string, Values<Type>>& after, double tolerance = 0) {
  EXPECT_EQ(before.size(), after.size());
  for (const auto& [name, values] : before) {
    ASSERT_TRUE(after.count(name)) << name;
    const Values<Type>& there = after.at(name);
    ASSERT_EQ(values.size(), there.size()) << name;
    long other = 0;
    for (const auto& [where, value] : values)
      other += there.count(where) == 0 || Foam::mag(there.at(where) - value) > tolerance * Foam::mag(value);
    EXPECT_EQ(other, 0) << name << ", of " << values.size();
  }
}

/// What a processor patch holds of each field is the value of the cell on the other side.
template <class Type>
void expect_same_across_cuts(const Foam::fvMesh& mesh) {
  using Field = Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>;
  for (const Foam::word& name : mesh.sortedNames<Field>()) {
    const auto& field = mesh.lookupObject<Field>(name);
    Foam::List<Type> across;
    Foam::syncTools::swapBoundaryCellList(mesh, field.primitiveField(), across);
    for (const auto& patch : field.boundaryField()) {
      if (!patch.coupled()) continue;
      const label start = patch.patch().start() - mesh.nInternalFaces();
      forAll(patch, i) EXPECT_EQ(patch[i], across[start + i]) << name;
    }
  }
}

/// As turbulence models have it: they keep the reference.
const Foam::wallDist& distance_from_sides(const Foam::fvMesh& mesh) {
  const Foam::labelHashSet sides{mesh.boundaryMesh().findPatchID("walls")};
  return Foam::wallDist::New(mesh, Foam::word("meshWave"), sides, Foam::word("wall"));
}

double ball(const vector& x, double at) {
  return Foam::mag(x - vector(0.1, 0.05, at)) < 0.03 ? 1 : 0;
}

TEST(BalancedRanks, EverythingGoesAlong) {
  RefinementParameters refinement;
  refinement.levels = 2;
  refinement.max_imbalance = 1e9;
  const FoamCase box("balanced_ranks", {{"nx", "10"}, {"ny", "5"}, {"nz", "15"}, {"p_tolerance", "1e-10"}},
                     "(1 1 3)");
  const auto flow = box.open(scene(true, true, true), &refinement);
  const Foam::wallDist& distance = distance_from_sides(flow->mesh);
  const double low = 0.06;
  set_alpha(*flow, [&](const vector& x) { return ball(x, low); });
  const auto bed = [&] {
    return cell_values(*flow, [&](const vector& x) { return 1 - 0.4 * ball(x, low); });
  };
  set_initial_porosity(*flow, bed());
  const label all = Foam::returnReduce(flow->mesh.nCells(), Foam::sumOp<label>());
  begin_window(*flow, 2e-4);
  set_porosity_target(*flow, bed());
  while (advance_clock(*flow)) do_step(*flow);

  State before = state_of(*flow);
  const double was = imbalance(flow->mesh);
  EXPECT_FALSE(balance_mesh(*flow)) << "nobody asked for it";
  flow->refinement->parameters.max_imbalance = 1;
  EXPECT_TRUE(balance_mesh(*flow));
  const double is = imbalance(flow->mesh);
  if (Foam::Pstream::master())
    std::cout << "most cells on a rank over the mean: " << was << ", then " << is << "\n";
  EXPECT_GT(was, 1.5);
  EXPECT_LT(is, 1.1);
  State after = state_of(*flow);
  for (State* state : {&before, &after}) state->scalars.erase("yWall");  // found anew, from rank to rank
  expect_same(before.scalars, after.scalars);
  expect_same(before.vectors, after.vectors);
  expect_same(before.faces, after.faces, 1e-13);  // the two ranks at a cut differ in the last digit
  expect_same_across_cuts<scalar>(flow->mesh);
  expect_same_across_cuts<vector>(flow->mesh);
  EXPECT_FALSE(balance_mesh(*flow)) << "nothing left to gain";

  // Without a surface, nor a bed, the mesh is the case's again.
  set_alpha(*flow, [](const vector&) { return 0; });
  set_initial_porosity(*flow, scalarField(flow->mesh.nCells(), 1.0));
  for (int window = 0; window < 4; ++window) {
    begin_window(*flow, flow->time.value() + 1e-4);
    set_porosity_target(*flow, scalarField(flow->mesh.nCells(), 1.0));
    flow->refinement->first = true;
    while (advance_clock(*flow)) do_step(*flow);
  }
  EXPECT_EQ(Foam::returnReduce(flow->mesh.nCells(), Foam::sumOp<label>()), all);

  // The distance that somebody has a reference to is that of the mesh as it is now.
  EXPECT_EQ(&distance, &distance_from_sides(flow->mesh));
  const scalarField y(distance.y().primitiveField());
  ASSERT_EQ(y.size(), flow->mesh.nCells());
  const_cast<Foam::wallDist&>(distance).release();
  const_cast<Foam::wallDist&>(distance).checkOut();
  EXPECT_EQ(Foam::gMax(Foam::mag(y - distance_from_sides(flow->mesh).y().primitiveField())()), 0);
}

}  // namespace
}  // namespace demvof::test
