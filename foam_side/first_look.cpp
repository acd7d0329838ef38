// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/first_look.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "coupler/base/errors.hpp"
#include "foam_side/fine_mesh.hpp"
#include "wallPolyPatch.H"

namespace demvof {
namespace {

struct Body {
  Vec3 place, velocity;
};

struct Plane {
  std::string fix;
  int axis;
  double at;
};

/// Both programs' scenes side by side.
struct Look {
  const CaseParameters& parameters;
  const Flow& flow;
  const BulkGrid& grid;
  MeshBox mesh;
  Vec3 gravity;
  std::vector<Body> bodies;
  std::vector<Plane> planes;
  double largest_radius = 0;  // m, at the start
  double heaviest = 0;        // kg/m3
  double fastest = 0;         // m/s
  int fastest_id = 0;
  bool inserts = false, any_held = false, other_walls = false;

  /// The particles' box ends there as the mesh does, and the fluid is solved.
  bool ends(int axis) const { return !grid.periodic()[axis] && flow.mesh.geometricD()[axis] == 1; }
  std::vector<std::string> out_of_the_mesh() const;
  std::string too_fast() const;
  std::vector<std::string> walls_inside() const;
  std::string no_floor() const;
  double fastest_fall(double g) const;
};

bool is_inside(const Look& look, const Vec3& place) {
  for (int axis = 0; axis < 3; ++axis)
    if (look.ends(axis) && !(place[axis] >= look.mesh.lower[axis] && place[axis] <= look.mesh.upper[axis]))
      return false;
  return true;
}

/// A body that goes straight on from there meets the mesh's box.
bool leads_inside(const Look& look, const Vec3& place, const Vec3& along) {
  double first = 0, last = norm(along) > 0 ? std::numeric_limits<double>::infinity() : 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!look.ends(axis)) continue;
    double in = look.mesh.lower[axis] - place[axis], out = look.mesh.upper[axis] - place[axis];
    if (along[axis] == 0) {
      if (in > 0 || out < 0) return false;
      continue;
    }
    in /= along[axis];
    out /= along[axis];
    first = std::max(first, std::min(in, out));
    last = std::min(last, std::max(in, out));
  }
  return first <= last;
}

std::string box_text(const MeshBox& box) {
  return fmt::format("{:.4g} to {:.4g}, {:.4g} to {:.4g} and {:.4g} to {:.4g} m along x, y and z",
                     box.lower.x, box.upper.x, box.lower.y, box.upper.y, box.lower.z, box.upper.z);
}

std::vector<std::string> Look::out_of_the_mesh() const {
  constexpr double least_of_grid = 1e-3, most_outside = 0.5;
  std::vector<std::string> said;
  double share = 1;
  for (int axis = 0; axis < 3; ++axis)
    share *= (mesh.upper[axis] - mesh.lower[axis]) / (grid.upper()[axis] - grid.lower()[axis]);
  const auto outside = std::count_if(bodies.begin(), bodies.end(), [this](const Body& body) {
    return !is_inside(*this, body.place) && !leads_inside(*this, body.place, gravity) &&
           !leads_inside(*this, body.place, body.velocity);
  });
  const auto part = bodies.empty() ? 0.0 : static_cast<double>(outside) / static_cast<double>(bodies.size());
  if (part == 1 && !inserts)
    throw InputError(
        fmt::format("no particle is in the fluid, and none is on its way there: they are all beside the "
                    "fluid's mesh, which "
                    "goes from {}. Are both in metres, with the same origin ('scale' of blockMeshDict)?",
                    box_text(mesh)));
  if (part > most_outside)
    said.push_back(
        fmt::format("{:.0f} % of the particles are beside the fluid's mesh, which goes from {}: there they "
                    "feel nothing of it "
                    "(docs/warnings.md, Particles outside the fluid)",
                    100 * part, box_text(mesh)));
  if (share < least_of_grid)
    said.push_back(fmt::format(
        "the fluid's mesh, from {}, fills {:.2g} of bulk_grid: are both in metres, with the same origin "
        "(docs/warnings.md, Particles outside the fluid)?",
        box_text(mesh), share));
  return said;
}

std::string Look::too_fast() const {
  const Vec3 spacing = grid.spacing();
  const double smallest = std::min({spacing.x, spacing.y, spacing.z});
  const double window = parameters.coupling.longest_window();
  if (fastest * window <= smallest) return {};
  return fmt::format(
      "particle {} has {:.4g} m/s at the start, and crosses {:.2g} bulk cells in a window: what it gives to "
      "the "
      "fluid comes to cells that it has left. Shorter windows (coupling.window), or is it a mistake "
      "(docs/warnings.md, Fast particles)?",
      fastest_id, fastest, fastest * window / smallest);
}

enum class End { wall, inlet, other };  // inlet: one that gives a velocity

/// Of the mesh. Other: the fluid leaves through it, or no face lies in it.
End kind_of(const Flow& flow, int axis, double end, double extent) {
  constexpr double tolerance = 1e-6;
  bool open = false, any = false, walls = true;
  forAll(flow.mesh.boundary(), patch) {
    const Foam::fvPatch& here = flow.mesh.boundary()[patch];
    const bool through = here.coupled() || flow.p_rgh.boundaryField()[patch].fixesValue();
    if (Foam::isA<Foam::processorPolyPatch>(here.patch())) continue;
    for (const vector& centre : here.Cf())
      if (std::abs(centre[axis] - end) < tolerance * extent) {
        any = true;
        open = open || through;
        walls = walls && Foam::isA<Foam::wallPolyPatch>(here.patch());
      }
  }
  Foam::reduce(any, Foam::orOp<bool>());
  Foam::reduce(open, Foam::orOp<bool>());
  Foam::reduce(walls, Foam::andOp<bool>());
  return !any || open ? End::other : walls ? End::wall : End::inlet;
}

