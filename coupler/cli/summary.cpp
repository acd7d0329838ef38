// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "coupler/cli/progress_display.hpp"

namespace demvof {
namespace {

using Json = nlohmann::ordered_json;

/// A number of results.json; 0 where it says null or nothing.
double number(const Json& json, const std::string& path) {
  const Json::json_pointer pointer(path);
  return json.contains(pointer) && json[pointer].is_number() ? json[pointer].get<double>() : 0;
}
/// Of the books; null where no window was judged.
std::string error(const Json& r, const std::string& book) {
  const std::string path = "/conservation/" + book;
  const Json::json_pointer pointer(path);
  return r.contains(pointer) && r[pointer].is_null() ? "not judged" : fmt::format("{:.1e}", number(r, path));
}
/// Of fluid, particles and what is between them, the worst component.
std::string momentum_of_everything(const Json& r) {
  const Json errors = r.value("momentum", Json::object()).value("error", Json::array());
  double worst = -1;
  for (const Json& component : errors)
    if (component.is_number()) worst = std::max(worst, component.get<double>());
  return worst < 0 ? "not judged" : fmt::format("{:.1e}", worst);
}
long whole(const Json& json, const std::string& path) {
  return static_cast<long>(number(json, path));
}

std::string wall_times(const Json& r) {
  const double total = number(r, "/wall_seconds/total");
  std::string text = clock_text(total);
  for (const char* part : {"fluid", "particles", "exchange"}) {
    const double seconds = number(r, std::string("/wall_seconds/") + part);
    text += fmt::format(", {} {:.1f} s", part, seconds);
    if (total > 0) text += fmt::format(" ({:.0f} %)", 100 * seconds / total);
  }
  return text + fmt::format(", both sides waited {:.1f} s", number(r, "/wall_seconds/waiting"));
}

}  // namespace

Json read_results(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "results.json");
  const Json json = Json::parse(stream, nullptr, false);
  return json.is_object() ? json : Json();
}

std::string run_summary(const Json& r) {
  std::string text;
  const auto row = [&text](const std::string& label, const std::string& value) {
    text += fmt::format("{:<22} {}\n", label, value);
  };
  const std::string status = r.value("status", "unknown");
  row("status", status);
  if (r.contains("continued_from"))
    row("continued from",
        fmt::format("t = {:.6g} s; what follows is of the part since then", number(r, "/continued_from")));
  if (status != "completed" && whole(r, "/steps/windows") == 0) return text;  // nothing else to tell

  row("wall time", wall_times(r));
  row("steps", fmt::format("{} windows, {} fluid, {} DEM", whole(r, "/steps/windows"),
                           whole(r, "/steps/fluid"), whole(r, "/steps/particles")));
  row("cells",
      fmt::format("{} fine at most, {} bulk, of these {} exchanged at most", whole(r, "/cells/fine_max"),
                  whole(r, "/cells/bulk"), whole(r, "/cells/bulk_active_max")));
  const bool particles = whole(r, "/particles/initial") + whole(r, "/particles/inserted") > 0;
  if (particles)
    row("particles", fmt::format("{} at the start, {} inserted, {} left, {} lost",
                                 whole(r, "/particles/initial"), whole(r, "/particles/inserted"),
                                 whole(r, "/particles/left"), whole(r, "/particles/lost")));
  row("worst relative errors",
      particles
          ? fmt::format(
                "liquid volume {}, solid volume {}, exchange {}, momentum of particles {}, of everything {}",
                error(r, "liquid_volume"), error(r, "solid_volume"), error(r, "exchange"),
                error(r, "momentum"), momentum_of_everything(r))
          : fmt::format("liquid volume {}", error(r, "liquid_volume")));
  for (const std::string front : {"liquid", "solid"})
    if (const std::string path = "/quantities/" + front + "_front"; r.contains(Json::json_pointer(path)))
      row(front + " front", fmt::format("{:.4g} m", number(r, path)));
  if (r.contains("warnings"))
    for (const Json& warning : r["warnings"])
      if (warning.is_string()) row("warning", warning.get<std::string>());
  return text;
}

std::string failure_text(const Json& results) {
  if (!results.is_object() || !results.contains("failure") || !results["failure"].is_object()) return "";
  const Json& failure = results["failure"];
  return fmt::format("{} side, {}, t = {:.6g} s: {}", failure.value("side", "?"), failure.value("stage", "?"),
                     number(failure, "/time"), failure.value("message", ""));
}

std::string output_list(const std::filesystem::path& folder) {
  static const std::pair<const char*, const char*> outputs[] = {
      {"results.json", "everything about the run in one file"},
      {"history.csv", "recorded quantities against time"},
      {"fluid", "OpenFOAM time folders"},
      {"particles/particles.pvd", "particles, for ParaView"},
      {"surfaces/surfaces.pvd", "the script's surfaces, for ParaView"},
      {"bulk/bulk.pvd", "bulk grid, for ParaView"},
      {"fluid.log", "what OpenFOAM said"},
      {"particles.log", "what LIGGGHTS said"},
      {"report.html", "pictures and tables"}};
  std::string text = fmt::format("In {}:\n", folder.string());
  for (const auto& [name, meaning] : outputs)
    if (std::filesystem::exists(folder / name)) text += fmt::format("  {:<24} {}\n", name, meaning);
  return text;
}

}  // namespace demvof
