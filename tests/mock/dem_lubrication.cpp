// SPDX-License-Identifier: GPL-3.0-or-later
// Films between real LIGGGHTS's particles, against exact solutions: what two spheres lose, what a cloud of
// them keeps.

#include <cmath>
#include <cstdlib>
#include <random>

#include "coupler/base/errors.hpp"
#include "dem_side/report.hpp"
#include "tests/mock/film_fixture.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof_test {
namespace {

/// Two spheres on one line across the border of two ranks, gap over mean radius, closing speed.
std::vector<Sphere> two_spheres(double gap, double speed, double diameter = 1.8e-3) {
  const Vec3 way = Vec3{1, 2, 2} / 3;
  Sphere one{{0.05, 0.05, 0.2001}, {}}, other{{}, {}, diameter, 1200};
  const double radii = 0.5 * (one.diameter + other.diameter);
  other.at = one.at - (radii + gap * radii / 2) * way;
  one.velocity = (-0.3 * speed) * way;
  other.velocity = (0.7 * speed) * way;
  return {one, other};
}
double gap_of(const State& now, const std::vector<Sphere>& spheres) {
  return norm(now.at[0] - now.at[1]) - 0.5 * (spheres[0].diameter + spheres[1].diameter);
}
/// 6 pi mu a^2 (1/m_1 + 1/m_2), m/s, by the formulas.
double loss_per_e_fold(double viscosity, const std::vector<Sphere>& spheres) {
  const double r1 = spheres[0].diameter / 2, r2 = spheres[1].diameter / 2;
  return 6 * pi * viscosity * std::pow(r1 * r2 / (r1 + r2), 2) *
         (1 / spheres[0].mass() + 1 / spheres[1].mass());
}

// dv = (6 pi mu a^2/m) ln(h_0/h), for viscosities over 18 decades: those that stop the spheres in a film, and
// those that they hardly feel. No reversal and no gain of energy in any step.
TEST(DemLubrication, TakesTheExactVelocityFromTwoSpheres) {
  const double step = 1e-6, speed = 0.1, begin_gap = 0.08, radius = 0.5 * 0.5 * (bead_diameter + 1.8e-3);
  for (const double viscosity : {1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 1e3, 1e9}) {
    const std::vector<Sphere> spheres = two_spheres(begin_gap, speed);
    Scene scene("two_spheres", box_of(spheres, step) + integrate);
    FluidForces forces(*scene.dem, films_alone());
    start(*scene.dem, forces, liquid(viscosity));
    const double loss = loss_per_e_fold(viscosity, spheres);
    const Vec3 momentum = spheres[0].mass() * spheres[0].velocity + spheres[1].mass() * spheres[1].velocity;
    const double first_gap = begin_gap * radius;
    double closing = speed, gap = first_gap;
    State now;
    for (int n = 0; n < 60; ++n) {
      scene.dem->run(10);
      now = state(*scene.dem);
      const Vec3 way = (now.at[0] - now.at[1]) / norm(now.at[0] - now.at[1]);
      const double before = closing;
      closing = -dot(now.velocity[0] - now.velocity[1], way);
      gap = gap_of(now, spheres);
      ASSERT_GE(closing, -1e-12 * speed) << viscosity << " " << n;
      ASSERT_LE(closing, before * (1 + 1e-12)) << viscosity << " " << n;
      if (gap < 1e-3 * radius) break;
      // The step's velocity and the gap at its end.
      const double end = gap - step * closing;
      const double expected = loss * std::log(first_gap / end);
      ASSERT_NEAR(speed - closing, expected, 1e-9 * speed + 1e-12 * loss) << viscosity << " " << n;
      ASSERT_LT(norm(spheres[0].mass() * now.velocity[0] + spheres[1].mass() * now.velocity[1] - momentum),
                1e-13 * norm(momentum));
    }
    // By the formula, with nothing of how steps are counted.
    if (gap > 1e-3 * radius && loss < speed && speed - closing > 1e-4 * speed) {
      EXPECT_NEAR((speed - closing) / (loss * std::log(first_gap / gap)), 1, 1e-2) << viscosity;
    }
    if (viscosity >= 0.1) {
      EXPECT_GT(gap, 1e-3 * radius) << viscosity;
    }
    if (viscosity >= 1) {
      EXPECT_LT(closing, 1e-3 * speed) << viscosity;
    }
  }
}

// The same film where a periodic boundary is between the spheres.
TEST(DemLubrication, ActsAcrossAPeriodicBoundary) {
  State reference;
  for (const double shift : {0.0, 0.0496}) {
    std::vector<Sphere> spheres = two_spheres(0.08, 0.1);
    for (Sphere& sphere : spheres) sphere.at.x += (sphere.at.x < shift ? 0.1 : 0) - shift;
    Scene scene("periodic_film", box_of(spheres, 1e-6, "p p p") + integrate);
    FluidForces forces(*scene.dem, films_alone());
    start(*scene.dem, forces, liquid(1e-2));
    scene.dem->run(100);
    EXPECT_EQ(films_counted(forces, *scene.dem), 101);
    const State now = state(*scene.dem);
    if (shift == 0) reference = now;
    for (int i = 0; i < 2; ++i) EXPECT_LT(norm(now.velocity[i] - reference.velocity[i]), 1e-11) << shift;
    EXPECT_LT(norm(now.velocity[0] - now.velocity[1]), 0.099);
  }
}

// Steps in which the spheres would pass through each other's film and out of it again.
TEST(DemLubrication, IsStableInStepsThatAreTooLong) {
  for (const double step : {1e-4, 1e-3, 1e-1})
    for (const double viscosity : {1e-4, 1.0, 1e4}) {
      const std::vector<Sphere> spheres = two_spheres(0.08, 0.1);
      Scene scene("long_steps", box_of(spheres, step) + integrate);
      FluidForces forces(*scene.dem, films_alone());
      start(*scene.dem, forces, liquid(viscosity));
      const double speed = 0.1;
      double before = speed;
      for (int n = 0; n < 5; ++n) {
        scene.dem->run(1);
        const State now = state(*scene.dem);
        if (gap_of(now, spheres) < 0) break;  // a contact has the word
        const double relative = norm(now.velocity[0] - now.velocity[1]);
        EXPECT_LE(relative, before * (1 + 1e-12)) << step << " " << viscosity;
        before = relative;
      }
      if (viscosity >= 1) {
        EXPECT_LT(before, 0.05 * speed) << step << " " << viscosity;
      }
    }
}

/// Spheres of several sizes that do not touch, in a periodic box.
std::vector<Sphere> cloud(int count) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const Vec3 period{0.1, 0.1, 0.4};
  const double smallest = 5e-3, room = 0.03;
  std::vector<Sphere> spheres;
  while (static_cast<int>(spheres.size()) < count) {
    Sphere sphere;
    sphere.diameter = smallest * between(1, 2);
    sphere.density = between(500, 5000);
    sphere.at = {between(0, period.x), between(0, period.y), between(0.2 - room / 2, 0.2 + room / 2)};
    sphere.velocity = {between(-1, 1), between(-1, 1), between(-1, 1)};
    bool free = true;
    for (const Sphere& other : spheres) {
      Vec3 apart = sphere.at - other.at;
      for (int axis = 0; axis < 3; ++axis)
        apart[axis] -= period[axis] * std::round(apart[axis] / period[axis]);
      free = free && norm(apart) > 0.5 * (sphere.diameter + other.diameter) * 1.0005;
    }
    if (free) spheres.push_back(sphere);
  }
  return spheres;
}

