// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/left_over.hpp"

#include <gtest/gtest.h>

namespace demvof {

static bool operator==(const Vec3& a, const Vec3& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

namespace {

BulkParticles with_solid(double solid_volume) {
  BulkParticles sum;
  sum.solid_volume = solid_volume;
  return sum;
}

/// Cells 2, 4, 6 hold particles with solid volumes 1, 2, 4; a window in two parts.
struct Window {
  Window() {
    left_over.collect({{1, 2, 4}, {{9, 9, 9}, {1, 0, 0}, {0, 2, 0}}}, particles);
    left_over.collect({{2, 6, 8}, {{2, 0, 0}, {0, 0, 4}, {9, 9, 9}}}, particles);
    left_over.end_window(particles);
  }
  CellValues<BulkParticles> particles{{2, 4, 6}, {with_solid(1), with_solid(2), with_solid(4)}};
  LeftOver left_over;
};

Vec3 sum(const CellValues<LeftOver::Owed>& owed) {
  Vec3 total;
  for (const LeftOver::Owed& cell : owed.values) total += cell.impulse;
  return total;
}

TEST(LeftOver, AddsUpWhereParticlesAre) {
  const Window window;
  const auto& owed = window.left_over.owed();
  ASSERT_EQ(owed.cells, (std::vector<CellId>{2, 4, 6}));
  EXPECT_EQ(owed.values[0].impulse, (Vec3{3, 0, 0}));
  EXPECT_EQ(owed.values[1].impulse, (Vec3{0, 2, 0}));
  EXPECT_EQ(owed.values[2].impulse, (Vec3{0, 0, 4}));
  EXPECT_EQ(owed.values[2].solid_volume, 4);
}

TEST(LeftOver, IsHandedOverOnceWithTheFluidOfItsCell) {
  Window window;
  CellValues<BulkFluid> fluid{{2, 3, 6}, std::vector<BulkFluid>(3)};
  window.left_over.hand_over(fluid);
  EXPECT_EQ(fluid.values[0].left_over, (Vec3{3, 0, 0}));
  EXPECT_EQ(fluid.values[1].left_over, Vec3{});
  EXPECT_EQ(fluid.values[2].left_over, (Vec3{0, 0, 4}));
  CellValues<BulkFluid> next{{2, 3, 6}, std::vector<BulkFluid>(3)};
  window.left_over.hand_over(next);
  EXPECT_EQ(next.values[0].left_over, Vec3{});
}

TEST(LeftOver, IsOwedAnewAfterEachWindow) {
  Window window;
  CellValues<BulkFluid> fluid{{2, 4, 6}, std::vector<BulkFluid>(3)};
  window.left_over.hand_over(fluid);
  window.left_over.collect({{4}, {{7, 0, 0}}}, window.particles);
  window.left_over.end_window(window.particles);
  EXPECT_EQ(sum(window.left_over.owed()), (Vec3{7, 0, 0}));
}

TEST(LeftOver, WhatNobodyTakesGoesBackToTheFluid) {
  Window window;
  // Cell 2: as many as before; 4: a quarter of it; 6: nobody is left; 9: others.
  CellValues<BulkParticles> moved{{2, 4, 9}, {with_solid(1), with_solid(0.5), with_solid(3)}};
  moved.values[1].drag_impulse = {0, 10, 0};
  const Vec3 owed_before = sum(window.left_over.owed());
  window.left_over.return_to_fluid(moved);
  ASSERT_EQ(moved.cells, (std::vector<CellId>{2, 4, 6, 9}));
  EXPECT_EQ(moved.values[0].drag_impulse, Vec3{});
  EXPECT_EQ(moved.values[1].drag_impulse, (Vec3{0, 10 - 1.5, 0}));
  EXPECT_EQ(moved.values[2].drag_impulse, (Vec3{0, 0, -4}));
  EXPECT_EQ(moved.values[2].solid_volume, 0);
  EXPECT_EQ(moved.values[3].solid_volume, 3);
  Vec3 returned{0, -10, 0};
  for (const BulkParticles& cell : moved.values) returned += cell.drag_impulse;
  EXPECT_EQ(sum(window.left_over.owed()) - returned, owed_before);
  CellValues<BulkFluid> fluid{{2, 4, 6}, std::vector<BulkFluid>(3)};
  window.left_over.hand_over(fluid);
  EXPECT_EQ(fluid.values[1].left_over, (Vec3{0, 0.5, 0}));
  EXPECT_EQ(fluid.values[2].left_over, Vec3{});
}

TEST(LeftOver, WhatTheFluidHasLeftGoesBackToIt) {
  Window window;
  CellValues<BulkFluid> fluid{{2, 6}, std::vector<BulkFluid>(2)};  // no such fluid in cell 4 any more
  window.left_over.hand_over(fluid);
  EXPECT_EQ(sum(window.left_over.owed()), (Vec3{0, 2, 0}));
  CellValues<BulkParticles> moved{{4}, {with_solid(20)}};
  window.left_over.return_to_fluid(moved);
  EXPECT_EQ(moved.values[0].drag_impulse, (Vec3{0, -2, 0}));
  EXPECT_EQ(sum(window.left_over.owed()), Vec3{});
}

TEST(LeftOver, WhatConcurrentParticlesWereNotToldOutlastsTheWindow) {
  Window window;
  CellValues<BulkFluid> fluid{{2, 6}, std::vector<BulkFluid>(2)};  // no such fluid in cell 4 any more
  window.left_over.hand_over(fluid);
  const CellValues<BulkParticles> next{{2, 6}, {with_solid(1), with_solid(4)}};
  window.left_over.collect({{6}, {{0, 0, 5}}}, next);
  window.left_over.end_window(next);
  ASSERT_EQ(window.left_over.owed().cells, (std::vector<CellId>{2, 4, 6}));
  EXPECT_EQ(sum(window.left_over.owed()), (Vec3{0, 2, 5}));
  CellValues<BulkParticles> moved{{6}, {with_solid(4)}};
  window.left_over.return_to_fluid(moved);
  ASSERT_EQ(moved.cells, (std::vector<CellId>{4, 6}));
  EXPECT_EQ(moved.values[0].drag_impulse, (Vec3{0, -2, 0}));
  EXPECT_EQ(sum(window.left_over.owed()), (Vec3{0, 0, 5}));
}

TEST(LeftOver, GoesOnFromAState) {
  const Window window;
  LeftOver again;
  again.go_on_from(window.left_over.owed());
  CellValues<BulkFluid> fluid{{4}, std::vector<BulkFluid>(1)};
  again.hand_over(fluid);
  EXPECT_EQ(fluid.values[0].left_over, (Vec3{0, 2, 0}));
}

TEST(LeftOver, NothingWithoutParticles) {
  LeftOver left_over;
  left_over.collect({{1, 2}, {{1, 1, 1}, {2, 2, 2}}}, {});
  left_over.end_window({});
  EXPECT_TRUE(left_over.owed().cells.empty());
}

}  // namespace
}  // namespace demvof
