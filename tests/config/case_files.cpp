// SPDX-License-Identifier: GPL-3.0-or-later
// What a right case file becomes: parameters, resolved configuration, hash; and its generated documents.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "coupler/config/describe.hpp"
#include "coupler/config/keys.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(DEMVOF_TEST_FOLDER) / "bad";  // holds the files that a case names

/// A case file that goes when the test is over.
class CaseFile {
 public:
  explicit CaseFile(const std::string& text) {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("demvof_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    for (const char* part : {"fluid", "particles"})
      fs::copy(folder / part, folder_ / part,
               fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    std::ofstream(path()) << text;
  }
  ~CaseFile() { fs::remove_all(folder_); }
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;
  std::string path() const { return (folder_ / "case.yaml").string(); }

 private:
  fs::path folder_;
};

const std::string plain = R"(
fluid: {case: fluid}
coupling: {end_time: 0.5, window: 2.0e-4}
)";
const std::string full = R"(
fluid:
  case: fluid
  ranks: 3
  prepare: [blockMesh -dict system/fine, setFields]
particles: {script: particles/in.script, ranks: 2}
bulk_grid: {lower: [-0.1, 0, 0], upper: [0.2, 0.1, 3e-1], cells: [20, 10, 30]}
coupling:
  end_time: 0.5
  window: 2.0e-4
  schedule: staggered
  exchange: semi_implicit
  sharing: volume
  phase_interchange: none
  interchange_speed: 0.3
  time_out: 12
  averaging: {kernel: centre, width: 2.7e-3, maximum_solid_fraction: 0.6}
  mapping: {to_fine: nearest, to_bulk: nearest}
forces: [{drag: none}]
scene: {surface_tension: off, interface: on, porosity: off, dilute_limit: 1e-3}
output: {interval: 0.02, history_interval: 0.01, history: [liquid_front], pictures: [0, 0.5]}
)";

std::string read_text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(CaseFiles, LeaveDefaultsWhereTheySayNothing) {
  const CaseFile file(plain);
  const CaseParameters c = read_case(file.path());
  EXPECT_EQ(c.file, file.path());
  EXPECT_EQ(c.fluid.case_folder, "fluid");
  EXPECT_EQ(c.fluid.prepare, (std::vector<std::string>{"blockMesh", "setFields"}));
  EXPECT_FALSE(c.particles);
  EXPECT_FALSE(c.bulk_grid);
  EXPECT_EQ(c.coupling.end_time, 0.5);
  EXPECT_EQ(c.coupling.window, 2e-4);
  EXPECT_EQ(c.coupling.exchange, ExchangeScheme::conservative_implicit);
  EXPECT_EQ(c.forces.drag, DragLaw::schiller_naumann);
  EXPECT_TRUE(c.forces.pressure_gradient);
  EXPECT_EQ(c.scene.porosity, Switch::automatic);
}

TEST(CaseFiles, FillEveryParameter) {
  const CaseFile file(full);
  const CaseParameters c = read_case(file.path());
  EXPECT_EQ(c.fluid.ranks, 3);
  EXPECT_EQ(c.fluid.prepare, (std::vector<std::string>{"blockMesh -dict system/fine", "setFields"}));
  ASSERT_TRUE(c.particles && c.bulk_grid);
  EXPECT_EQ(c.particles->script, "particles/in.script");
  EXPECT_EQ(c.particles->ranks, 2);
  EXPECT_EQ(c.bulk_grid->lower.x, -0.1);
  EXPECT_EQ(c.bulk_grid->upper.z, 0.3);
  EXPECT_EQ(c.bulk_grid->cells, (std::array<int, 3>{20, 10, 30}));
  EXPECT_EQ(c.coupling.exchange, ExchangeScheme::semi_implicit);
  EXPECT_EQ(c.coupling.sharing, Sharing::volume);
  EXPECT_EQ(c.coupling.phase_interchange, PhaseInterchange::none);
  EXPECT_EQ(c.coupling.interchange_speed, 0.3);
  EXPECT_EQ(c.coupling.time_out, 12);
  EXPECT_EQ(c.coupling.averaging.kernel, Kernel::centre);
  EXPECT_EQ(c.coupling.averaging.width, 2.7e-3);
  EXPECT_EQ(c.coupling.averaging.maximum_solid_fraction, 0.6);
  EXPECT_EQ(c.coupling.mapping.to_fine, Mapping::nearest);
  EXPECT_EQ(c.coupling.mapping.to_bulk, Mapping::nearest);
  EXPECT_EQ(c.forces.drag, DragLaw::none);
  EXPECT_FALSE(c.forces.pressure_gradient) << "a given list is the whole list";
  EXPECT_EQ(c.scene.surface_tension, Switch::off);
  EXPECT_EQ(c.scene.interface_advection, Switch::on);
  EXPECT_EQ(c.scene.porosity, Switch::off);
  EXPECT_EQ(c.scene.dilute_limit, 1e-3);
  EXPECT_EQ(c.output.interval, 0.02);
  EXPECT_EQ(c.output.history_interval, 0.01);
  EXPECT_EQ(c.output.history, std::vector<std::string>{"liquid_front"});
  EXPECT_EQ(c.output.pictures, (std::vector<double>{0, 0.5}));
}

