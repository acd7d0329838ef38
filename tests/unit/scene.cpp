// SPDX-License-Identifier: GPL-3.0-or-later
// Every decision of the scene plan: found from the facts, forced either way, and forced in vain.
#include "coupler/scene/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "coupler/base/errors.hpp"
#include "coupler/scene/resolved_numbers.hpp"

namespace demvof {
namespace {

/// Water, air and beads; not turbulent.
SceneFacts three_phases() {
  SceneFacts facts;
  facts.surface_tension = 0.07;
  facts.particles = true;
  facts.particle_count = 3883;
  facts.largest_solid_fraction = 0.3;
  return facts;
}

Decision decision(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.decisions.begin(), scene.decisions.end(),
                                  [&](const Decision& d) { return d.decision == name; });
  return found == scene.decisions.end() ? Decision{"no decision " + name, false, ""} : *found;
}

/// What plan_scene refuses with, or "nothing".
std::string refusal(const SceneParameters& forced, const SceneFacts& facts) {
  try {
    plan_scene(forced, facts);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(ScenePlan, HasEverythingThatThreePhasesNeed) {
  const Scene scene = plan_scene({}, three_phases());
  EXPECT_TRUE(scene.particles && scene.surface_tension && scene.interface_advection && scene.porosity);
  EXPECT_FALSE(scene.turbulence);
  EXPECT_EQ(decision(scene, "particles").reason, "The script gives 3883 particles at the start.");
  EXPECT_EQ(decision(scene, "surface tension").reason, "The fluid case's coefficient is 0.07 N/m.");
}

TEST(ScenePlan, GivesEveryDecisionOnceWithOneSentence) {
  for (const bool particles : {false, true}) {
    SceneFacts facts = three_phases();
    facts.particles = particles;
    std::vector<std::string> names;
    for (const Decision& d : plan_scene({}, facts).decisions) {
      EXPECT_EQ(std::count(names.begin(), names.end(), d.decision), 0) << d.decision;
      EXPECT_EQ(d.reason.back(), '.') << d.reason;
      names.push_back(d.decision);
    }
    EXPECT_EQ(names.size(), 21u);
  }
}

TEST(ScenePlan, IsPlainVofWithoutParticles) {
  SceneFacts facts = three_phases();
  facts.particles = false;
  const Scene scene = plan_scene({}, facts);
  EXPECT_FALSE(scene.particles || scene.porosity);
  EXPECT_TRUE(scene.interface_advection && scene.surface_tension);
  for (const char* name : {"porosity", "drag (schiller_naumann)", "pressure-gradient force"})
    EXPECT_EQ(decision(scene, name).reason, "There are no particles.") << name;
}

TEST(ScenePlan, HasAPhaseInterchangeWhereThereIsAnInterface) {
  const auto interchange = [](const SceneFacts& facts, PhaseInterchange chosen) {
    return plan_scene({}, facts, {}, chosen).interchange;
  };
  SceneFacts one_fluid = three_phases();
  one_fluid.two_fluids = false;
  SceneFacts no_particles = three_phases();
  no_particles.particles = false;
  for (const PhaseInterchange chosen : {PhaseInterchange::porous, PhaseInterchange::volume_adding,
                                        PhaseInterchange::replacement, PhaseInterchange::none}) {
    EXPECT_EQ(interchange(three_phases(), chosen), chosen);
    EXPECT_EQ(interchange(one_fluid, chosen), PhaseInterchange::none);
    EXPECT_EQ(interchange(no_particles, chosen), PhaseInterchange::none);
  }
  EXPECT_TRUE(plan_scene({}, three_phases(), {}, PhaseInterchange::replacement).porosity);
}

TEST(ScenePlan, FillsTheParticlesWithLiquidOrLeavesThemPorous) {
  EXPECT_FALSE(plan_scene({}, three_phases(), {}, PhaseInterchange::volume_adding).porosity);
  SceneParameters forced;
  forced.porosity = Switch::on;
  EXPECT_THROW(plan_scene(forced, three_phases(), {}, PhaseInterchange::volume_adding), InputError);
}

TEST(ScenePlan, LeavesParticlesOutOnDemand) {
  SceneParameters forced;
  forced.particles = Switch::off;
  const Scene scene = plan_scene(forced, three_phases());
  EXPECT_FALSE(scene.particles || scene.porosity);
  EXPECT_EQ(decision(scene, "particles").reason, "The case file says scene.particles: off.");
}

TEST(ScenePlan, RefusesParticlesThatAreNotThere) {
  SceneFacts facts = three_phases();
  facts.particles = false;
  SceneParameters forced;
  forced.particles = Switch::on;
  EXPECT_EQ(refusal(forced, facts), "scene.particles: on is impossible: the case has no particle script");
}

TEST(ScenePlan, ComputesNoCurvatureWithoutSurfaceTension) {
  SceneFacts facts = three_phases();
  facts.surface_tension = 0;
  const Scene scene = plan_scene({}, facts);
  EXPECT_FALSE(scene.surface_tension);
  EXPECT_EQ(decision(scene, "surface tension").reason,
            "The fluid case's coefficient is 0: no curvature is computed.");
}

TEST(ScenePlan, ForcesSurfaceTensionOffButNotOnWithoutACoefficient) {
  SceneParameters forced;
  forced.surface_tension = Switch::off;
  EXPECT_FALSE(plan_scene(forced, three_phases()).surface_tension);
  forced.surface_tension = Switch::on;
  EXPECT_TRUE(plan_scene(forced, three_phases()).surface_tension);
  SceneFacts facts = three_phases();
  facts.surface_tension = 0;
  EXPECT_EQ(refusal(forced, facts),
            "scene.surface_tension: on is impossible: the fluid case's coefficient is 0");
}

TEST(ScenePlan, TransportsNoInterfaceInOneFluid) {
  SceneFacts facts = three_phases();
  facts.two_fluids = false;
  const Scene scene = plan_scene({}, facts);
  EXPECT_FALSE(scene.interface_advection || scene.surface_tension);
  EXPECT_EQ(decision(scene, "interface transport").reason, "One fluid fills the domain and all inlets.");
  EXPECT_TRUE(scene.porosity) << "particles in one fluid still displace it";
}

TEST(ScenePlan, ForcesInterfaceTransportEitherWay) {
  SceneFacts facts = three_phases();
  SceneParameters forced;
  forced.interface_advection = Switch::off;
  EXPECT_FALSE(plan_scene(forced, facts).interface_advection);
  forced.interface_advection = Switch::on;
  facts.two_fluids = false;
  const Scene scene = plan_scene(forced, facts);
  EXPECT_TRUE(scene.interface_advection);
  EXPECT_EQ(decision(scene, "interface transport").reason, "The case file says scene.interface: on.");
}

TEST(ScenePlan, LeavesPorosityOutOnlyBelowAStatedLimit) {
  SceneFacts facts = three_phases();
  facts.largest_solid_fraction = 1e-4;
  SceneParameters forced;
  EXPECT_TRUE(plan_scene(forced, facts).porosity) << "no limit is stated";
  forced.dilute_limit = 1e-3;
  const Scene dilute = plan_scene(forced, facts);
  EXPECT_FALSE(dilute.porosity);
  EXPECT_EQ(decision(dilute, "porosity").reason,
            "The largest solid fraction, 0.0001, is below scene.dilute_limit, 0.001.");
  facts.largest_solid_fraction = 1e-3;
  EXPECT_TRUE(plan_scene(forced, facts).porosity) << "at the limit is not below it";
}

TEST(ScenePlan, KeepsPorosityWhenParticlesAreStillToCome) {
  SceneFacts facts = three_phases();
  facts.largest_solid_fraction = 0;
  facts.inserts_particles = true;
  SceneParameters forced;
  forced.dilute_limit = 1e-3;
  EXPECT_TRUE(plan_scene(forced, facts).porosity);
}

TEST(ScenePlan, ForcesPorosityOffButNotOnWithoutParticles) {
  SceneParameters forced;
  forced.porosity = Switch::off;
  EXPECT_FALSE(plan_scene(forced, three_phases()).porosity);
  forced.porosity = Switch::on;
  SceneFacts facts = three_phases();
  forced.dilute_limit = 1;
  EXPECT_TRUE(plan_scene(forced, facts).porosity) << "forced beats the limit";
  facts.particles = false;
  EXPECT_EQ(refusal(forced, facts), "scene.porosity: on is impossible: there are no particles");
}

TEST(ScenePlan, TellsEverythingThatIsForcedInVain) {
  SceneFacts nothing;
  SceneParameters forced;
  forced.particles = forced.surface_tension = forced.porosity = Switch::on;
  const std::string text = refusal(forced, nothing);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

TEST(ScenePlan, SaysWhichForcesAct) {
  ForceParameters forces;
  forces.drag = DragLaw::none;
  const Scene scene = plan_scene({}, three_phases(), forces);
  EXPECT_FALSE(decision(scene, "drag").on);
  EXPECT_EQ(decision(scene, "drag").reason, "It is not named in forces.");
  EXPECT_TRUE(decision(scene, "pressure-gradient force").on);
  for (const char* name : {"viscous stress on particles", "added mass", "lift", "lift by spin",
                           "viscosity of the suspension", "torque on particles", "history force",
                           "lubrication", "capillary force on particles", "constant force on particles"})
    EXPECT_EQ(decision(scene, name).reason, "It is not named in forces.") << name;
}

TEST(ScenePlan, SaysBetweenWhichGapsFilmsAct) {
  ForceParameters forces;
  forces.lubrication = LubricationParameters{0.2, 1e-4, false};
  EXPECT_TRUE(decision(plan_scene({}, three_phases(), forces),
                       "lubrication, gaps of 0.0001 to 0.2 radii, without suction")
                  .on);
}

TEST(ScenePlan, GivesTheSuspensionItsViscosity) {
  ForceParameters forces;
  forces.suspension_viscosity = SuspensionViscosity::eilers;
  const Scene scene = plan_scene({}, three_phases(), forces);
  EXPECT_EQ(scene.suspension_viscosity, SuspensionViscosity::eilers);
  EXPECT_TRUE(decision(scene, "viscosity of the suspension (eilers)").on);
  SceneParameters no_porosity;
  no_porosity.porosity = Switch::off;
  const Scene without = plan_scene(no_porosity, three_phases(), forces);
  EXPECT_EQ(without.suspension_viscosity, SuspensionViscosity::none);
  EXPECT_EQ(decision(without, "viscosity of the suspension (eilers)").reason,
            "It is named in forces, but the run has no porosity.");
  forces.viscous_stress = true;  // would count the particles' share twice
  EXPECT_THROW(plan_scene({}, three_phases(), forces), InputError);
}

TEST(ScenePlan, AdvisesOnALawThatDoesNotKnowTheBed) {
  ForceParameters forces;
  SceneFacts facts = three_phases();
  facts.largest_solid_fraction = 0.59;
  const std::vector<std::string> advice = plan_scene({}, facts, forces).advice;
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_NE(advice[0].find("schiller_naumann"), std::string::npos);
  EXPECT_NE(advice[0].find("e.g. forces: [{drag: di_felice}, pressure_gradient]"), std::string::npos)
      << advice[0];
  forces.drag = DragLaw::di_felice;
  EXPECT_TRUE(plan_scene({}, facts, forces).advice.empty());
  facts.largest_solid_fraction = 0.62;  // a little out of di_felice's range
  EXPECT_TRUE(plan_scene({}, facts, forces).advice.empty());
  forces.drag = DragLaw::schiller_naumann;
  EXPECT_NE(plan_scene({}, facts, forces).advice.at(0).find("{drag: rong}"), std::string::npos);
  facts.largest_solid_fraction = 0.05;  // a dilute one
  EXPECT_TRUE(plan_scene({}, facts, forces).advice.empty());
  forces.drag = DragLaw::none;
  facts.largest_solid_fraction = 0.6;
  EXPECT_TRUE(plan_scene({}, facts, forces).advice.empty());
}

TEST(ScenePlan, NamesTheForcesThatAct) {
  ForceParameters forces;
  forces.drag = DragLaw::rong;
  forces.viscous_stress = forces.capillary = true;
  forces.added_mass = 0.5;
  forces.lift = LiftLaw::saffman_mei;
  forces.spin_lift = SpinLiftLaw::rubinow_keller;
  forces.torque = true;
  forces.constant = {0, 1e-6, 0};
  SceneFacts facts = three_phases();
  const Scene scene = plan_scene({}, facts, forces);
  for (const char* name : {"drag (rong)", "viscous stress on particles", "added mass (0.5)",
                           "lift (saffman_mei)", "lift by spin (rubinow_keller)", "torque on particles",
                           "capillary force on particles", "constant force on particles"})
    EXPECT_TRUE(decision(scene, name).on) << name;
  facts.surface_tension = 0;
  EXPECT_EQ(decision(plan_scene({}, facts, forces), "capillary force on particles").reason,
            "It is named in forces, but the run has no surface tension.");
}

TEST(ScenePlan, NeverExchangesEmptyBulkCells) {
  const std::string name = "exchange of bulk cells without particles near them";
  const Scene scene = plan_scene({}, three_phases());
  EXPECT_FALSE(decision(scene, name).on);
  EXPECT_EQ(decision(scene, name).reason, "They are always left out: not averaged, not exchanged.");
}

TEST(ScenePlan, FollowsTheFluidCaseInTurbulence) {
  SceneFacts facts = three_phases();
  facts.particles = false;
  EXPECT_FALSE(decision(plan_scene({}, facts), "turbulence model").on);
  facts.turbulent = true;
  EXPECT_TRUE(plan_scene({}, facts).turbulence);
  EXPECT_TRUE(decision(plan_scene({}, facts), "turbulence model").on);
  EXPECT_EQ(decision(plan_scene({}, facts), "turbulence model").reason, "The fluid case names one.");
  facts.particles = true;
  EXPECT_EQ(decision(plan_scene({}, facts), "turbulence model").reason,
            "The fluid case names one; beware: it knows neither particles nor porosity.");
}

TEST(SceneTable, IsALinePerDecision) {
  EXPECT_EQ(scene_table({{"drag", true, "Yes."}, {"turbulence", false, "No."}}),
            "on   drag        Yes.\noff  turbulence  No.\n");
}

TEST(NumbersTable, ShowsStepsPerWindowCellsAndParticles) {
  ResolvedNumbers numbers;
  numbers.window = 2e-4;
  numbers.windows = 2500;
  numbers.dem_time_step = 2e-6;
  numbers.dem_steps = 100;
  numbers.fluid_time_step = 1e-4;
  numbers.fluid_steps = 2;
  numbers.courant_step = 2e-4;
  numbers.capillary_step = 1e-3;
  numbers.collision_time = 4e-5;
  numbers.drag_time = 0.5;
  numbers.fine_cells = 48000;
  numbers.bulk_cells = 6000;
  numbers.bulk_spacing = 0.01;
  numbers.particles = 3883;
  numbers.min_diameter = numbers.max_diameter = 0.0025;
  EXPECT_EQ(numbers_table(numbers),
            "windows       2500 of 0.0002 s\n"
            "fluid steps   2 of 0.0001 s in the first window (k)\n"
            "              0.5 of the Courant limit (0.0002 s), 0.1 of a capillary wave (0.001 s)\n"
            "DEM steps     100 of 2e-06 s in each window (n)\n"
            "              0.05 of a collision (4e-05 s), 4e-06 of drag m/beta (0.5 s)\n"
            "fine cells    48000 at the start\n"
            "bulk cells    6000, 4 particle diameters wide\n"
            "particles     3883 at the start, 0.0025 m\n");
  EXPECT_EQ(numbers_table({}), "fine cells    0 at the start\n") << "nothing about particles without any";
}

TEST(ScenePlan, AdvisesAddedMassForParticlesLighterThanTheFluid) {
  SceneFacts facts;
  facts.particles = true;
  facts.particle_count = 1;
  facts.two_fluids = false;
  facts.liquid_density = 1000;
  facts.lightest_particle = 20;
  ForceParameters forces;
  ASSERT_EQ(plan_scene({}, facts, forces).advice.size(), 1u);
  EXPECT_NE(plan_scene({}, facts, forces).advice[0].find("26 times too quickly"), std::string::npos)
      << plan_scene({}, facts, forces).advice[0];
  forces.added_mass = 0.5;
  EXPECT_TRUE(plan_scene({}, facts, forces).advice.empty());
  forces.added_mass = 0;
  facts.lightest_particle = 1000;
  EXPECT_TRUE(plan_scene({}, facts, forces).advice.empty());
}

TEST(ScenePlan, WarnsOfPhasesUpsideDownAndOfStepsLongerThanContacts) {
  SceneFacts facts;
  facts.liquid_density = 1.2;
  facts.gas_density = 1000;
  ASSERT_EQ(plan_scene({}, facts).advice.size(), 1u);
  EXPECT_NE(plan_scene({}, facts).advice[0].find("first of 'phases'"), std::string::npos);
  std::swap(facts.liquid_density, facts.gas_density);
  EXPECT_TRUE(plan_scene({}, facts).advice.empty());

  facts.particles = true;
  facts.particle_count = 1;
  facts.dem_time_step = 1e-4;
  facts.collision_time = 5.1e-4;
  facts.rayleigh_time = 2.1e-4;
  EXPECT_TRUE(plan_scene({}, facts).advice.empty());
  facts.collision_time = 3.7e-5;
  ASSERT_EQ(plan_scene({}, facts).advice.size(), 1u);
  EXPECT_NE(plan_scene({}, facts).advice[0].find("2.7 of a collision"), std::string::npos);
  facts.collision_time = 0;
  facts.rayleigh_time = 1e-4;
  ASSERT_EQ(plan_scene({}, facts).advice.size(), 1u);
  EXPECT_NE(plan_scene({}, facts).advice[0].find("1 of a Rayleigh wave"), std::string::npos);
}

}  // namespace
}  // namespace demvof
