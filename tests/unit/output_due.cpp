// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/output_due.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace demvof {
namespace {

std::vector<long> due(double window, double interval, long windows) {
  std::vector<long> numbers;
  for (long n = 1; n <= windows; ++n)
    if (output_due(static_cast<double>(n - 1) * window, static_cast<double>(n) * window, interval))
      numbers.push_back(n);
  return numbers;
}

TEST(OutputDue, AtEveryMultiple) {
  EXPECT_EQ(due(5e-4, 2e-3, 12), (std::vector<long>{4, 8, 12}));
  EXPECT_EQ(due(1e-4, 0.05, 5000).size(), 10u);  // 0.05 is no whole number of 1e-4 in binary
}

TEST(OutputDue, AtTheFirstWindowThatReachesIt) {
  EXPECT_EQ(due(1, 1.5, 6), (std::vector<long>{2, 3, 5, 6}));
}

TEST(OutputDue, AtEveryWindowWhenTheIntervalIsShorter) {
  EXPECT_EQ(due(1, 0.3, 3), (std::vector<long>{1, 2, 3}));
}

TEST(OutputDue, TheNextDemStepThatReachesAMultiple) {
  EXPECT_EQ(next_output_step(0, 1e-5, 0.02), 2000);
  EXPECT_EQ(next_output_step(1999, 1e-5, 0.02), 2000);
  EXPECT_EQ(next_output_step(2000, 1e-5, 0.02), 4000);
  EXPECT_EQ(next_output_step(0, 1, 1.5), 2);  // where it is between two
  EXPECT_EQ(next_output_step(2, 1, 1.5), 3);
  EXPECT_EQ(next_output_step(7, 1, 0.3), 8);
  for (long output = 1, step = 0; output <= 5000; ++output) {  // 0.05 is no whole number of 1e-4 in binary
    step = next_output_step(step, 1e-4, 0.05);
    ASSERT_EQ(step, 500 * output);
    ASSERT_TRUE(output_due(static_cast<double>(step - 1) * 1e-4, static_cast<double>(step) * 1e-4, 0.05));
  }
}

TEST(OutputDue, NeverWithoutAnInterval) {
  EXPECT_TRUE(due(1, 0, 10).empty());
}

}  // namespace
}  // namespace demvof
