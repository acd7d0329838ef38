// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/decompose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>

#include "coupler/base/errors.hpp"
#include "coupler/cli/child_process.hpp"
#include "coupler/cli/prepare.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

constexpr auto dictionary = "system/decomposeParDict";

std::string text_of(const Cut& cut) {
  return fmt::format("({} {} {})", cut[0], cut[1], cut[2]);
}

ChildOutput ask(const fs::path& fluid, const std::vector<std::string>& command) {
  ChildOptions options;
  options.directory = fluid;
  options.environment = foam_environment();
  return output_of(command, options);
}

/// An entry of the dictionary as OpenFOAM reads it; nothing when it is not there.
std::optional<std::string> entry(const fs::path& fluid, const std::string& name) {
  const ChildOutput output = ask(fluid, {"foamDictionary", "-entry", name, "-value", dictionary});
  if (output.code != 0) return std::nullopt;
  const std::string blanks = " \t\n";
  const auto begin = output.text.find_first_not_of(blanks);
  if (begin == std::string::npos) return "";
  return output.text.substr(begin, output.text.find_last_not_of(blanks) + 1 - begin);
}

/// Sides of the box around the mesh, m.
std::array<double, 3> mesh_sides(const fs::path& fluid) {
  const std::string text = ask(fluid, {"checkMesh", "-noTopology", "-constant"}).text;
  const std::string words = "domain bounding box";
  std::array<double, 3> lower{}, upper{};
  const auto place = text.find(words);
  if (place == std::string::npos ||
      std::sscanf(text.c_str() + place + words.size(), " (%lf %lf %lf) (%lf %lf %lf)", &lower[0], &lower[1],
                  &lower[2], &upper[0], &upper[1], &upper[2]) != 6)
    throw InputError(fmt::format("checkMesh tells no size of the mesh in {}: does fluid.prepare make one?",
                                 fluid.string()));
  return {upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]};
}

/// Where the dictionary keeps the pieces along x, y, z for the method `simple` or `hierarchical`.
std::optional<std::string> place_of_cut(const fs::path& fluid, const std::string& method) {
  for (const std::string& name : {method + "Coeffs/n", std::string("coeffs/n")})
    if (entry(fluid, name)) return name;
  return std::nullopt;
}

void write_simple(const fs::path& fluid, const Cut& cut) {
  const int ranks = cut[0] * cut[1] * cut[2];
  std::ofstream(fluid / dictionary) << fmt::format(
      "FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class dictionary;\n    object "
      "decomposeParDict;\n}}\n"
      "numberOfSubdomains {};\nmethod simple;\ncoeffs {{ n {}; }}\n",
      ranks, text_of(cut));
}

}  // namespace

Cut cut_along_longest(const std::array<double, 3>& sides, int ranks) {
  Cut cut{1, 1, 1};
  cut[std::max_element(sides.begin(), sides.end()) - sides.begin()] = ranks;
  return cut;
}

Cut cut_like(const Cut& given, const std::array<double, 3>& sides, int ranks) {
  Cut best = cut_along_longest(sides, ranks);  // unless there is one in the given directions
  double least = HUGE_VAL;
  // How unequal the pieces' proportions are to those of the given cut, over the directions that it cuts.
  const auto departure = [&](const Cut& cut) {
    double sum = 0, squares = 0;
    int directions = 0;
    for (int d = 0; d < 3; ++d) {
      if (given[d] < 2) continue;
      const double ratio = std::log(static_cast<double>(cut[d]) / given[d]);
      sum += ratio;
      squares += ratio * ratio;
      ++directions;
    }
    return squares - sum * sum / directions;
  };
  // Among equals, more pieces along longer sides.
  const auto across = [&](const Cut& cut) {
    return cut[0] * sides[0] + cut[1] * sides[1] + cut[2] * sides[2];
  };
  const auto allowed = [&](int d, int pieces) { return pieces == 1 || given[d] > 1; };
  for (int x = 1; x <= ranks; ++x)
    for (int y = 1; x * y <= ranks; ++y) {
      if (ranks % (x * y) != 0) continue;
      const Cut cut{x, y, ranks / (x * y)};
      if (!allowed(0, cut[0]) || !allowed(1, cut[1]) || !allowed(2, cut[2])) continue;
      const double departs = departure(cut);
      const bool longer = departs < least + 1e-12 && across(cut) > across(best);
      if (departs < least - 1e-12 || longer) {
        least = departs;
        best = cut;
      }
    }
  return best;
}

void decompose(const fs::path& fluid, int ranks, const std::string& command, const RunLogged& run,
               const std::function<void(const std::string&)>& say) {
  const auto change = [&](const std::string& what) {
    say(fmt::format("preparing the fluid case: {}: {}", dictionary, what));
  };
  const auto set = [&](const std::string& name, const std::string& value) {
    run(fmt::format("foamDictionary -entry {} -set '{}' {}", name, value, dictionary));
  };
  if (!fs::exists(fluid / dictionary)) {
    const Cut cut = cut_along_longest(mesh_sides(fluid), ranks);
    write_simple(fluid, cut);
    change(fmt::format("there is none; made with method simple, {} parts along the mesh's longest side, n {}",
                       ranks, text_of(cut)));
    return run(command);
  }

  set("numberOfSubdomains", std::to_string(ranks));
  const std::string method = entry(fluid, "method").value_or("");
  if (method == "simple" || method == "hierarchical") {
    const auto place = place_of_cut(fluid, method);
    Cut given{1, 1, 1};
    if (place) std::sscanf(entry(fluid, *place)->c_str(), "( %d %d %d", &given[0], &given[1], &given[2]);
    if (given[0] * given[1] * given[2] != ranks) {
      const Cut cut = cut_like(given, mesh_sides(fluid), ranks);
      if (place)
        set(*place, text_of(cut));
      else
        set("coeffs", fmt::format("{{ n {}; }}", text_of(cut)));
      change(fmt::format("n {} is not for {} ranks; changed to {} in the copy", text_of(given), ranks,
                         text_of(cut)));
    }
    return run(command);
  }
  try {
    run(command);
  } catch (const InputError& error) {
    // Packages have a stub in place of a library of another project (scotch, metis, kahip); it says so when
    // called.
    if (std::string(error.what()).find("stub") == std::string::npos) throw;
    const Cut cut = cut_along_longest(mesh_sides(fluid), ranks);
    write_simple(fluid, cut);
    change(fmt::format(
        "method {} is a stub in this OpenFOAM; changed in the copy to method simple, {} parts along "
        "the mesh's longest side, n {}",
        method, ranks, text_of(cut)));
    run(command);
  }
}

}  // namespace demvof
