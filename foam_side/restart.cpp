// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <numeric>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/base/words_of.hpp"
#include "coupler/config/read_case.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/output/state_frame.hpp"
#include "coupler/output/write_file.hpp"
#include "foam_side/continued_fields.hpp"
#include "foam_side/gathered_state.hpp"
#include "foam_side/write_fields.hpp"
#include "labelIOList.H"

namespace demvof {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path file_of_rank(const fs::path& run, long window) {
  return restart_folder(run, window) / fmt::format("fluid.{}", Foam::Pstream::myProcNo());
}

template <class T>
json as_json(const CellValues<T>& values) {
  const auto* first = reinterpret_cast<const double*>(values.values.data());
  return {{"cells", values.cells},
          {"values", std::vector<double>(first, first + values.values.size() * row_width<T>())}};
}

template <class T>
CellValues<T> cell_values(const json& saved) {
  CellValues<T> read;
  saved.at("cells").get_to(read.cells);
  const auto values = saved.at("values").get<std::vector<double>>();
  read.values.resize(read.cells.size());
  auto* first = reinterpret_cast<double*>(read.values.data());
  if (values.size() != read.cells.size() * row_width<T>()) throw InputError("not as many values as cells");
  std::copy(values.begin(), values.end(), first);
  return read;
}

Vec3 vec3(const json& row) {
  return {row.at(0), row.at(1), row.at(2)};
}

json as_json(const OwedPressure::State& state) {
  const Vec3& way = state.on_its_way;
  return {{"owed", as_json(state.owed)},
          {"elsewhere", as_json(state.elsewhere)},
          {"steepest", as_json(state.steepest)},
          {"on_its_way", {way.x, way.y, way.z}},
          {"turnover", state.turnover}};
}

OwedPressure::State owed_pressure(const json& saved) {
  return {cell_values<LeftOver::Owed>(saved.at("owed")), cell_values<Vec3>(saved.at("elsewhere")),
          cell_values<double>(saved.at("steepest")), vec3(saved.at("on_its_way")),
          saved.at("turnover").get<double>()};
}

std::vector<double> components(const Foam::vectorField& values) {
  std::vector<double> row;
  for (const vector& v : values) row.insert(row.end(), {v.x(), v.y(), v.z()});
  return row;
}

void read_components(const json& state, const char* name, Foam::vectorField& values) {
  const auto row = state.at(name).get<std::vector<double>>();
  forAll(values, cell) for (int axis = 0; axis < 3; ++axis) values[cell][axis] =
      row.at(static_cast<std::size_t>(3 * cell + axis));
}

/// Of this rank's cells in the mesh of all ranks; on a mesh that changes there are none that last.
std::vector<int> cell_numbers(const Flow& flow) {
  const Foam::fvMesh& mesh = flow.mesh;
  std::vector<int> numbers(static_cast<std::size_t>(mesh.nCells()));
  std::iota(numbers.begin(), numbers.end(), 0);
  if (!Foam::Pstream::parRun() || flow.refinement) return numbers;
  const Foam::labelIOList given(Foam::IOobject("cellProcAddressing", mesh.facesInstance(),
                                               Foam::polyMesh::meshSubDir, mesh, Foam::IOobject::MUST_READ,
                                               Foam::IOobject::NO_WRITE, false));
  std::copy(given.begin(), given.end(), numbers.begin());
  return numbers;
}

json flow_state(const Flow& flow, const ForceParameters& forces) {
  json state = {{"time_step", flow.time.deltaTValue()},
                {"longest_step", flow.clock.limit},
                {"largest_courant", flow.clock.largest_courant},
                {"cells", flow.mesh.nCells()},
                {"cell_numbers", cell_numbers(flow)}};
  const vector& g = flow.g.value();
  state["gravity"] = {g.x(), g.y(), g.z()};
  if (flow.refinement) state["crossed"] = flow.refinement->crossed;
  if (flow.porosity) {
    const scalarField& goal = flow.porosity->goal.field();
    state["void_fraction_goal"] = std::vector<double>(goal.begin(), goal.end());
  }
  if (need_acceleration(forces))  // Du/Dt looks back by a step
    state["velocity_before"] = components(flow.U.oldTime().primitiveField());
  for (const ContinuedField& field : continued_fields)
    if (const Foam::vectorField* values = field.find(flow)) state[field.name] = components(*values);
  return state;
}

void go_on(Flow& flow, const json& state) {
  if (state.at("cells") != flow.mesh.nCells()) throw InputError("the mesh has another number of cells");
  flow.time.setDeltaT(state.at("time_step"), false);
  flow.clock.limit = state.at("longest_step");
  flow.clock.largest_courant = state.at("largest_courant");
  set_gravity(flow, vec3(state.at("gravity")));
  if (flow.refinement) {
    flow.refinement->crossed = state.at("crossed");
    flow.refinement->first = false;
  }
  if (flow.porosity) {
    if (!state.contains("void_fraction_goal")) throw InputError("the flow had no void fraction, it has now");
    const auto goal = state.at("void_fraction_goal").get<std::vector<double>>();
    forAll(flow.porosity->goal, cell) flow.porosity->goal[cell] = goal.at(static_cast<std::size_t>(cell));
  }
  if (flow.ghost) add_ghost_density(flow);
  for (const ContinuedField& field : continued_fields)
    if (state.contains(field.name)) read_components(state, field.name, field.of(flow));
  if (state.contains("velocity_before"))
    read_components(state, "velocity_before", flow.U.oldTime().primitiveFieldRef());
}

/// The text of each rank, on rank 0.
std::vector<std::string> gather(const std::string& mine, const OwnWorld& world) {
  const int length = static_cast<int>(mine.size()), ranks = world.rank() == 0 ? world.size() : 0;
  std::vector<int> lengths(static_cast<std::size_t>(ranks)), starts(lengths.size());
  check_mpi(MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, world.comm()), "MPI_Gather");
  int total = 0;
  for (std::size_t rank = 0; rank < lengths.size(); ++rank) {
    starts[rank] = total;
    total += lengths[rank];
  }
  std::string all(static_cast<std::size_t>(total), ' ');
  check_mpi(MPI_Gatherv(mine.data(), length, MPI_CHAR, all.data(), lengths.data(), starts.data(), MPI_CHAR, 0,
                        world.comm()),
            "MPI_Gatherv");
  std::vector<std::string> texts;
  for (std::size_t rank = 0; rank < lengths.size(); ++rank)
    texts.push_back(
        all.substr(static_cast<std::size_t>(starts[rank]), static_cast<std::size_t>(lengths[rank])));
  return texts;
}

