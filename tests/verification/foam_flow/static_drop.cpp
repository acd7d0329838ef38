// SPDX-License-Identifier: GPL-3.0-or-later
// A drop at rest without gravity: every velocity is spurious. La = sigma rho D/mu^2 = 12000, densities
// 1000 : 1, 16 cells across the drop. The measure is Ca = mu max|u|/sigma, u between the particles, on the
// same mesh and time step as the distribution's interFoam and interIsoFoam. With held beads in it, beads in
// one half of the box (the interface goes in and out of a void fraction that jumps), and the same without any
// drag to damp.

#include <gtest/gtest.h>

#include <algorithm>

#include "foam_case.hpp"
#include "tests/support/record.hpp"

namespace demvof::test {
namespace {

constexpr double sigma = 0.07, rho = 1000, diameter = 0.01, laplace = 12000;  // N/m, kg/m3, m, -
constexpr double box = 0.02, dt = 2e-4;                                       // m, s
constexpr int cells = 32;

double viscosity() {  // of the drop, Pa s
  return std::sqrt(sigma * rho * diameter / laplace);
}

/// centre: of the drop, m from that of the box, along x and z.
double drop(const vector& x, double centre) {
  constexpr int samples = 20;
  const double h = box / cells;
  int inside = 0;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      const double dx = x.x() + h * ((i + 0.5) / samples - 0.5) - 0.5 * box - centre;
      const double dz = x.z() + h * ((j + 0.5) / samples - 0.5) - 0.5 * box - 0.6 * centre;
      inside += dx * dx + dz * dz < 0.25 * diameter * diameter;
    }
  return double(inside) / (samples * samples);
}

struct Variant {
  std::string name;
  Settings settings;
  double (*eps)(const vector&);  // nullptr: no particles
  double drag;                   // C where eps < 1, kg/(m3 s)
  double centre = 0;             // of the drop, m from that of the box
};

double core(const vector& x) {
  const double r = std::hypot(x.x() - 0.5 * box, x.z() - 0.5 * box);
  return r < 0.25 * diameter ? 0.6 : 1;
}

double half(const vector& x) {
  return x.x() > 0.55 * box ? 0.6 : 1;
}

double everywhere(const vector&) {
  return 0.6;
}

double smooth_half(const vector& x) {
  return 0.8 - 0.2 * std::tanh((x.x() - 0.55 * box) / (0.1 * box));
}

Settings drop_case(const Settings& changes, double end_time) {
  Settings all{{"lx", std::to_string(box)},
               {"ly", std::to_string(box / cells)},
               {"lz", std::to_string(box)},
               {"nx", std::to_string(cells)},
               {"ny", "1"},
               {"nz", std::to_string(cells)},
               {"g_z", "0"},
               {"sigma", std::to_string(sigma)},
               {"nu_water", std::to_string(viscosity() / rho)},
               {"walls_U", "{ type slip; }"},
               {"bottom_U", "{ type slip; }"},
               {"adjust", "no"},
               {"first_step", std::to_string(dt)},
               {"longest_step", std::to_string(dt)},
               {"end_time", std::to_string(end_time)},
               {"stop", "endTime"},
               {"steps", "20"},
               {"p_tolerance", "1e-10"}};
  for (const auto& [key, value] : changes) all[key] = value;
  return all;
}

struct History {
  std::vector<double> time, capillary;
  double water_error = 0, excess = 0;
  double worst() const { return *std::max_element(capillary.begin(), capillary.end()); }
  double last() const { return capillary.back(); }
};

History ours(const Variant& variant, double end_time) {
  const bool beads = variant.eps != nullptr;
  const auto flow =
      FoamCase("static_drop", drop_case(variant.settings, 2 * end_time)).open(scene(beads, beads, true));
  set_alpha(*flow, [&](const vector& x) { return drop(x, variant.centre); });
  scalarField eps;
  if (beads) {
    eps = cell_values(*flow, variant.eps);
    set_initial_porosity(*flow, eps);
    forAll(eps, cell) flow->source->coefficient[cell] = eps[cell] < 0.99 ? variant.drag : 0;
  }
  const double water = liquid_volume(*flow);
  History history;
  const int windows = static_cast<int>(std::lround(end_time / (20 * dt)));
  for (int k = 1; k <= windows; ++k) {
    begin_window(*flow, k * 20 * dt);
    if (beads) set_porosity_target(*flow, eps);
    advance(*flow);
    history.time.push_back(flow->time.value());
    history.capillary.push_back(viscosity() * largest_speed(*flow) / sigma);
    history.water_error = std::max(history.water_error, std::abs(liquid_volume(*flow) / water - 1));
  }
  history.excess = flow->alpha_excess;
  return history;
}

History theirs(const std::string& program, double end_time) {
  const FoamCase folder("static_drop_" + program, drop_case({}, end_time));
  {
    const auto flow = folder.open(scene(false, false, true));
    set_alpha(*flow, [&](const vector& x) { return drop(x, 0); });
    flow->alpha.write();
  }
  folder.run(program);
  const Foam::fileName name(folder.folder());
  Foam::Time time(Foam::Time::controlDictName, name.path(), Foam::fileName(name.name()));
  History history;
  for (const Foam::instant& at : time.times()) {
    if (!(at.value() > 0)) continue;
    time.setTime(at, 0);
    const Foam::fvMesh mesh(
        Foam::IOobject(Foam::fvMesh::defaultRegion, time.timeName(), time, Foam::IOobject::MUST_READ));
    const volVectorField U(Foam::IOobject("U", time.timeName(), mesh, Foam::IOobject::MUST_READ), mesh);
    history.time.push_back(at.value());
    history.capillary.push_back(viscosity() * Foam::gMax(Foam::mag(U.primitiveField())()) / sigma);
  }
  return history;
}

constexpr double short_time = 0.06;  // s

void static_drop(double end_time, const std::string& command) {
  Record record(
      "static_drop", "Spurious currents at a drop at rest",
      "Plane drop, La = 12000, densities 1000 : 1, 16 cells across, no gravity. Largest velocity as "
      "capillary number over time: MULES against the distribution's interFoam, isoAdvector against its "
      "interIsoFoam, on the same mesh with the same time step; without beads, with held beads inside, and "
      "with a void fraction that jumps "
      "from 1 to 0.6 across the interface, with drag and without any. A bed has drag: over a long time the "
      "variants without it are recorded only (their drop is driven off, docs/theory.md).",
      command);
  const auto draw = [&](const std::string& series, const History& history, const std::string& style) {
    record.curve("capillary number of the spurious currents", "t, s", "Ca = mu max|u| / sigma, -", series,
                 history.time, history.capillary, "y", style);
  };
  const Settings mules{{"alpha_scheme", "MULES"}}, iso{{"alpha_scheme", "isoAdvection"}};
  for (const auto& [program, scheme] : {std::pair{"interFoam", mules}, std::pair{"interIsoFoam", iso}}) {
    const History reference = theirs(program, end_time);
    record.note(std::string(program) + ": largest capillary number", reference.worst());
    record.note(std::string(program) + ": capillary number at the end", reference.last());
    draw(program, reference, program == std::string("interFoam") ? "k--" : "r--");
    for (const Variant& variant :
         {Variant{"no beads", scheme, nullptr, 0}, Variant{"beads inside", scheme, core, 1e5},
          Variant{"beads across", scheme, half, 1e5}, Variant{"eps across, no drag", scheme, half, 0},
          Variant{"smooth eps across, no drag", scheme, smooth_half, 0},
          Variant{"no beads, off centre", scheme, nullptr, 0, 0.0023 * box},
          Variant{"eps 0.6 everywhere, no drag", scheme, everywhere, 0},
          Variant{"eps 0.6 everywhere, no drag, off centre", scheme, everywhere, 0, 0.0023 * box}}) {
      const std::string name = scheme.at("alpha_scheme") + ", " + variant.name;
      const History history = ours(variant, end_time);
      const bool control = variant.centre != 0 || variant.eps == everywhere;
      if (control && end_time <= short_time) continue;
      const bool driven_off = control || (variant.eps && variant.drag == 0 && end_time > short_time);
      const auto bounded = [&](const std::string& what, double value, double bound) {
        driven_off ? record.note(what, value) : record.at_most(what, value, bound);
      };
      bounded(name + ": largest capillary number over " + program + "'s", history.worst() / reference.worst(),
              1.05);
      record.note(name + ": capillary number at the end over " + program + "'s",
                  history.last() / reference.last());
      bounded(name + ": liquid volume", history.water_error, end_time > short_time ? 2.4e-11 : 3.9e-14);
      draw(name, history, "-");
    }
  }
}

TEST(StaticDrop, Short) {
  static_drop(short_time, "tests/Alltest --verification -- -R foam_flow.StaticDrop");
}

TEST(StaticDrop, Long) {
  static_drop(1.0, "tests/Alltest --verification -- -R foam_flow.StaticDropLong");
}

}  // namespace
}  // namespace demvof::test
