// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/balance_mesh.hpp"

#include <unordered_map>

#include "decompositionMethod.H"
#include "dynamicRefineFvMesh.H"
#include "foam_side/flow.hpp"
#include "foam_side/foam_compat.hpp"
#include "mapDistributePolyMesh.H"
#include "wallDist.H"

namespace demvof {
namespace {

constexpr double worth_a_move = 1.05;  // imbalance over that which the last move left

/// Cells that came from one cell of the case's mesh.
struct Families {
  Foam::labelList of_cell;
  Foam::pointField centres;
  scalarField cells;  // how many
};

Families families(const Foam::dynamicRefineFvMesh& mesh) {
  const Foam::refinementHistory& history = mesh.meshCutter().history();
  const auto eldest = [&history](label cell) -> label {
    label one = history.active() ? history.visibleCells()[cell] : -1;
    while (one >= 0 && history.splitCells()[one].parent_ >= 0) one = history.splitCells()[one].parent_;
    return one;
  };
  Families all;
  all.of_cell.setSize(mesh.nCells());
  std::unordered_map<label, label> known;
  label count = 0;
  forAll(all.of_cell, cell) {
    const label parent = eldest(cell);
    if (parent < 0)
      all.of_cell[cell] = count++;
    else if (const auto [entry, news] = known.emplace(parent, count); all.of_cell[cell] = entry->second, news)
      ++count;
  }
  all.centres.setSize(count, vector::zero);
  all.cells.setSize(count, 0);
  forAll(all.of_cell, cell) {
    all.centres[all.of_cell[cell]] += mesh.C()[cell];
    all.cells[all.of_cell[cell]] += 1;
  }
  forAll(all.centres, family) all.centres[family] /= all.cells[family];
  return all;
}

/// Pieces along x, y, z: those of the case's own cut, or all along the longest side of the mesh.
vector pieces(const Foam::fvMesh& mesh) {
  const label ranks = Foam::Pstream::nProcs();
  const Foam::IOdictionary given(Foam::IOobject("decomposeParDict", mesh.time().system(), mesh.time(),
                                                Foam::IOobject::READ_IF_PRESENT, Foam::IOobject::NO_WRITE,
                                                false));
  const auto method = given.lookupOrDefault<Foam::word>("method", "none");
  for (const Foam::word& coefficients : {Foam::word(method + "Coeffs"), Foam::word("coeffs")}) {
    const auto n = given.optionalSubDict(coefficients).lookupOrDefault<vector>("n", vector::zero);
    if (std::lround(n.x() * n.y() * n.z()) == ranks) return n;
  }
  vector n(1, 1, 1);
  const vector sides = mesh.bounds().span();
  label longest = 0;
  for (label axis = 1; axis < 3; ++axis)
    if (sides[axis] > sides[longest]) longest = axis;
  n[longest] = ranks;
  return n;
}

Foam::labelList new_ranks(const Foam::dynamicRefineFvMesh& mesh) {
  Foam::dictionary how;
  how.add("numberOfSubdomains", Foam::Pstream::nProcs());
  how.add("method", "hierarchical");
  Foam::dictionary cut;
  cut.add("n", pieces(mesh));
  cut.add("order", "xyz");
  how.add("coeffs", cut);
  const Families all = families(mesh);
  const Foam::labelList of_family = Foam::decompositionMethod::New(how)->decompose(all.centres, all.cells);
  Foam::labelList of_cell(mesh.nCells());
  forAll(of_cell, cell) of_cell[cell] = of_family[all.of_cell[cell]];
  return of_cell;
}

/// Values across the new cuts: only there, since other patches may do more when they are evaluated.
template <class Type>
void fill_cuts(const Foam::fvMesh& mesh) {
  using Field = Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>;
  for (const Foam::word& name : mesh.sortedNames<Field>()) {
    auto& boundary = mesh.lookupObjectRef<Field>(name).boundaryFieldRef();
    for (auto& patch : boundary)
      if (patch.coupled()) patch.initEvaluate(Foam::Pstream::commsTypes::nonBlocking);
    Foam::Pstream::waitRequests();
    for (auto& patch : boundary)
      if (patch.coupled()) patch.evaluate(Foam::Pstream::commsTypes::nonBlocking);
  }
}

/// The distance from walls, to which turbulence models keep a reference: while the mesh is sent nobody may
/// throw it away, or form it anew on a half of the mesh. Its values go with the cells.
class KeptWallDistance {
 public:
  explicit KeptWallDistance(const Foam::fvMesh& mesh)
      : distance_(mesh.thisDb().getObjectPtr<Foam::wallDist>(Foam::wallDist::typeName)) {
    if (!distance_) return;
    distance_->release();
    distance_->checkOut();
  }
  /// For the mesh as it is now.
  void give_back() {
    if (!distance_) return;
    distance_->checkIn();
    distance_->store();
    distance_->movePoints();
  }

 private:
  Foam::wallDist* distance_;
};

void move_cells(Foam::dynamicRefineFvMesh& mesh, const Foam::labelList& ranks) {
  KeptWallDistance distance(mesh);
  const auto map = distribute_mesh(mesh, ranks);
  // As OpenFOAM does: the engine has no other way in.
  const_cast<Foam::hexRef8&>(mesh.meshCutter()).distribute(map());
  if (Foam::returnReduce(!mesh.protectedCell().empty(), Foam::orOp<bool>())) {
    Foam::boolList kept = mesh.protectedCell().values();
    map().distributeCellData(kept);
    mesh.protectedCell() = Foam::bitSet(kept);
  }
  distance.give_back();
  fill_cuts<scalar>(mesh);
  fill_cuts<vector>(mesh);
  fill_cuts<Foam::symmTensor>(mesh);
  fill_cuts<Foam::tensor>(mesh);
}

}  // namespace

double imbalance(const Foam::fvMesh& mesh) {
  const double most = Foam::returnReduce(mesh.nCells(), Foam::maxOp<label>());
  const double all = Foam::returnReduce(mesh.nCells(), Foam::sumOp<label>());
  return most * Foam::Pstream::nProcs() / all;
}

bool cells_stay(const Foam::fvMesh& mesh) {
  for (const Foam::polyPatch& patch : mesh.boundaryMesh())
    if (patch.coupled() && !Foam::isA<Foam::processorPolyPatch>(patch)) return true;
  return false;
}

bool balance_mesh(Flow& flow) {
  if (!Foam::Pstream::parRun() || !flow.refinement || cells_stay(flow.mesh)) return false;
  Refinement& refinement = *flow.refinement;
  const double now = imbalance(flow.mesh);
  if (now <= std::max(refinement.parameters.max_imbalance, worth_a_move * refinement.left_imbalance))
    return false;
  auto& mesh = dynamic_cast<Foam::dynamicRefineFvMesh&>(flow.mesh);
  move_cells(mesh, new_ranks(mesh));
  refinement.left_imbalance = imbalance(flow.mesh);
  ++refinement.moves;
  return true;
}

}  // namespace demvof