TEST(CaseFiles, NameForcesInAList) {
  const CaseFile file(full);
  const auto forces = [&](const std::string& list) {
    return read_case(file.path(), {"forces=" + list}).forces;
  };
  const ForceParameters all = forces(
      "[{drag: rong}, viscous_stress, {added_mass: 0.5}, {lift: saffman_mei}, capillary, torque, history, "
      "{spin_lift: oesterle_bui_dinh}, {suspension_viscosity: eilers}, "
      "{constant: [0, 1e-6, -2]}]");
  EXPECT_EQ(all.drag, DragLaw::rong);
  EXPECT_FALSE(all.pressure_gradient);
  EXPECT_TRUE(all.viscous_stress && all.capillary && need_gradients(all));
  EXPECT_EQ(all.added_mass, 0.5);
  EXPECT_EQ(all.lift, LiftLaw::saffman_mei);
  EXPECT_EQ(all.spin_lift, SpinLiftLaw::oesterle_bui_dinh);
  EXPECT_TRUE(all.torque && all.history);
  EXPECT_EQ(all.suspension_viscosity, SuspensionViscosity::eilers);
  EXPECT_EQ(all.constant.y, 1e-6);
  EXPECT_EQ(all.constant.z, -2);
  const ForceParameters few = forces("[pressure_gradient, {constant: [1, 0, 0]}]");
  EXPECT_FALSE(few.viscous_stress || few.capillary || need_gradients(few));
  EXPECT_EQ(few.drag, DragLaw::none);
  EXPECT_EQ(few.constant.x, 1);
  EXPECT_TRUE(need_gradients(forces("[{added_mass: 0.1}]")) && need_gradients(forces("[viscous_stress]")) &&
              need_gradients(forces("[capillary]")) && need_gradients(forces("[{lift: saffman_mei}]")) &&
              need_gradients(forces("[torque]")) && need_gradients(forces("[history]")) &&
              need_gradients(forces("[{spin_lift: rubinow_keller}]")));
}

TEST(CaseFiles, NameLubricationByTheWordOrWithItsKeys) {
  const CaseFile file(full);
  const auto films = [&](const std::vector<std::string>& overrides) {
    return read_case(file.path(), overrides).forces.lubrication;
  };
  EXPECT_FALSE(films({"forces=[pressure_gradient]"}));
  const auto defaults = films({"forces=[pressure_gradient, lubrication]"});
  ASSERT_TRUE(defaults);
  EXPECT_EQ(defaults->cut_off, 0.1);
  EXPECT_EQ(defaults->roughness, 1e-3);
  EXPECT_TRUE(defaults->suction);
  const auto given = films({"forces=[{lubrication: {cut_off: 0.2, suction: false}}]"});
  ASSERT_TRUE(given);
  EXPECT_EQ(given->cut_off, 0.2);
  EXPECT_EQ(given->roughness, 1e-3);
  EXPECT_FALSE(given->suction);
  EXPECT_EQ(films({"forces=[lubrication]", "forces.lubrication.roughness=1e-5"})->roughness, 1e-5);
  // The resolved configuration is a case file of the same case.
  const std::string resolved = resolved_configuration(
      read_case(file.path(), {"forces=[{drag: rong}, {lubrication: {cut_off: 0.2}}]"}));
  std::ofstream(file.path()) << resolved;
  EXPECT_EQ(resolved_configuration(read_case(file.path())), resolved);
  EXPECT_EQ(read_case(file.path()).forces.lubrication->cut_off, 0.2);
}

TEST(CaseFiles, AcceptAnEndTimeOfWholeWindowsInDecimals) {
  // 0.3 / 1e-4 is 2999.9999999999995 in binary: round-off of decimal input is no mistake.
  const CaseFile file(plain);
  EXPECT_EQ(read_case(file.path(), {"coupling.end_time=0.3", "coupling.window=1e-4"}).coupling.end_time, 0.3);
  EXPECT_THROW(read_case(file.path(), {"coupling.end_time=0.3", "coupling.window=1.0001e-4"}), InputError);
}

