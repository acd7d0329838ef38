// SPDX-License-Identifier: GPL-3.0-or-later
// Beads that come to a wall, or to a bead that is held, through a film, against exact solutions.

#include <cmath>

#include "tests/mock/film_fixture.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof_test {
namespace {

/// Speed after over speed before, of a bead that flies against something at z = 0.
double rebound(const std::string& what, double viscosity, const LubricationParameters& films, double speed,
               bool lubricated = true) {
  const double radius = bead_diameter / 2;
  std::vector<Sphere> spheres = {{{0.0501, 0.0502, radius * (1 + 1.4 * films.cut_off)}, {0, 0, -speed}}};
  std::string held, stl;
  if (what == "sphere") {  // that is held
    spheres.push_back({{0.0501, 0.0502, -radius}, {}});
    held = "group held id 2\nfix hold held freeze\ngroup free id 1\nfix integrate free nve/sphere\n";
  } else {
    held = std::string(integrate) +
           "fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0.0\n";
  }
  std::string script = box_of(spheres, 5e-6);
  const std::string box = "block 0 0.1 0 0.1 0 0.4";
  script.replace(script.find(box), box.size(), "block 0.04 0.06 0.04 0.06 -0.01 0.01");
  script.replace(script.find("gamman peratomtypepair 1 590."), 29, "gamman peratomtypepair 1 90.");
  Scene scene("rebound_" + what, script + held);
  ForceParameters parameters = films_alone(films);
  if (!lubricated) parameters.lubrication.reset();
  FluidForces forces(*scene.dem, parameters);
  start(*scene.dem, forces, liquid(viscosity));
  for (int n = 0; n < 60; ++n) {
    scene.dem->run(20);
    const State now = state(*scene.dem);
    if (now.at[0].z > radius * (1 + films.cut_off) && now.velocity[0].z > 0) return now.velocity[0].z / speed;
  }
  return 0;  // it stays in the film
}

// Davis, Serayssol and Hinch (1986), Barnocky and Davis (1988): what approaches loses St_c/St of its velocity
// in the film, St_c = ln(h_c/h_r), comes back with the dry coefficient of that, and, where the film
// cavitates, with no further loss: e = e_dry (1 - St_c/St). Where it sucks it loses St_c/St once more.
TEST(DemFilmWalls, ComesBackFromAWallAsDavisAndBarnockySay) {
  const double radius = bead_diameter / 2, speed = 0.3;
  for (const std::string what : {"plane", "sphere"}) {
    const double a = what == "plane" ? radius : radius / 2;
    const double dry = rebound(what, 1, {}, speed, false);
    EXPECT_GT(dry, 0.7);
    EXPECT_LT(dry, 0.99);
    for (const double roughness : {1e-2, 1e-4})
      for (const double stokes : {4.0, 20.0, 100.0}) {
        const double viscosity = bead_mass * speed / (6 * pi * a * a * stokes);
        const double critical = std::log(0.1 / roughness);
        const double cavitated = rebound(what, viscosity, {0.1, roughness, false}, speed);
        const double sucked = rebound(what, viscosity, {0.1, roughness, true}, speed);
        const double arrives = std::max(1 - critical / stokes, 0.0);
        EXPECT_NEAR(cavitated, dry * arrives, 0.0013) << what << " " << roughness << " " << stokes;
        EXPECT_NEAR(sucked, std::max(dry * arrives - critical / stokes, 0.0), 0.0013)
            << what << " " << roughness << " " << stokes;
      }
  }
}

// A floor of two triangles has one film, which goes with it.
TEST(DemFilmWalls, MeetsTriangulatedWallsOnce) {
  const double radius = bead_diameter / 2, gap = 0.05 * radius, speed = 0.05, viscosity = 0.05;
  const Sphere sphere{{0.05, 0.05, 0.1 + radius + gap}, {0, 0, -speed}};  // over the edge of both
  const std::filesystem::path folder = scene_folder("lubrication_stl", MPI_COMM_WORLD);
  const std::filesystem::path stl = folder / "floor.stl";
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    std::filesystem::create_directories(folder);
    std::ofstream text(stl);
    const auto facet = [&](const std::string& corners) {
      text << "facet normal 0 0 1\nouter loop\n" << corners << "endloop\nendfacet\n";
    };
    text << "solid floor\n";
    facet("vertex 0.01 0.01 0.1\nvertex 0.09 0.01 0.1\nvertex 0.09 0.09 0.1\n");
    facet("vertex 0.01 0.01 0.1\nvertex 0.09 0.09 0.1\nvertex 0.01 0.09 0.1\n");
    text << "endsolid floor\n";
  }
  MPI_Barrier(MPI_COMM_WORLD);
  for (const bool moves : {false, true}) {
    Scene scene(
        "mesh_wall",
        box_of({sphere}, 1e-6) + integrate + "fix floor all mesh/surface file " + stl.string() +
            " type 1\nfix wall all wall/gran model hooke/stiffness tangential history mesh n_meshes 1 "
            "meshes floor\n" +
            (moves ? "fix go all move/mesh mesh floor linear 0. 0. -0.05\n" : ""));
    FluidForces forces(*scene.dem, films_alone());
    start(*scene.dem, forces, liquid(viscosity));
    scene.dem->run(300);
    const State now = state(*scene.dem);
    const double left = now.at[0].z - 0.1 - radius;
    const double loss = 6 * pi * viscosity * radius * radius / sphere.mass();
    if (moves) {  // bead and floor go alike: no film changes
      EXPECT_NEAR(now.velocity[0].z, -speed,
                  2e-3 * speed);  // LIGGGHTS's first half step knows a floor at rest
    } else {
      EXPECT_NEAR((speed + now.velocity[0].z) / (loss * std::log(gap / left)), 1, 1e-2);
    }
    EXPECT_EQ(films_counted(forces, *scene.dem), 301);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) std::filesystem::remove_all(folder);
}

// A bead sinks through its drag and a film to a floor, in steps much longer than its response to the drag: at
// each gap with the velocity at which both bear its weight.
TEST(DemFilmWalls, SharesTheWeightWithAStiffDrag) {
  const double radius = bead_diameter / 2, viscosity = 20, step = 1e-4;
  const double beta = 3 * pi * viscosity * bead_diameter;  // response m/beta = 5e-5 s
  const Sphere sphere{{0.05, 0.05, radius * 1.05}, {}};
  Scene scene(
      "stiff_drag",
      box_of({sphere}, step) + gravity + integrate +
          "fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0.0\n");
  ForceParameters parameters = films_alone();
  parameters.drag = demvof::DragLaw::schiller_naumann;
  FluidForces forces(*scene.dem, parameters);
  start(*scene.dem, forces, liquid(viscosity));
  scene.dem->run(10);
  for (int n = 0; n < 5; ++n) {
    scene.dem->run(100);
    const State now = state(*scene.dem);
    const double film = 6 * pi * viscosity * radius * radius / (now.at[0].z - radius);
    EXPECT_NEAR(now.velocity[0].z / (-9.81 * bead_mass / (beta + film)), 1, 2e-2) << n;
  }
}

}  // namespace
}  // namespace demvof_test