/// Does the work on every rank; when it throws on one, throws on all. Rank 0 knows the reason.
void on_every_rank(const OwnWorld& world, const std::function<void()>& work) {
  std::string error;
  try {
    work();
  } catch (const Foam::IOerror& e) {
    error = fmt::format("{}: {}: is the disk full?", e.ioFileName(), e.message());
  } catch (const Foam::error& e) {  // its what() says nothing
    error = e.message();
  } catch (const std::exception& e) {
    error = words_of(e);
  }
  int failed = !error.empty();
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, world.comm()), "MPI_Allreduce");
  if (!failed) return;
  for (const std::string& said : gather(error, world))
    if (error.empty()) error = said;
  throw RunError(error.empty() ? "another rank could not write its part of the state" : error);
}

StateFiles all_files(const std::string& mine, const std::string& of_particles, const OwnWorld& world) {
  StateFiles files = state_files(of_particles);
  for (const std::string& text : gather(mine, world))
    for (const auto& [name, facts] : state_files(text)) files[name] = facts;
  return files;
}

void write_fluid_restart(const fs::path& run, long window, const Flow& flow, const ForceParameters& forces,
                         const Bridge& bridge, const RunRecord& record, const WindowSteps& steps) {
  json exchange = json::array();
  for (const Bridge::State& fluid : bridge.state())
    exchange.push_back({{"particles", as_json(fluid.particles)},
                        {"left_over", as_json(fluid.left_over)},
                        {"felt_shift", as_json(fluid.felt_shift)},
                        {"solid_volume_before", as_json(fluid.solid_volume_before)},
                        {"seen", as_json(fluid.seen)},
                        {"owed_pressure", as_json(fluid.owed_pressure)}});
  const OpeningsToBulk::State& openings = bridge.openings_to_bulk().state();
  const json state = {{"flow", flow_state(flow, forces)},
                      {"exchange", exchange},
                      {"surface", as_json(bridge.surface_to_bulk().seen())},
                      {"openings",
                       {{"shares", as_json(openings.told.shares)},
                        {"walls", as_json(openings.told.walls)},
                        {"shares_of_mesh", as_json(openings.shares)}}},
                      {"books", record.books()},
                      {"window_steps", {steps.last, steps.next}}};
  const std::vector<std::uint8_t> bytes = json::to_cbor(state);
  const fs::path path = file_of_rank(run, window);
  fs::create_directories(path.parent_path());
  write_file_atomically(path, std::string(bytes.begin(), bytes.end()));
}

/// How many have written fluid.<rank>.
int ranks_of(const RestartPoint& point) {
  int ranks = 0;
  while (point.files.count(fmt::format("restart/{}/fluid.{}", point.window, ranks))) ++ranks;
  return ranks;
}

/// read(state); what is not as it was written is the user's to know.
template <class Read>
auto part_of(const json& state, const Read& read) {
  try {
    return read(state);
  } catch (const json::exception& error) {
    throw InputError(fmt::format("--continue: the state of the fluid: {}", error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("--continue: the state of the fluid: {}", error.what()));
  }
}

}  // namespace