TEST(CaseFiles, AreOverriddenKeyByKeyAndTheLastOneCounts) {
  const CaseFile file(full);
  const CaseParameters c = read_case(
      file.path(), {"coupling.window=1e-3", "coupling.window=1e-4", "coupling.averaging={kernel: linear}",
                    "forces=[pressure_gradient]", "bulk_grid.cells=[1, 2, 3]"});
  EXPECT_EQ(c.coupling.window, 1e-4);
  EXPECT_EQ(c.coupling.averaging.kernel, Kernel::linear);
  EXPECT_EQ(c.coupling.averaging.width, 2.7e-3) << "not overridden";
  EXPECT_EQ(c.forces.drag, DragLaw::none);
  EXPECT_TRUE(c.forces.pressure_gradient);
  EXPECT_EQ(c.bulk_grid->cells, (std::array<int, 3>{1, 2, 3}));
}

TEST(CaseFiles, GiveWindowsANumberOrAMapAndTheLastOneCounts) {
  const CaseFile file(plain);
  const std::string map = "coupling.window={tolerance: 1e-3, shortest: 1e-4, longest: 2e-3}";
  const CouplingParameters own = read_case(file.path(), {map, "coupling.window.longest=4e-3"}).coupling;
  ASSERT_TRUE(own.adaptive_window);
  EXPECT_EQ(own.window, 0);
  EXPECT_EQ(own.adaptive_window->tolerance, 1e-3);
  EXPECT_EQ(own.adaptive_window->shortest, 1e-4);
  EXPECT_EQ(own.longest_window(), 4e-3);
  const CouplingParameters fixed = read_case(file.path(), {map, "coupling.window=1e-4"}).coupling;
  EXPECT_FALSE(fixed.adaptive_window);
  EXPECT_EQ(fixed.longest_window(), 1e-4);
  EXPECT_THROW(read_case(file.path(), {"coupling.window.longest=4e-3"}), InputError)
      << "the others are missing";

  const CaseParameters c = read_case(file.path(), {map});
  const std::string resolved = resolved_configuration(c);
  std::ofstream(file.path()) << resolved;
  EXPECT_EQ(resolved_configuration(read_case(file.path())), resolved);
}

TEST(CaseFiles, AnOverrideReplacesAMistake) {
  const CaseFile file(plain + "output: {interval: never}\n");
  EXPECT_THROW(read_case(file.path()), InputError);
  EXPECT_EQ(read_case(file.path(), {"output.interval=0.1"}).output.interval, 0.1);
}

TEST(CaseFiles, RunWithoutTheirParticlesWhenTheseAreOff) {
  const CaseFile file(full);
  EXPECT_FALSE(read_case(file.path(), {"scene.particles=off"}).particles);
}

TEST(CaseFiles, OfTheShippedCasesAreInOrder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(DEMVOF_DOCS).parent_path() / "cases")) {
    const fs::path file = entry.path() / "case.yaml";
    if (!fs::exists(file)) continue;
    EXPECT_NO_THROW(read_case(file.string())) << file;
    ++count;
  }
  EXPECT_GE(count, 2);
}

TEST(ResolvedConfiguration, IsACaseFileWithTheSameContent) {
  for (const std::string& text : {plain, full}) {
    const CaseFile file(text);
    const CaseParameters c = read_case(file.path());
    const std::string resolved = resolved_configuration(c);
    std::ofstream(file.path()) << resolved;
    const CaseParameters again = read_case(file.path());
    EXPECT_EQ(resolved_configuration(again), resolved);
    EXPECT_EQ(configuration_hash(again), configuration_hash(c));
  }
}

TEST(ResolvedConfiguration, HoldsEveryKey) {
  const CaseFile file(full);
  const auto json = nlohmann::json::parse(resolved_configuration(read_case(file.path())));
  EXPECT_EQ(json["coupling"]["averaging"]["maximum_solid_fraction"], 0.6);
  EXPECT_EQ(json["forces"], nlohmann::json::array());
  EXPECT_EQ(json["scene"]["particles"], "auto") << "a default";
  EXPECT_EQ(json["fluid"]["case"], "fluid") << "as given";
}