// Many films at each of them: momentum is kept to round-off, energy only goes down, from a film that is
// hardly felt to one that is infinitely stiff beside the step. What is found goes to a file when one is
// named, for dem_films_ranks_test.py.
TEST(DemLubrication, KeepsTheMomentumOfACloud) {
  const char* file = std::getenv("DEMVOF_CLOUD_FILE");
  const std::vector<Sphere> spheres = cloud(400);
  double scale = 0;
  Vec3 momentum;
  for (const Sphere& sphere : spheres) {
    momentum += sphere.mass() * sphere.velocity;
    scale += sphere.mass() * norm(sphere.velocity);
  }
  std::string text;
  for (const double viscosity : {1e-2, 1e9}) {
    Scene scene("cloud", box_of(spheres, 1e-6, "p p p") + integrate);
    LubricationParameters wide;
    wide.cut_off = 0.4;
    FluidForces forces(*scene.dem, films_alone(wide));
    start(*scene.dem, forces, liquid(viscosity));
    const auto energy = [&](const State& now) {
      double sum = 0;
      for (std::size_t i = 0; i < spheres.size(); ++i)
        sum += 0.5 * spheres[i].mass() * dot(now.velocity[i], now.velocity[i]);
      return sum;
    };
    State now;
    double before = 1e300;
    for (int n = 0; n < 5; ++n) {
      scene.dem->run(1);
      now = state(*scene.dem);
      Vec3 sum;
      for (std::size_t i = 0; i < spheres.size(); ++i) sum += spheres[i].mass() * now.velocity[i];
      EXPECT_LT(norm(sum - momentum), 1e-14 * scale) << viscosity << " " << n;
      EXPECT_LE(energy(now), before * (1 + 1e-14)) << viscosity << " " << n;
      before = energy(now);
    }
    EXPECT_GT(films_counted(forces, *scene.dem), 6 * 300) << viscosity;
    for (const Vec3& v : now.velocity) text += fmt::format("{:.17g} {:.17g} {:.17g}\n", v.x, v.y, v.z);
  }
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (file && rank == 0) std::ofstream(file) << text;
}

