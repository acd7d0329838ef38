// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/results.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "coupler/output/machine.hpp"
#include "coupler/output/write_file.hpp"

namespace demvof {

namespace {

using Json = nlohmann::ordered_json;

const char* name(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
  }
  throw std::invalid_argument("no such run status");
}

Json configuration(const std::string& text) {
  if (text.empty()) return Json::object();
  Json parsed = Json::parse(text, nullptr, false);
  if (parsed.is_discarded()) throw std::invalid_argument("the resolved configuration is no JSON text");
  return parsed;
}

Json scene(const std::vector<Decision>& decisions) {
  Json list = Json::array();
  for (const Decision& decision : decisions)
    list.push_back({{"decision", decision.decision}, {"on", decision.on}, {"reason", decision.reason}});
  return list;
}

Json array(const Vec3& v) {
  return {v.x, v.y, v.z};
}

Json momentum(const MomentumBooks& books) {
  Json impulses = Json::object();
  for (const auto& [part, member] : OutsideImpulses::parts) impulses[part] = array(books.impulses().*member);
  return {{"error", books.judged() > 0 ? array(books.worst()) : Json()},
          {"windows", books.windows()},
          {"windows_judged", books.judged()},
          {"impulses", impulses}};
}

}  // namespace

std::string results_json(const RunResults& r) {
  Json json;
  json["status"] = name(r.status);
  if (r.failure)
    json["failure"] = {{"side", r.failure->side},
                       {"stage", r.failure->stage},
                       {"time", r.failure->time},
                       {"message", r.failure->message}};
  json["version"] = version();
  json["configuration_hash"] = r.configuration_hash;
  json["configuration"] = configuration(r.configuration);
  json["command"] = r.command;
  if (r.continued_from) json["continued_from"] = *r.continued_from;
  const MachineFacts machine = machine_facts();
  json["machine"] = {{"cpu", machine.cpu}, {"cores", machine.cores}};
  json["ranks"] = {{"fluid", r.ranks.fluid}, {"particles", r.ranks.particles}};
  json["wall_seconds"] = {{"total", r.wall_seconds.total},
                          {"fluid", r.wall_seconds.fluid},
                          {"particles", r.wall_seconds.particles},
                          {"exchange", r.wall_seconds.exchange},
                          {"waiting", r.wall_seconds.waiting}};
  json["peak_memory_bytes"] = {{"fluid", r.peak_memory_bytes.fluid},
                               {"particles", r.peak_memory_bytes.particles}};
  json["steps"] = {{"windows", r.steps.windows}, {"fluid", r.steps.fluid}, {"particles", r.steps.particles}};
  if (r.window)
    json["window"] = {{"shortest", r.window->shortest},
                      {"longest", r.window->longest},
                      {"largest_error", r.window->largest_error},
                      {"over", r.window->over}};
  json["cells"] = {{"fine_min", r.cells.fine_min},
                   {"fine_max", r.cells.fine_max},
                   {"bulk", r.cells.bulk},
                   {"bulk_active_max", r.cells.bulk_active_max},
                   {"mesh_changes", r.cells.mesh_changes},
                   {"rank_changes", r.cells.rank_changes},
                   {"imbalance", r.cells.imbalance}};
  json["particles"] = {{"initial", r.particles.initial},
                       {"inserted", r.particles.inserted},
                       {"left", r.particles.left},
                       {"lost", r.particles.lost},
                       {"outside_fluid", r.particles.outside_fluid},
                       {"final", r.particles.final}};
  json["relaxation"] = {{"smallest", r.relaxation.smallest}, {"cells", r.relaxation.cells}};
  json["exchanged"] = {{"bytes", r.exchanged.bytes}, {"cells", r.exchanged.cells}};
  json["conservation"] = {
      {"exchange", r.conservation.exchange},
      {"momentum", r.momentum && r.momentum->judged() == 0 ? Json() : Json(r.conservation.momentum)},
      {"solid_volume", r.conservation.solid_volume},
      {"liquid_volume", r.conservation.liquid_volume}};
  if (r.momentum) json["momentum"] = momentum(*r.momentum);
  json["closures"] = Json::object();
  for (const auto& [closure, evaluations, outside] : r.closures)
    json["closures"][closure] = {{"evaluations", evaluations}, {"outside_range", outside}};
  if (r.replacement)
    json["replacement"] = {
        {"became_liquid", r.replacement->became_liquid}, {"took_place_back", r.replacement->took_place_back},
        {"liquid_in", r.replacement->liquid_in},         {"liquid_out", r.replacement->liquid_out},
        {"volume_error", r.replacement->volume_error},   {"impulse", array(r.replacement->impulse)},
        {"impulse_error", r.replacement->impulse_error}};
  json["scene"] = scene(r.scene);
  json["quantities"] = Json::object();
  for (const auto& [quantity, value] : r.quantities) json["quantities"][quantity] = value;
  json["warnings"] = r.warnings;
  // Log text from a solver may hold any byte; a results file that cannot be written helps nobody.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_results(const std::filesystem::path& path, const RunResults& results) {
  write_file_atomically(path, results_json(results));
}

}  // namespace demvof
