// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/window_steps.hpp"

#include <gtest/gtest.h>

#include <string>

#include "coupler/base/errors.hpp"

namespace {

using demvof::require_whole_steps;
using demvof::steps_per_window;

TEST(WindowSteps, CountsWholeStepsThroughTheRoundOffOfDecimals) {
  EXPECT_EQ(steps_per_window(2e-4, 1e-5), 20);
  EXPECT_EQ(steps_per_window(0.3, 0.1), 3);
  EXPECT_EQ(steps_per_window(1e-5, 1e-5), 1);
  EXPECT_EQ(steps_per_window(1.0, 1e-6), 1000000);
}

std::string complaint(double window, double step) {
  try {
    steps_per_window(window, step);
  } catch (const demvof::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(WindowSteps, NamesBothValuesAndTheNearestWindows) {
  const std::string between = complaint(2.05e-4, 1e-5);
  for (const char* part : {"coupling.window", "0.000205", "1e-05", "0.0002 or 0.00021"})
    EXPECT_NE(between.find(part), std::string::npos) << part << " is not in: " << between;

  const std::string below = complaint(4e-6, 1e-5);
  for (const char* part : {"4e-06", "that fit: 1e-05 s"})
    EXPECT_NE(below.find(part), std::string::npos) << part << " is not in: " << below;
}

TEST(WindowSteps, OrARunThatEndsBetweenTwo) {
  EXPECT_NO_THROW(require_whole_steps(0.3, 1e-4));
  try {
    require_whole_steps(0.30005, 1e-4);
    FAIL();
  } catch (const demvof::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("coupling.end_time: 0.30005 s"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("0.3 or 0.3001"), std::string::npos);
  }
}

TEST(WindowSteps, RefusesAWindowThatIsNearlyRight) {
  EXPECT_NE(complaint(2e-4 * (1 + 1e-8), 1e-5), "no error");
  EXPECT_EQ(steps_per_window(2e-4 * (1 + 1e-10), 1e-5), 20);
}

}  // namespace