// A cloud that goes on from a written state is the one that did not stop, to the last bit.
TEST(DemLubrication, GoesOnFromAState) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     (scene_folder("cloud_state", MPI_COMM_WORLD).string() + ".restart");
  const auto advance = [&](demvof::Dem& dem, FluidForces& forces) {
    begin(dem, forces, liquid(1), 4e-6);
    dem.run(4);
  };
  const std::string whole = box_of(cloud(200), 1e-6, "p p p") + integrate;
  State expected;
  {
    Scene scene("cloud_whole", whole);
    FluidForces forces(*scene.dem, films_alone({0.4, 1e-3, true}));
    start(*scene.dem, forces, liquid(1));
    advance(*scene.dem, forces);
    scene.dem->write_restart(file);
    scene.dem->write_rows(demvof::Dem::rows_file(file));
    advance(*scene.dem, forces);
    expected = state(*scene.dem);
  }
  const auto part = [&](const std::string& from, const std::string& to) {
    const auto begin = whole.find(from);
    return whole.substr(begin, whole.find(to) - begin);
  };
  Scene scene("cloud_parts",
              part("units", "region box") + "read_restart ${restart_file}\n" +
                  part("neighbor", "create_atoms") + integrate,
              MPI_COMM_WORLD, file);
  FluidForces forces(*scene.dem, films_alone({0.4, 1e-3, true}));
  forces.go_on_from(4e-6, 4);
  scene.dem->set_up();
  advance(*scene.dem, forces);
  const State now = state(*scene.dem);
  ASSERT_EQ(now.at.size(), expected.at.size());
  for (std::size_t i = 0; i < now.at.size(); ++i) {
    EXPECT_EQ(norm(now.at[i] - expected.at[i]), 0) << i;
    EXPECT_EQ(norm(now.velocity[i] - expected.velocity[i]), 0) << i;
  }
  EXPECT_GT(films_counted(forces, *scene.dem), 4 * 50);
  MPI_Barrier(MPI_COMM_WORLD);
  std::error_code none;
  std::filesystem::remove(file, none);
}

// The liquid that two spheres move along is part of their inertia. Half out of it their film is half gas.
TEST(DemLubrication, KnowsAddedMassAndTheWettedShare) {
  const double step = 1e-6, speed = 0.1, added_mass = 0.5, viscosity = 0.01;
  for (const double wetted : {1.0, 0.5}) {
    const std::vector<Sphere> spheres = two_spheres(0.08, speed);
    Scene scene("added_mass", box_of(spheres, step) + integrate);
    ForceParameters parameters = films_alone();
    parameters.added_mass = added_mass;
    FluidForces forces(*scene.dem, parameters);
    scene.dem->set_up();
    demvof::SeenSurface surface;
    surface.wetted = wetted;
    const double densities[] = {1000, 1e-9}, viscosities[] = {viscosity, 0.2 * viscosity};
    forces.begin_window(demvof::FluidsAtParticles{{[&](int) { return liquid(viscosities[0], densities[0]); },
                                                   [&](int) { return liquid(viscosities[1], densities[1]); }},
                                                  [&](int) { return surface; }},
                        1e-3);
    forces.first_half_step();
    scene.dem->run(300);
    const State now = state(*scene.dem);
    const Vec3 way = (now.at[0] - now.at[1]) / norm(now.at[0] - now.at[1]);
    const double closing = -dot(now.velocity[0] - now.velocity[1], way);
    double mobility = 0, a = 1;
    for (const Sphere& sphere : spheres) {
      const double radius = sphere.diameter / 2;
      mobility += 1 / (sphere.mass() + wetted * added_mass * 1000 * 4 / 3 * pi * radius * radius * radius);
      a = mobility > 0 ? a * radius : a;
    }
    a /= 0.5 * (spheres[0].diameter + spheres[1].diameter);
    const double loss = 6 * pi * (wetted + 0.2 * (1 - wetted)) * viscosity * a * a * mobility;
    const double first_gap = 0.08 * 0.25 * (spheres[0].diameter + spheres[1].diameter);
    const double end = gap_of(now, spheres) - step * closing;
    EXPECT_NEAR((speed - closing) / (loss * std::log(first_gap / end)), 1, 1e-9) << wetted;
  }
}