/// Of this rank; no step changes them.
const StateFiles& mesh_files(const fs::path& run, const Flow& flow) {
  static const StateFiles files = [&] {
    StateFiles found;
    add_state_folder(found, run,
                     fs::path(static_cast<const std::string&>(flow.time.path())) / "constant" / "polyMesh");
    return found;
  }();
  return files;
}

void write_state(const fs::path& run, const CaseParameters& parameters, long window, Flow& flow,
                 const Bridge& bridge, const RunRecord& record, const WindowSteps& steps, FluidEnd& link,
                 const OwnWorld& world) {
  run_stage().set("field output", flow.time.value());
  StateFiles files;
  on_every_rank(world, [&] {
    write_fields(flow);
    write_fluid_restart(run, window, flow, parameters.forces, bridge, record, steps);
    add_state_folder(files, run, time_folder(flow));
    files.insert(mesh_files(run, flow).begin(), mesh_files(run, flow).end());
    add_state_file(files, run, file_of_rank(run, window));
    if (world.rank() == 0) add_state_file(files, run, run / "history.csv", true);
  });
  const std::string of_particles = link.both_have_written();
  const StateFiles all = all_files(to_text(files), of_particles, world);
  if (world.rank() == 0)
    write_restart_point(run,
                        {window, flow.time.value(), flow.time.timeName(),
                         state_frame(parameters, world.size()), resolved_configuration(parameters), all},
                        parameters.output.states);
}

RestartPoint open_state(const ProgramOptions& options, const CaseParameters& parameters,
                        const OwnWorld& world) {
  const StateFrame now = state_frame(parameters, world.size());
  const RestartPoint point = read_restart_point(options.out, options.from, now, parameters.coupling.end_time);
  const bool own = ranks_of(point) == world.size() && point.frame.bulk_blocks == now.bulk_blocks;
  const std::string states = fmt::format("restart/{}/fluid.", point.window);
  const std::string fields =
      world.size() > 1 ? fmt::format("fluid/processor{}/", world.rank()) : std::string("fluid/");
  require_whole(options.out, point, [&](const std::string& name) {
    return (own ? name == states + std::to_string(world.rank()) : name.rfind(states, 0) == 0) ||
           name.rfind(fields, 0) == 0 || (world.rank() == 0 && name == "history.csv");
  });
  return point;
}

json read_fluid_restart(const fs::path& run, const RestartPoint& point, const Flow& flow,
                        const BulkPartition& mine, const OwnWorld& world) {
  const int ranks = ranks_of(point);
  fs::path path;
  try {
    const auto read = [&](int rank) {
      path = restart_folder(run, point.window) / fmt::format("fluid.{}", rank);
      return json::from_cbor(std::ifstream(path, std::ios::binary));
    };
    if (ranks == world.size() && point.frame.bulk_blocks == mine.blocks()) return read(world.rank());
    std::vector<json> all;
    for (int rank = 0; rank < ranks; ++rank) all.push_back(read(rank));
    json state = gathered_state(
        all, [&](CellId cell) { return mine.owner(cell) == world.rank(); }, world.rank() == 0);
    state["flow"] = ranks == world.size() ? all.at(static_cast<std::size_t>(world.rank())).at("flow")
                                          : gathered_flow(all, cell_numbers(flow));
    return state;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("--continue: {}: {}", path.string(), error.what()));
  }
}

CellValues<BulkSurface> seen_surface(const json& saved) {
  return part_of(saved, [](const json& state) { return cell_values<BulkSurface>(state.at("surface")); });
}

OpeningsToBulk::State seen_openings(const json& saved) {
  return part_of(saved, [](const json& state) -> OpeningsToBulk::State {
    const json& openings = state.at("openings");
    return {{cell_values<double>(openings.at("shares")), cell_values<BulkWalls>(openings.at("walls"))},
            cell_values<double>(openings.at("shares_of_mesh"))};
  });
}

WindowSteps go_on_from(const json& saved, long window, Flow& flow, Bridge& bridge, RunRecord& record,
                       const ParticleReport& particles) {
  return part_of(saved, [&](const json& state) -> WindowSteps {
    std::vector<Bridge::State> exchange;
    for (const json& fluid : state.at("exchange"))
      exchange.push_back(
          {cell_values<BulkParticles>(fluid.at("particles")),
           cell_values<LeftOver::Owed>(fluid.at("left_over")), cell_values<Vec3>(fluid.at("felt_shift")),
           cell_values<double>(fluid.at("solid_volume_before")),
           cell_values<SeenFluid::Cell>(fluid.at("seen")), owed_pressure(fluid.at("owed_pressure"))});
    bridge.go_on_from(std::move(exchange));
    go_on(flow, state.at("flow"));
    record.go_on(flow, particles, window, state.at("books"));
    const json& steps = state.at("window_steps");
    return {steps.at(0), steps.at(1)};
  });
}

}  // namespace demvof