TEST(ConfigurationHash, ChangesWithEveryKeyButTheRanks) {
  const CaseFile file(full);
  const std::string hash = configuration_hash(read_case(file.path()));
  EXPECT_EQ(hash.size(), 16u);
  const auto changed = [&](const std::string& assignment) {
    return configuration_hash(read_case(file.path(), {assignment})) != hash;
  };
  for (const char* assignment : {"fluid.prepare=[]",
                                 "bulk_grid.lower=[0, 0, 0]",
                                 "bulk_grid.upper=[1, 1, 1]",
                                 "bulk_grid.cells=[20, 10, 31]",
                                 "coupling.end_time=0.4",
                                 "coupling.window=1e-4",
                                 "coupling.exchange=explicit",
                                 "coupling.sharing=mass",
                                 "coupling.phase_interchange=porous",
                                 "coupling.averaging.kernel=linear",
                                 "coupling.averaging.width=0",
                                 "coupling.averaging.maximum_solid_fraction=0.61",
                                 "coupling.mapping.to_fine=conservative",
                                 "coupling.mapping.to_bulk=conservative",
                                 "forces=[{drag: schiller_naumann}]",
                                 "forces=[{drag: none}, pressure_gradient]",
                                 "scene.particles=off",
                                 "scene.surface_tension=auto",
                                 "scene.interface=off",
                                 "scene.porosity=auto",
                                 "scene.dilute_limit=0",
                                 "output.interval=0.01",
                                 "output.history=[]",
                                 "output.pictures=[]"})
    EXPECT_TRUE(changed(assignment)) << assignment;
  for (const char* assignment : {"fluid.ranks=1", "particles.ranks=1", "coupling.time_out=600", "forces=[]"})
    EXPECT_FALSE(changed(assignment)) << assignment;
}

TEST(CaseFiles, TakeATableAsItIsOrFromAFileBesideThem) {
  const CaseFile file(plain + "gravity: {table: [[0, 0, 0, -9.81], [0.5, 2, -1e-3, -9.81]]}\n");
  const CaseParameters inside = read_case(file.path());
  const fs::path rows = fs::path(file.path()).parent_path() / "shake.csv";
  std::ofstream(rows) << "# t, gx, gy, gz\r\n0,0,0,-9.81\r\n\n0.5\t2 -1e-3, -9.81  # later\n";
  const CaseParameters outside = read_case(file.path(), {"gravity.table=shake.csv"});
  for (const CaseParameters* c : {&inside, &outside}) {
    ASSERT_TRUE(c->gravity);
    ASSERT_EQ(c->gravity->rows.size(), 2u);
    EXPECT_EQ(c->gravity->rows[1].time, 0.5);
    EXPECT_EQ(c->gravity->rows[1].gravity.y, -1e-3);
  }
  EXPECT_EQ(resolved_configuration(inside), resolved_configuration(outside));
  std::ofstream(rows) << "0 0 0 -9.81\n0.5 2 -1e-3 -9.8100001\n";
  EXPECT_NE(configuration_hash(inside),
            configuration_hash(read_case(file.path(), {"gravity.table=shake.csv"})));
}

TEST(CaseKeys, EachBelongsToASectionAndSaysWhatItIs) {
  for (const Key& key : case_keys()) {
    EXPECT_NE(find_section(parent_of(key.path)), nullptr) << key.path;
    EXPECT_EQ(key.doc.back(), '.') << key.path;
    const bool numbers = key.rule.form == ValueRule::Form::number || key.rule.form == ValueRule::Form::table;
    EXPECT_EQ(key.rule.unit.empty(), !numbers) << key.path;
  }
}

TEST(CaseKeys, EveryDefaultIsAnAllowedValue) {
  const CaseParameters defaults = default_parameters();
  for (const Key& key : case_keys()) {
    if (key.required) continue;
    const std::string text = key.get(defaults).dump();
    // Text in JSON is quoted; a choice or a text reads the same, and a number is not quoted.
    Json value;
    EXPECT_FALSE(read_value(YAML::Load(text), key.rule, value)) << key.path << " = " << text;
    EXPECT_EQ(value, key.get(defaults)) << key.path;
  }
}

TEST(Documents, AreUpToDate) {
  const std::string hint =
      "run: demvof reference > docs/case_file.md; demvof schema > docs/case_file.schema.json";
  EXPECT_TRUE(read_text(fs::path(DEMVOF_DOCS) / "case_file.md") == case_file_reference()) << hint;
  EXPECT_TRUE(read_text(fs::path(DEMVOF_DOCS) / "case_file.schema.json") == case_file_schema()) << hint;
}

}  // namespace
}  // namespace demvof