// A film narrower than the roughness does nothing and is counted; one wider than the cut-off is none.
TEST(DemLubrication, CountsWhatIsNarrowerThanTheRoughness) {
  for (const auto& [gap, films, rough] :
       {std::tuple(5e-4, 11.0, 11.0), {0.05, 11.0, 0.0}, {0.15, 0.0, 0.0}}) {
    Scene scene("roughness", box_of(two_spheres(gap, 1e-3), 1e-8) + integrate);
    FluidForces forces(*scene.dem, films_alone());
    start(*scene.dem, forces, liquid(1e3));
    scene.dem->run(10);
    EXPECT_EQ(films_counted(forces, *scene.dem), films) << gap;
    EXPECT_EQ(films_counted(forces, *scene.dem, true), rough) << gap;
    const State now = state(*scene.dem);
    const double closing = norm(now.velocity[0] - now.velocity[1]);
    if (films == rough) {
      EXPECT_NEAR(closing, 1e-3, 1e-12);
    } else {
      EXPECT_LT(closing, 0.9e-3);
    }
  }
}

// What LIGGGHTS did to the momentum of beads over a floor is what the books say, films among the contacts.
TEST(DemLubrication, IsBookedWithTheContacts) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 5; ++i) {
    spheres.push_back({{0.02 + 0.0135 * i, 0.05, 0.0014}, {0, 0, -0.01}});
    spheres.push_back({{0.0201 + 0.0135 * i, 0.0501, 0.0042}, {0.01, 0, -0.1}});
  }
  Scene scene(
      "film_books",
      box_of(spheres, 1e-6) + gravity +
          "fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0.0\n" +
          integrate);
  ForceParameters parameters = films_alone();
  parameters.drag = demvof::DragLaw::schiller_naumann;
  parameters.added_mass = 0.5;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  for (int n = 0; n < 10; ++n) {
    FluidAtParticle fluid = liquid(0.1, 1000);
    fluid.velocity = {0.3 * std::sin(n), 0.1, 0};
    const Vec3 before = demvof::half_step_momentum(*scene.dem);
    begin(*scene.dem, forces, fluid, 1e-4);
    if (n == 0) forces.first_half_step();
    scene.dem->run(100);
    const Vec3 change = demvof::half_step_momentum(*scene.dem) - before;
    demvof::WindowImpulses impulses = forces.impulses();
    MPI_Allreduce(MPI_IN_PLACE, &impulses.drag.x, sizeof(impulses) / sizeof(double), MPI_DOUBLE, MPI_SUM,
                  scene.dem->world());
    const Vec3 booked = impulses.drag + impulses.contact + impulses.gravity;
    EXPECT_LT(norm(change - booked), 1e-12 * (norm(impulses.gravity) + norm(impulses.drag))) << n;
    EXPECT_GT(films_counted(forces, *scene.dem), 0);
  }
}

std::string refusal(const std::string& script) {
  Scene scene("films_refused", script);
  try {
    FluidForces forces(*scene.dem, films_alone());
  } catch (const demvof::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DemLubrication, RefusesContactsThatShowNoPairs) {
  const std::string script = box_of({{{0.05, 0.05, 0.2}, {}}}, 1e-5) + integrate;
  EXPECT_EQ(refusal(script), "");
  std::string none = script, one_sided = script;
  none.replace(none.find("pair_style gran"),
               std::string("pair_style gran model hooke/stiffness tangential history").size(),
               "pair_style none");
  none.replace(none.find("pair_coeff * *"), 14, "");
  EXPECT_NE(refusal(none).find("pair_style gran"), std::string::npos) << refusal(none);
  one_sided.replace(one_sided.find("newton off"), 10, "newton on");
  one_sided.replace(one_sided.find("tangential history"), 18, "tangential no_history");
  EXPECT_NE(refusal(one_sided).find("newton off"), std::string::npos) << refusal(one_sided);
}

}  // namespace
}  // namespace demvof_test
