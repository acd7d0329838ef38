// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/refinement.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "coupler/base/errors.hpp"
#include "dynamicRefineFvMesh.H"
#include "foam_side/flow.hpp"
#include "syncTools.H"

namespace demvof {
namespace {

constexpr double pure = 0.01;         // alpha nearer to 0 or 1 than this is no interface
constexpr double no_particle = 1e-6;  // solid fraction that counts as none
constexpr const char* written_here = "// Written by foam_side from fluid.refinement of the case file.";

/// Marks both cells of every face over which the field jumps by more than a limit.
void mark_jumps(volScalarField& mark, const volScalarField& field, double limit) {
  const Foam::fvMesh& mesh = mark.mesh();
  forAll(mesh.owner(), face) {
    const label owner = mesh.owner()[face], neighbour = mesh.neighbour()[face];
    if (std::abs(field[owner] - field[neighbour]) > limit) mark[owner] = mark[neighbour] = 1;
  }
  forAll(field.boundaryField(), patch) {
    const auto& at_patch = field.boundaryField()[patch];
    if (!at_patch.coupled()) continue;
    const scalarField there(at_patch.patchNeighbourField());
    const Foam::labelUList& cells = at_patch.patch().faceCells();
    forAll(cells, i) if (std::abs(field[cells[i]] - there[i]) > limit) mark[cells[i]] = 1;
  }
}

/// How often a cell of the case's mesh has been halved to give each cell.
const Foam::labelList& levels_of(const Foam::fvMesh& mesh) {
  return dynamic_cast<const Foam::dynamicRefineFvMesh&>(mesh).meshCutter().cellLevel();
}

/// Marks the neighbours of marked cells.
void add_ring(volScalarField& mark) {
  mark.correctBoundaryConditions();
  const scalarField before(mark.primitiveField());
  const Foam::fvMesh& mesh = mark.mesh();
  forAll(mesh.owner(), face) {
    const label owner = mesh.owner()[face], neighbour = mesh.neighbour()[face];
    if (before[owner] > 0) mark[neighbour] = 1;
    if (before[neighbour] > 0) mark[owner] = 1;
  }
  for (const auto& at_patch : mark.boundaryField()) {
    if (!at_patch.coupled()) continue;
    const scalarField there(at_patch.patchNeighbourField());
    const Foam::labelUList& cells = at_patch.patch().faceCells();
    forAll(cells, i) if (there[i] > 0) mark[cells[i]] = 1;
  }
}

/// Marks all cells that share a point with a marked one, across cuts between ranks and cyclic patches too.
void add_ring_by_points(volScalarField& mark) {
  const Foam::fvMesh& mesh = mark.mesh();
  const Foam::labelListList& cells_of = mesh.pointCells();
  scalarField marked(mesh.nPoints(), Foam::Zero);
  forAll(marked, point) for (const label cell : cells_of[point]) marked[point] =
      std::max(marked[point], mark[cell]);
  Foam::syncTools::syncPointList(mesh, marked, Foam::maxEqOp<scalar>(), scalar(0));
  forAll(marked, point) if (marked[point] > 0) for (const label cell : cells_of[point]) mark[cell] = 1;
}

}  // namespace

namespace {

/// more: further entries.
void write_dictionary(const std::filesystem::path& file, const RefinementParameters& parameters,
                      const std::string& more = "") {
  std::ofstream out(file);
  // OpenFOAM takes the mean of the marks around a point, of the rank's own cells, and refines the cells of
  // points above the lower level: with 1 those that are marked, since the last ring is all around points
  // (add_ring_by_points), on any number of ranks. A ring of hysteresis (nBufferLayers) keeps what was fine.
  // Fluxes on new faces are rebuilt by this program: "none".
  out << written_here
      << "\nFoamFile { version 2.0; format ascii; class dictionary; object dynamicMeshDict; }\n"
      << fmt::format(
             "dynamicFvMesh dynamicRefineFvMesh;\nrefineInterval 1;\nfield refinementMark;\n"
             "lowerRefineLevel 0.99;\nupperRefineLevel 10;\nunrefineLevel 0.5;\nnBufferLayers 1;\n"
             "maxRefinement {};\nmaxCells {};\ndumpLevel true;\n",
             parameters.levels, parameters.max_cells)
      << more
      << "correctFluxes ( (phi none) (phi_0 none) (rhoPhi none) (nHatf none) (ghf none) (Uf none)\n"
         "    (alphaPhi0.water none) );\n";
  if (!out.flush()) throw InputError(fmt::format("fluid.refinement: {} cannot be written", file.string()));
}

}  // namespace

void write_mesh_dictionary(const std::filesystem::path& fluid_case, const RefinementParameters& parameters) {
  const std::filesystem::path file = fluid_case / "constant" / "dynamicMeshDict";
  std::string first_line;
  if (std::ifstream there(file); there && std::getline(there, first_line) && first_line != written_here)
    throw InputError(
        fmt::format("fluid.refinement: the fluid case says in constant/dynamicMeshDict how its mesh changes; "
                    "remove that file or the section fluid.refinement"));
  write_dictionary(file, parameters);
}

std::optional<RefinementParameters> take_refinement_of_case(const Foam::Time& time) {
  const Foam::IOdictionary given(Foam::IOobject("dynamicMeshDict", time.constant(), time,
                                                Foam::IOobject::READ_IF_PRESENT, Foam::IOobject::NO_WRITE,
                                                false));
  const Foam::word type = given.lookupOrDefault<Foam::word>("dynamicFvMesh", "staticFvMesh");
  if (type != "dynamicRefineFvMesh") return std::nullopt;
  const Foam::IOdictionary fluids(Foam::IOobject("transportProperties", time.constant(), time,
                                                 Foam::IOobject::MUST_READ, Foam::IOobject::NO_WRITE, false));
  const Foam::word liquid = Foam::wordList(fluids.lookup("phases"))[0];
  const Foam::dictionary& entries = given.optionalSubDict(type + "Coeffs");
  const Foam::word field(entries.lookup("field"));
  const bool taken_before = entries.lookupOrDefault("takenFromCase", false);
  if (field != "alpha." + liquid && !taken_before)
    throw InputError(fmt::format(
        "constant/dynamicMeshDict: dynamicRefineFvMesh refines by {}: with particles a mesh is fine where "
        "alpha.{} says where the surface is, or as a section fluid.refinement of the case file says: remove "
        "the file, and write that section",
        field, liquid));
  RefinementParameters parameters;
  parameters.levels = Foam::readLabel(entries.lookup("maxRefinement"));
  parameters.max_cells = Foam::readLabel(entries.lookup("maxCells"));
  parameters.buffer = std::max(1, static_cast<int>(Foam::readLabel(entries.lookup("nBufferLayers"))));
  if (taken_before) parameters.buffer = Foam::readLabel(entries.lookup("rings"));
  Foam::returnReduce(true, Foam::andOp<bool>());  // all ranks have read it
  if (Foam::Pstream::master())
    write_dictionary(std::string(time.rootPath()) + "/" + time.globalCaseName() + "/constant/dynamicMeshDict",
                     parameters, fmt::format("takenFromCase true;\nrings {};\n", parameters.buffer));
  Foam::returnReduce(true, Foam::andOp<bool>());
  return parameters;
}

std::string refined_as_of_case(const RefinementParameters& parameters) {
  return fmt::format(
      "constant/dynamicMeshDict: the mesh refines itself as with fluid.refinement: {{levels: {}, buffer: {}, "
      "max_cells: {}}}, where {} < alpha < {} (docs/howto_your_own_case.md)",
      parameters.levels, parameters.buffer, parameters.max_cells, pure, 1 - pure);
}

Refinement::Refinement(const Foam::fvMesh& mesh, const RefinementParameters& given)
    : parameters(given),
      mark(Foam::IOobject("refinementMark", mesh.time().timeName(), mesh), mesh,
           dimensionedScalar(Foam::dimless, Foam::Zero), Foam::zeroGradientFvPatchScalarField::typeName) {}

bool Refinement::due(const Flow& flow) {
  crossed += flow.clock.interface_courant;
  if (!first && crossed < parameters.buffer - 0.5 && !particles_leave(flow)) return false;
  crossed = 0;
  return true;
}

bool Refinement::particles_leave(const Flow& flow) const {
  if (!parameters.particles || !flow.porosity) return false;
  if (Foam::returnReduce(flow.mesh.nCells(), Foam::sumOp<label>()) >= parameters.max_cells) return false;
  const Foam::labelList& level = levels_of(flow.mesh);
  bool coarse = false;
  forAll(level, cell) coarse =
      coarse || (level[cell] < parameters.levels && flow.porosity->eps[cell] < 1 - no_particle);
  return Foam::returnReduce(coarse, Foam::orOp<bool>());
}

void Refinement::set_marks(const Flow& flow) {
  mark.primitiveFieldRef() = 0;
  if (flow.scene.interface_advection) {
    forAll(mark, cell) if (flow.alpha[cell] > pure && flow.alpha[cell] < 1 - pure) mark[cell] = 1;
    mark_jumps(mark, flow.alpha, pure);
  }
  if (flow.porosity) {
    const volScalarField& eps = flow.porosity->eps;
    if (parameters.particles) forAll(mark, cell) if (eps[cell] < 1 - no_particle) mark[cell] = 1;
    if (parameters.porosity_jump > 0) mark_jumps(mark, eps, parameters.porosity_jump);
  }
  for (int ring = 1; ring < parameters.buffer; ++ring) add_ring(mark);
  add_ring_by_points(mark);
  mark.correctBoundaryConditions();
}

}  // namespace demvof
