// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/restart.hpp"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/output/write_file.hpp"

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

json flow_state(const Flow& flow, const ForceParameters& forces) {
  json state = {{"time_step", flow.time.deltaTValue()},
                {"longest_step", flow.clock.limit},
                {"largest_courant", flow.clock.largest_courant},
                {"cells", flow.mesh.nCells()}};
  if (flow.refinement) state["crossed"] = flow.refinement->crossed;
  if (flow.porosity) {
    const scalarField& goal = flow.porosity->goal.field();
    state["void_fraction_goal"] = std::vector<double>(goal.begin(), goal.end());
  }
  if (forces.added_mass > 0) {  // Du/Dt looks back by a step
    std::vector<double> components;
    for (const vector& u : flow.U.oldTime().primitiveField())
      components.insert(components.end(), {u.x(), u.y(), u.z()});
    state["velocity_before"] = components;
  }
  return state;
}

void go_on(Flow& flow, const json& state) {
  if (state.at("cells") != flow.mesh.nCells()) throw InputError("the mesh has another number of cells");
  flow.time.setDeltaT(state.at("time_step"), false);
  flow.clock.limit = state.at("longest_step");
  flow.clock.largest_courant = state.at("largest_courant");
  if (flow.refinement) {
    flow.refinement->crossed = state.at("crossed");
    flow.refinement->first = false;
  }
  if (flow.porosity) {
    const auto goal = state.at("void_fraction_goal").get<std::vector<double>>();
    forAll(flow.porosity->goal, cell) flow.porosity->goal[cell] = goal.at(static_cast<std::size_t>(cell));
  }
  if (flow.ghost) add_ghost_density(flow);
  if (!state.contains("velocity_before")) return;
  const auto before = state.at("velocity_before").get<std::vector<double>>();
  Foam::vectorField& velocity = flow.U.oldTime().primitiveFieldRef();
  forAll(velocity, cell) for (int axis = 0; axis < 3; ++axis) velocity[cell][axis] =
      before.at(static_cast<std::size_t>(3 * cell + axis));
}

}  // namespace

void write_fluid_restart(const fs::path& run, long window, const Flow& flow, const ForceParameters& forces,
                         const Bridge& bridge, const RunRecord& record) {
  json exchange = json::array();
  for (const Bridge::State& fluid : bridge.state())
    exchange.push_back({{"particles", as_json(fluid.particles)},
                        {"left_over", as_json(fluid.left_over)},
                        {"felt_shift", as_json(fluid.felt_shift)},
                        {"solid_volume_before", as_json(fluid.solid_volume_before)},
                        {"told", as_json(fluid.told)}});
  const json state = {{"flow", flow_state(flow, forces)}, {"exchange", exchange}, {"books", record.books()}};
  const std::vector<std::uint8_t> bytes = json::to_cbor(state);
  const fs::path path = file_of_rank(run, window);
  fs::create_directories(path.parent_path());
  write_file_atomically(path, std::string(bytes.begin(), bytes.end()));
}

void read_fluid_restart(const fs::path& run, long window, Flow& flow, Bridge& bridge, RunRecord& record,
                        const ParticleReport& particles) {
  const fs::path path = file_of_rank(run, window);
  try {
    std::ifstream stream(path, std::ios::binary);
    const json state = json::from_cbor(stream);
    std::vector<Bridge::State> exchange;
    for (const json& fluid : state.at("exchange"))
      exchange.push_back({cell_values<BulkParticles>(fluid.at("particles")),
                          cell_values<LeftOver::Owed>(fluid.at("left_over")),
                          cell_values<Vec3>(fluid.at("felt_shift")),
                          cell_values<double>(fluid.at("solid_volume_before")),
                          cell_values<ToldFluid::Cell>(fluid.at("told"))});
    bridge.go_on_from(std::move(exchange));
    go_on(flow, state.at("flow"));
    record.go_on(flow, particles, window, state.at("books"));
  } catch (const json::exception& error) {
    throw InputError(fmt::format("--continue: {}: {}", path.string(), error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("--continue: {}: {}", path.string(), error.what()));
  }
}

}  // namespace demvof
