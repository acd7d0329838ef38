// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/clumps.hpp"

#include <algorithm>
#include <cmath>

// LIGGGHTS's headers do not include what they need.
#include "atom.h"
#include "domain.h"
#include "fix_property_atom.h"
#include "lammps.h"
#include "modify.h"
// clang-format off
#include "multisphere.h"
#include "fix_multisphere.h"
// clang-format on

#include "coupler/base/sphere.hpp"

namespace demvof {
namespace {

LAMMPS_NS::FixMultisphere* find_multisphere(const LAMMPS_NS::LAMMPS& liggghts) {
  for (int i = 0; i < liggghts.modify->nfix; ++i)
    if (auto* found = dynamic_cast<LAMMPS_NS::FixMultisphere*>(liggghts.modify->fix[i])) return found;
  return nullptr;
}

/// Symmetric, of a clump: positive.
struct Symmetric {
  double xx, yy, zz, xy, xz, yz;
};

/// x of a x = b, 0 where a is.
Vec3 solution(const Symmetric& a, const Vec3& b) {
  const double scale = a.xx + a.yy + a.zz;
  if (!(scale > 0)) return {};
  const Vec3 first{a.xx, a.xy, a.xz}, second{a.xy, a.yy, a.yz}, third{a.xz, a.yz, a.zz};
  const double determinant = dot(first, cross(second, third));
  return 1 / determinant *
         (b.x * cross(second, third) + b.y * cross(third, first) + b.z * cross(first, second));
}

}  // namespace

Clumps::Clumps(LAMMPS_NS::LAMMPS& liggghts) : liggghts_(liggghts), fix_(find_multisphere(liggghts)) {}

bool Clumps::has(int i) const {
  return fix_ && fix_->belongs_to(i) >= 0;
}

long Clumps::count() const {
  return fix_->n_body();
}

Clumps::Spheres Clumps::spheres() {
  const LAMMPS_NS::Atom& atom = *liggghts_.atom;
  LAMMPS_NS::Multisphere& clumps = fix_->data();
  const double* weight = fix_->use_volumeweight() ? fix_->get_volumeweight()->vector_atom : nullptr;
  spheres_.assign(static_cast<std::size_t>(atom.nlocal), {});
  masses_.assign(atom.rmass, atom.rmass + atom.nlocal);
  weighted_volumes_.assign(static_cast<std::size_t>(clumps.n_body()), 0.0);
  for (int i = 0; i < atom.nlocal; ++i) {
    SphereOfClump& sphere = spheres_[i];
    sphere.volume = sphere_volume(atom.radius[i]);
    sphere.diameter = 2 * atom.radius[i];
    if (fix_->belongs_to(i) < 0) continue;
    sphere.clump = clumps.map(fix_->belongs_to(i));
    if (weight) sphere.volume *= weight[i];
    weighted_volumes_[sphere.clump] += sphere.volume;
  }
  for (int i = 0; i < atom.nlocal; ++i)
    if (SphereOfClump& sphere = spheres_[i]; sphere.clump >= 0)
      sphere.share = sphere.volume / weighted_volumes_[sphere.clump];
  for (int pass = 0; pass < 3; ++pass) balance();
  find_bodies();
  for (int i = 0; i < atom.nlocal; ++i) {
    SphereOfClump& sphere = spheres_[i];
    if (sphere.clump < 0) continue;
    const double volume = clumps.volume(sphere.clump);
    sphere.volume = sphere.share * volume;
    sphere.diameter = std::cbrt(6 * volume / pi);
    double velocity[3];
    clumps.vcm(velocity, sphere.clump);
    sphere.velocity = {velocity[0], velocity[1], velocity[2]};
    sphere.arm = from_centre(i) - off_centre_[sphere.clump];
    sphere.own_velocity = sphere.velocity + cross(bodies_[sphere.clump].spin(), sphere.arm);
    masses_[i] = sphere.share * clumps.mass(sphere.clump);
  }
  return {spheres_.data(), masses_.data(), bodies_.data(), off_centre_.data()};
}

Vec3 Clumps::from_centre(int i) const {
  const double* place = liggghts_.atom->x[i];
  double centre[3];
  fix_->data().xcm(centre, spheres_[i].clump);
  Vec3 r{place[0] - centre[0], place[1] - centre[1], place[2] - centre[2]};
  liggghts_.domain->minimum_image(r.x, r.y, r.z);
  return r;
}

/// Spins go by the momentum and the axes of the same time; those that LIGGGHTS keeps, by axes of half a step
/// before.
void Clumps::find_bodies() {
  LAMMPS_NS::Multisphere& clumps = fix_->data();
  const auto count = static_cast<std::size_t>(clumps.n_body());
  bodies_.assign(count, {});
  off_centre_.assign(count, {});
  for (int i = 0; i < liggghts_.atom->nlocal; ++i)
    if (const SphereOfClump& sphere = spheres_[i]; sphere.clump >= 0)
      off_centre_[sphere.clump] += sphere.share * from_centre(i);
  double* const* inertia = clumps.extract_double_vector("inertia");
  double* const* axes[3] = {clumps.extract_double_vector("ex_space"),
                            clumps.extract_double_vector("ey_space"),
                            clumps.extract_double_vector("ez_space")};
  auto& turned = *clumps.prop().getElementProperty<LAMMPS_NS::VectorContainer<bool, 3>>("tflag");
  for (std::size_t n = 0; n < count; ++n) {
    RigidBody& body = bodies_[n];
    double momentum[3];
    clumps.angmom(momentum, static_cast<int>(n));
    body.angular_momentum = {momentum[0], momentum[1], momentum[2]};
    body.mass = clumps.mass(static_cast<int>(n));
    for (int i = 0; i < 3; ++i) {
      body.inertia[i] = inertia[n][i];
      body.axis[i] = {axes[i][n][0], axes[i][n][1], axes[i][n][2]};
      body.turned[i] = turned(static_cast<int>(n))[i];
    }
  }
}

/// s <- s (1 + b.r), r from the centre of mass, with b such that sum of s r = 0.
void Clumps::balance() {
  const LAMMPS_NS::Atom& atom = *liggghts_.atom;
  struct Moments {
    Vec3 first, slope;                                      // sum of s r, m; b, 1/m
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  // sum of s r r, m2
  };
  std::vector<Moments> moments(weighted_volumes_.size());
  for (int i = 0; i < atom.nlocal; ++i) {
    if (spheres_[i].clump < 0) continue;
    Moments& sum = moments[spheres_[i].clump];
    const double s = spheres_[i].share;
    const Vec3 r = from_centre(i);
    sum.first += s * r;
    sum.xx += s * r.x * r.x, sum.yy += s * r.y * r.y, sum.zz += s * r.z * r.z;
    sum.xy += s * r.x * r.y, sum.xz += s * r.x * r.z, sum.yz += s * r.y * r.z;
  }
  for (Moments& sum : moments) {
    // Spheres in a row or in a plane do not tell of the rest: there b is without effect.
    const double little = 1e-9 * (sum.xx + sum.yy + sum.zz);
    sum.slope =
        -solution({sum.xx + little, sum.yy + little, sum.zz + little, sum.xy, sum.xz, sum.yz}, sum.first);
  }
  constexpr double least = 1e-6;  // a share keeps its sign; the next pass makes up for it
  for (int i = 0; i < atom.nlocal; ++i) {
    if (spheres_[i].clump < 0) continue;
    double& share = spheres_[i].share;
    share = std::max(least, share * (1 + dot(moments[spheres_[i].clump].slope, from_centre(i))));
  }
  std::vector<double> whole(moments.size(), 0.0);
  for (const SphereOfClump& sphere : spheres_)
    if (sphere.clump >= 0) whole[sphere.clump] += sphere.share;
  for (SphereOfClump& sphere : spheres_)
    if (sphere.clump >= 0) sphere.share /= whole[sphere.clump];
}

void Clumps::renew_forces() {
  fix_->data().reset_forces(true);
  fix_->calc_force(true);
}

}  // namespace demvof
