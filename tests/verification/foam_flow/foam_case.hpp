// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A small interFoam case of its own for each test: a copy of foam_case/ with some settings changed.

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "foam_side/flow.hpp"

namespace demvof::test {

using Settings = std::map<std::string, std::string>;  // keys of foam_case/system/settings

class FoamCase {
 public:
  /// Copies the case, meshes it with blockMesh. name: folder below the working directory. cut: pieces along
  /// x, y, z for the ranks of the test, of which the first does this; empty: the test has one.
  FoamCase(const std::string& name, const Settings& settings, const std::string& cut = "");

  const std::string& folder() const { return folder_; }
  /// Runs an OpenFOAM program on the case; throws if it fails.
  void run(const std::string& program) const;
  /// refinement: the mesh refines as fluid.refinement of a case file says.
  std::unique_ptr<Flow> open(const Scene& scene, const RefinementParameters* refinement = nullptr) const;

 private:
  void make(const Settings& settings, const std::string& cut) const;

  std::string folder_;
  bool parallel_;
};

/// Scene with the given parts on.
Scene scene(bool particles, bool porosity, bool surface_tension);

/// The stages of one step after advance_clock, in their order.
void do_step(Flow& flow);
/// Steps until the window or the run ends, calling after_step each time.
void advance(
    Flow& flow, const std::function<void()>& after_step = [] {});

void set_alpha(Flow& flow, const std::function<double(const vector&)>& alpha);
scalarField cell_values(const Flow& flow, const std::function<double(const vector&)>& value);
/// sum of eps alpha V, m3
double liquid_volume(const Flow& flow);
double largest_speed(const Flow& flow);  // m/s

}  // namespace demvof::test
