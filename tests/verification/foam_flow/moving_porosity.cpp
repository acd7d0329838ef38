// SPDX-License-Identifier: GPL-3.0-or-later
// A prescribed smooth void fraction moves through one liquid. Exact solutions without viscosity:
//
//   closed box    eps = X(x, t) Z(z, t):  u = (a, 0, c),  a = -int_0^x X_t dx / X,  c likewise with Z.
//                 Curl-free, no flow through the walls, div(eps u) = -d(eps)/dt: the potential solution.
//   open box      what leaves is what the moving solid displaces, in every step of a window alike.
//
//   X = 1 - 0.4 exp(-((x - x_c(t))/w)^2)

#include <gtest/gtest.h>

#include <algorithm>

#include "foam_case.hpp"
#include "tests/support/record.hpp"

namespace demvof::test {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double width = 0.09, depth = 0.4;  // m, -

/// One factor of the void fraction and the velocity it asks for: a hump that swings around 0.5 m.
struct Hump {
  double swing, speed;  // m, rad/s
  double centre(double t) const { return 0.5 + swing * std::sin(speed * t); }
  double eps(double x, double t) const { return 1 - depth * std::exp(-std::pow((x - centre(t)) / width, 2)); }
  double own_velocity(double t) const { return swing * speed * std::cos(speed * t); }
  /// int_0^x X_t dx = -V (X - 1), V the hump's velocity
  double velocity(double x, double t) const { return own_velocity(t) * (eps(x, t) - 1) / eps(x, t); }
};

const Hump along_x{0.1, 2 * pi}, along_z{-0.07, 3 * pi};

/// The solid's velocity: d(eps)/dt = div((1 - eps) v), and nothing passes the walls. Without one what changes
/// would have no inertia.
void move_solid(Flow& flow, double t) {
  Foam::vectorField velocity(flow.mesh.nCells());
  forAll(velocity, cell) {
    const vector x = flow.mesh.C()[cell];
    const double X = along_x.eps(x.x(), t), Z = along_z.eps(x.z(), t), solid = 1 - X * Z;
    const vector flux(Z * (1 - X) * along_x.own_velocity(t), 0, X * (1 - Z) * along_z.own_velocity(t));
    velocity[cell] = flux / std::max(solid, 1e-12);
  }
  set_solid_velocity(flow, velocity);
}

Settings liquid_box(int n) {
  return {{"lx", "1"},
          {"ly", std::to_string(1.0 / n)},
          {"lz", "1"},
          {"nx", std::to_string(n)},
          {"ny", "1"},
          {"nz", std::to_string(n)},
          {"nu_water", "1e-12"},
          {"top_alpha", "1"},
          {"walls_U", "{ type slip; }"},
          {"bottom_U", "{ type slip; }"},
          {"p_tolerance", "1e-14"},
          {"p_rel_tol", "0"},
          {"longest_step", "1"}};
}

struct Order {
  double velocity = 0;  // volume mean of |u - exact|, over the largest exact speed
  double worst = 0;     // largest
};

Order closed_box(int n) {
  Settings all = liquid_box(n);
  all["top_U"] = "{ type slip; }";
  all["top_p"] = "{ type fixedFluxPressure; value uniform 0; }";
  const int windows = 4 * n;  // Courant number about 0.15 at most
  const double end = 0.4, window = end / windows;
  all["first_step"] = std::to_string(window);
  const auto flow = FoamCase("moving_porosity", all).open(scene(true, true, false));
  set_alpha(*flow, [](const vector&) { return 1.0; });
  const auto eps_at = [&](double t) {
    return cell_values(*flow, [t](const vector& x) { return along_x.eps(x.x(), t) * along_z.eps(x.z(), t); });
  };
  set_initial_porosity(*flow, eps_at(0));
  for (int k = 1; k <= windows; ++k) {
    begin_window(*flow, k * window);
    flow->clock.limit = window;
    move_solid(*flow, (k - 0.5) * window);
    set_porosity_target(*flow, eps_at(k * window));
    advance(*flow);
  }
  // Continuity of the last window holds at its middle; the velocity field is the potential one then.
  const double t = end - 0.5 * window;
  Order error;
  double fastest = 0, sum = 0;
  forAll(flow->U, cell) {
    const vector x = flow->mesh.C()[cell];
    const vector exact(along_x.velocity(x.x(), t), 0, along_z.velocity(x.z(), t));
    const double difference = Foam::mag(flow->U[cell] - exact);
    fastest = std::max(fastest, Foam::mag(exact));
    sum += difference;
    error.worst = std::max(error.worst, difference);
  }
  error.velocity = sum / flow->mesh.nCells() / fastest;
  error.worst /= fastest;
  return error;
}

struct Books {
  double outflow = 0;  // worst distance of outflow from displaced volume, over the solid's volume
  double ramp = 0;     // worst difference of two outflow rates in one window, over the largest rate
  double water = 0;
};

/// Solid comes in from below (as a piston of beads would) and swings sideways, under an open top.
Books open_box(int steps_per_window) {
  Settings all = liquid_box(24);
  const double window = 0.02;
  all["first_step"] = all["longest_step"] = std::to_string(window / steps_per_window);
  const auto flow = FoamCase("moving_porosity_open", all).open(scene(true, true, false));
  set_alpha(*flow, [](const vector&) { return 1.0; });
  const auto eps_at = [&](double t) {
    return cell_values(*flow, [t](const vector& x) {
      const double grown = std::sin(0.5 * pi * std::min(1.0, t / 0.2));
      return 1 - grown * (1 - along_x.eps(x.x(), t) * along_z.eps(x.z(), t));
    });
  };
  const scalarField& volume = flow->mesh.V().field();
  const auto solid = [&](double t) { return Foam::gSum(scalarField((1 - eps_at(t)) * volume)); };
  set_initial_porosity(*flow, eps_at(0));
  const label top = flow->mesh.boundaryMesh().findPatchID("top");
  Books books;
  double out = 0, largest_rate = 0, worst_difference = 0, displaced = 0;
  const double largest_solid = solid(0.2);
  for (int k = 1; k <= 15; ++k) {
    begin_window(*flow, k * window);
    move_solid(*flow, (k - 0.5) * window);
    set_porosity_target(*flow, eps_at(k * window));
    std::vector<double> rates;
    while (advance_clock(*flow)) {
      rates.push_back(Foam::gSum(flow->phi.boundaryField()[top]));
      out += flow->time.deltaTValue() * rates.back();
      do_step(*flow);
    }
    const auto [low, high] = std::minmax_element(rates.begin(), rates.end());
    worst_difference = std::max(worst_difference, *high - *low);
    largest_rate = std::max(largest_rate, std::abs(*high));
    displaced = solid(k * window);
    books.outflow = std::max(books.outflow, std::abs(out - displaced) / largest_solid);
    for (const double alpha : flow->alpha.primitiveField())
      books.water = std::max(books.water, std::abs(alpha - 1));
  }
  books.ramp = worst_difference / largest_rate;
  return books;
}

/// What a loose pressure leaves of a window is not forgotten in the next.
TEST(MovingPorosity, ComesToItsTargetHoweverLooselyThePressureIsSolved) {
  Settings all = liquid_box(16);
  const double window = 0.01;
  all["first_step"] = std::to_string(window);
  all["p_tolerance"] = "1e-1";
  const auto flow = FoamCase("moving_porosity_loose", all).open(scene(true, true, false));
  set_alpha(*flow, [](const vector&) { return 1.0; });
  const auto eps_at = [&](double t) {
    return cell_values(*flow, [t](const vector& x) { return along_x.eps(x.x(), t) * along_z.eps(x.z(), t); });
  };
  set_initial_porosity(*flow, eps_at(0));
  double lag = 0;
  for (int k = 1; k <= 6; ++k) {
    begin_window(*flow, k * window);
    flow->clock.limit = window;
    move_solid(*flow, (k - 0.5) * window);
    set_porosity_target(*flow, eps_at(k * window));
    advance(*flow);
    const scalarField missed(Foam::mag(flow->porosity->goal.field() - eps_at(k * window)));
    EXPECT_LT(Foam::gMax(missed), 1e-14) << k;
    lag = std::max(
        lag, Foam::gMax(Foam::mag(flow->porosity->goal.field() - flow->porosity->eps.primitiveField())()));
  }
  EXPECT_GT(lag, 1e-9) << "and so loosely that it is one";
  EXPECT_LT(lag, 1e-2);
}

TEST(MovingPorosity, DisplacesWhatItShould) {
  Record record(
      "moving_porosity", "A void fraction that moves through one liquid",
      "div(eps u) = -d(eps)/dt with a prescribed smooth eps(x, t). Closed box: velocity against the "
      "exact potential solution on refined meshes, time step in proportion to the cell. Open box: "
      "outflow against displaced volume at the end of every window, and the outflow rate within a "
      "window.",
      "tests/Alltest --verification -- -R foam_flow.MovingPorosity");
  std::vector<double> cells{16, 32, 64}, mean, worst;
  for (const double n : cells) {
    const Order error = closed_box(static_cast<int>(n));
    mean.push_back(error.velocity);
    worst.push_back(error.worst);
  }
  const auto order = [](const std::vector<double>& errors) {
    const std::size_t last = errors.size() - 1;
    return std::log2(errors[last - 1] / errors[last]);
  };
  record.note("closed box, 64 x 64: mean velocity error / largest speed", mean.back());
  record.note("closed box, 64 x 64: largest velocity error / largest speed", worst.back());
  record.at_least("closed box: order of the mean error, 32 to 64", order(mean), 1.9);
  record.at_least("closed box: order of the largest error, 32 to 64", order(worst), 1.6);
  record.curve("velocity error in the closed box", "cells per side", "|u - exact| / largest speed, -", "mean",
               cells, mean, "xy");
  record.curve("velocity error in the closed box", "cells per side", "|u - exact| / largest speed, -",
               "largest", cells, worst, "xy");
  std::vector<double> second{mean[0], mean[0] / 4, mean[0] / 16};
  record.curve("velocity error in the closed box", "cells per side", "|u - exact| / largest speed, -",
               "second order", cells, second, "xy", "k--");
  for (const int steps : {1, 4}) {
    const Books books = open_box(steps);
    const std::string label =
        "open box, " + std::to_string(steps) + (steps > 1 ? " steps" : " step") + " a window: ";
    record.at_most(label + "outflow against displaced volume", books.outflow, 2e-14);
    record.at_most(label + "change of the outflow rate within a window", books.ramp, 7.9e-14);
    record.at_most(label + "|alpha - 1|", books.water, 5e-14);
  }
}

}  // namespace
}  // namespace demvof::test
