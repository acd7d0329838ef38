// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/results.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "coupler/config/quantities.hpp"
#include "coupler/output/machine.hpp"

namespace fs = std::filesystem;

namespace demvof {
namespace {

using Json = nlohmann::json;

Json parsed(const RunResults& results) {
  return Json::parse(results_json(results));
}

TEST(Results, HasEveryKeyThatIsPromised) {
  const Json json = parsed({});
  for (const char* key : {"/status",
                          "/version",
                          "/configuration_hash",
                          "/configuration",
                          "/command",
                          "/machine/cpu",
                          "/machine/cores",
                          "/ranks/fluid",
                          "/ranks/particles",
                          "/wall_seconds/total",
                          "/wall_seconds/fluid",
                          "/wall_seconds/particles",
                          "/wall_seconds/exchange",
                          "/wall_seconds/waiting",
                          "/peak_memory_bytes/fluid",
                          "/peak_memory_bytes/particles",
                          "/steps/windows",
                          "/steps/fluid",
                          "/steps/particles",
                          "/cells/fine_min",
                          "/cells/fine_max",
                          "/cells/bulk",
                          "/cells/bulk_active_max",
                          "/particles/initial",
                          "/particles/inserted",
                          "/particles/left",
                          "/particles/lost",
                          "/particles/final",
                          "/exchanged/bytes",
                          "/exchanged/cells",
                          "/conservation/exchange",
                          "/conservation/momentum",
                          "/conservation/solid_volume",
                          "/conservation/liquid_volume",
                          "/closures",
                          "/scene",
                          "/quantities",
                          "/warnings"})
    EXPECT_TRUE(json.contains(Json::json_pointer(key))) << key;
  EXPECT_FALSE(json.contains("failure"));
  EXPECT_EQ(json["status"], "completed");
}

TEST(Results, SaysWhatTheRunSaid) {
  RunResults results;
  results.configuration = R"({"coupling": {"window": 2e-4}})";
  results.configuration_hash = "0123456789abcdef";
  results.ranks.fluid = 2;
  results.wall_seconds.exchange = 1.25;
  results.particles.lost = 3;
  results.cells.fine_max = 511104;
  results.exchanged.bytes = std::int64_t{5} << 40;
  results.closures = {{"gidaspow", 1000, 7}};
  results.scene = {{"surface tension", true, "the coefficient is 0.072 N/m"}};
  results.quantities = {{"liquid_front", 0.1875}};
  const Json json = parsed(results);
  EXPECT_EQ(json["configuration"]["coupling"]["window"], 2e-4);
  EXPECT_EQ(json["configuration_hash"], "0123456789abcdef");
  EXPECT_EQ(json["ranks"]["fluid"], 2);
  EXPECT_EQ(json["wall_seconds"]["exchange"], 1.25);
  EXPECT_EQ(json["particles"]["lost"], 3);
  EXPECT_EQ(json["cells"]["fine_max"], 511104);
  EXPECT_EQ(json["exchanged"]["bytes"], std::int64_t{5} << 40);
  EXPECT_EQ(
      json["scene"][0],
      (Json{{"decision", "surface tension"}, {"on", true}, {"reason", "the coefficient is 0.072 N/m"}}));
  EXPECT_EQ(json["quantities"]["liquid_front"], 0.1875);
}

TEST(Results, FailureNamesSideStageTimeAndMessage) {
  RunResults results;
  results.status = RunStatus::failed;
  results.failure = RunFailure{"particles", "DEM steps", 0.125, "a wall is missing; \xff try a smaller step"};
  const Json json = parsed(results);  // also with a byte that is no UTF-8
  EXPECT_EQ(json["status"], "failed");
  EXPECT_EQ(json["failure"]["side"], "particles");
  EXPECT_EQ(json["failure"]["stage"], "DEM steps");
  EXPECT_EQ(json["failure"]["time"], 0.125);
  EXPECT_EQ(json["failure"]["message"].get<std::string>().rfind("a wall is missing; ", 0), 0u);
  results.status = RunStatus::interrupted;
  EXPECT_EQ(parsed(results)["status"], "interrupted");
}

TEST(Results, NumbersThatAreNotFiniteStayReadable) {
  RunResults results;
  results.conservation.momentum = std::nan("");
  EXPECT_TRUE(parsed(results)["conservation"]["momentum"].is_null());
}

TEST(Results, HaveTheLengthsOfTheWindowsWhereTheyDiffer) {
  RunResults results;
  EXPECT_FALSE(parsed(results).contains("window"));
  results.window.emplace();
  for (const auto& [length, error] : {std::pair{2e-3, 0.5}, {5e-4, 1.5}, {1e-3, 1.0}})
    results.window->enter(length, error);
  const Json window = parsed(results)["window"];
  EXPECT_EQ(window["shortest"], 5e-4);
  EXPECT_EQ(window["longest"], 2e-3);
  EXPECT_EQ(window["largest_error"], 1.5);
  EXPECT_EQ(window["over"], 1);
}

TEST(Results, HaveTheMomentumOfEverythingWithParticles) {
  RunResults results;
  EXPECT_FALSE(parsed(results).contains("momentum"));
  results.momentum.emplace(Vec3{1, 0, 0});
  OutsideImpulses impulses;
  impulses.boundary_pressure = {0, 0, 2};
  results.momentum->close({1, 0.5, 2}, impulses, false);
  results.momentum->close({2, 0, 2}, {}, true);
  const Json momentum = parsed(results)["momentum"];
  EXPECT_NEAR(momentum["error"][1], 0.5 / std::sqrt(5.25), 1e-15);
  EXPECT_EQ(momentum["error"][0], 0);
  EXPECT_EQ(momentum["windows"], 2);
  EXPECT_EQ(momentum["windows_judged"], 1);
  EXPECT_EQ(momentum["impulses"]["boundary_pressure"][2], 2);
  EXPECT_EQ(momentum["impulses"].size(), OutsideImpulses::parts.size());
}

TEST(Results, HaveReplacementsOnlyWhereTheSceneHasThem) {
  RunResults results;
  results.configuration = "{}";
  EXPECT_FALSE(parsed(results).contains("replacement"));
  results.replacement = RunResults::Replacement{3, 2, 3e-8, 2e-8, 1e-16, {0, 0, -1e-5}, 1e-15};
  const auto replacement = parsed(results)["replacement"];
  EXPECT_EQ(replacement["became_liquid"], 3);
  EXPECT_EQ(replacement["took_place_back"], 2);
  EXPECT_EQ(replacement["liquid_in"], 3e-8);
  EXPECT_EQ(replacement["impulse"][2], -1e-5);
}

TEST(Results, RefusesAConfigurationThatIsNoJson) {
  RunResults results;
  results.configuration = "{window: ";
  EXPECT_THROW(results_json(results), std::invalid_argument);
}

TEST(Results, ReplacesTheFileWhole) {
  const fs::path folder = fs::path(testing::TempDir()) / ("demvof_results_" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  RunResults results;
  results.command = std::string(100000, 'x');
  write_results(folder / "results.json", results);
  results.command = "short";
  write_results(folder / "results.json", results);
  std::ifstream file(folder / "results.json");
  EXPECT_EQ(Json::parse(file)["command"], "short");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);  // no leftovers
  EXPECT_THROW(write_results(folder / "not_there" / "results.json", results), std::runtime_error);
}

TEST(Machine, FactsAreThoseOfThisMachine) {
  const MachineFacts facts = machine_facts();
  EXPECT_FALSE(facts.cpu.empty());
  EXPECT_GE(facts.cores, 1);
  const std::int64_t before = peak_memory_bytes();
  std::vector<char> block(64 << 20, 1);  // touched, so that it is resident
  EXPECT_GE(peak_memory_bytes(), before + (50 << 20)) << block[0];
}

TEST(Quantities, NamesAreUniqueAndFoundByName) {
  for (const Quantity& quantity : known_quantities)
    EXPECT_EQ(find_quantity(quantity.name), &quantity) << quantity.name;
  EXPECT_EQ(find_quantity("kinetic_enrgy"), nullptr);
}

}  // namespace
}  // namespace demvof