/// Beyond what they have at the start, m/s: spheres of the largest size and density, with a drag coefficient
/// below that of every law, in the lighter of the fluids that there are.
double Look::fastest_fall(double g) const {
  constexpr double least_drag = 0.4;
  const double first = flow.mixture.rho1().value(), second = flow.mixture.rho2().value();
  const double liquid = Foam::gAverage(flow.alpha.primitiveField());
  const double fluid = flow.scene.two_fluids ? std::min(first, second) : liquid > 0.5 ? first : second;
  if (parameters.forces.drag == DragLaw::none) return std::numeric_limits<double>::infinity();
  const double ratio = std::max(0.0, heaviest / fluid - (parameters.forces.pressure_gradient ? 1 : 0));
  return std::sqrt(4.0 / 3 * 2 * largest_radius * ratio * g / least_drag);
}

std::vector<std::string> Look::walls_inside() const {
  std::vector<std::string> said;
  const Vec3 spacing = grid.spacing();
  for (const Plane& wall : planes) {
    if (!ends(wall.axis)) continue;
    const double room = largest_radius > 0 ? largest_radius : 0.5 * spacing[wall.axis];
    const double low = mesh.lower[wall.axis], high = mesh.upper[wall.axis];
    if (wall.at <= low + room || wall.at >= high - room) continue;
    const double nearest = wall.at - low < high - wall.at ? low : high;
    if (kind_of(flow, wall.axis, nearest, high - low) != End::wall) continue;  // a sieve before an opening
    said.push_back(fmt::format(
        "the script's wall {0} ({1}plane {2:.4g}) stands inside the fluid's mesh, which goes from {3:.4g} to "
        "{4:.4g} "
        "m along {1}: particles end there, and the fluid goes on (docs/warnings.md, Walls of one program)",
        wall.fix, "xyz"[wall.axis], wall.at, low, high));
  }
  return said;
}

std::string Look::no_floor() const {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(gravity[other]) > std::abs(gravity[axis])) axis = other;
  const double g = std::abs(gravity[axis]), down = gravity[axis] < 0 ? -1 : 1;
  if (g == 0 || !ends(axis)) return {};
  const double low = mesh.lower[axis], high = mesh.upper[axis], end = down < 0 ? low : high;
  if (kind_of(flow, axis, end, high - low) == End::other || other_walls || any_held) return {};

  // Down from a place to the end, m; the highest place counts for what comes from an insertion.
  const double time = parameters.coupling.end_time;
  double deepest = 0;  // of the particles
  bool arrives = inserts;
  const double falling = fastest_fall(g);
  for (const Body& body : bodies) {
    const double way = down * (end - body.place[axis]);
    deepest = &body == &bodies.front() ? way : std::min(deepest, way);
    const double speed = std::max(0.0, down * body.velocity[axis]);
    arrives = arrives || (way > 0 && way < (speed + std::min(0.5 * g * time, falling)) * time);
  }
  if (bodies.empty()) deepest = 0.5 * (high - low);
  const Plane* below = nullptr;
  for (const Plane& wall : planes) {
    const double rise = down * (end - wall.at);  // above the end
    if (wall.axis != axis || rise > std::max(deepest, largest_radius)) continue;
    if (rise >= -std::max(largest_radius, 1e-6 * (high - low))) return {};
    if (!below || wall.at * -down > below->at * -down) below = &wall;
  }
  if (!arrives) return {};
  return fmt::format(
      "the fluid's mesh ends at {0} = {1:.4g} m, where no particle can leave it, and {2}: particles that "
      "come there "
      "fall out of the fluid (docs/warnings.md, Walls of one program)",
      "xyz"[axis], end,
      below ? fmt::format("the script's wall below, {}, is at {:.4g} m", below->fix, below->at)
            : std::string("the script has no wall there"));
}

Vec3 vec3_at(const std::vector<double>& numbers, std::size_t at) {
  return {numbers[at], numbers[at + 1], numbers[at + 2]};
}

}  // namespace

std::vector<std::string> first_look(const CaseParameters& parameters, const Flow& flow, const BulkGrid& grid,
                                    const nlohmann::json& particles) {
  if (!particles.contains("first_look")) return {};  // a partner that tests make up
  const nlohmann::json& seen = particles["first_look"];
  Look look{parameters, flow, grid, mesh_box(flow.mesh), flow.gravity.at(flow.time.value()), {}, {}};
  const auto numbers = seen.at("particles").get<std::vector<double>>();
  for (std::size_t at = 0; at + 5 < numbers.size(); at += 6)
    look.bodies.push_back({vec3_at(numbers, at), vec3_at(numbers, at + 3)});
  for (const nlohmann::json& plane : seen.at("planes"))
    look.planes.push_back({plane.at("fix"), plane.at("axis"), plane.at("at")});
  look.largest_radius = 0.5 * particles.at("max_diameter").get<double>();
  look.fastest = seen.at("fastest");
  look.fastest_id = seen.at("fastest_id");
  look.heaviest = seen.at("heaviest");
  look.inserts = particles.at("inserts_particles");
  look.any_held = seen.at("any_held");
  look.other_walls = seen.at("other_walls");

  std::vector<std::string> said = look.out_of_the_mesh();
  for (const std::string& text : look.walls_inside()) said.push_back(text);
  for (const std::string& text : {look.too_fast(), look.no_floor()})
    if (!text.empty()) said.push_back(text);
  return said;
}

}  // namespace demvof
