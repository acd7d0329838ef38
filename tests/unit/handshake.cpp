// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/handshake.hpp"

#include <gtest/gtest.h>

#include <cfenv>

#include "coupler/base/errors.hpp"
#include "coupler/link/text_message.hpp"

namespace demvof {
namespace {

bool agree(const HandshakeItem& fluid, const HandshakeItem& particles) {
  return disagreements({fluid}, {particles}).empty();
}

TEST(Handshake, ComparesNumbersWithinTheTolerance) {
  EXPECT_TRUE(agree({"g", "0 0 -9.81", 1e-6}, {"g", "0.0 0 -9.810001", 1e-6}));
  EXPECT_FALSE(agree({"g", "0 0 -9.81", 1e-6}, {"g", "0 0 -9.8101", 1e-6}));
  EXPECT_FALSE(
      agree({"g", "0 0 -9.81", 1e-6}, {"g", "1e-9 0 -9.81", 1e-6}));  // relative: not even a little x
  EXPECT_TRUE(agree({"g", "0", 1e-6}, {"g", "1e-301", 1e-6}));
}

TEST(Handshake, TheLargerToleranceCounts) {
  EXPECT_TRUE(agree({"dt", "1e-4", 1e-12}, {"dt", "1.0001e-4", 1e-3}));
  EXPECT_TRUE(agree({"dt", "1.0001e-4", 1e-3}, {"dt", "1e-4", 1e-12}));
}

TEST(Handshake, ComparesTextExactlyWithoutATolerance) {
  EXPECT_TRUE(agree({"hash", "0a1b", -1}, {"hash", "0a1b", -1}));
  EXPECT_FALSE(agree({"hash", "1.0", -1}, {"hash", "1", -1}));
}

TEST(Handshake, DoesNotReadTextAsNumbers) {
  // OpenFOAM traps floating-point exceptions: a hash that begins like a huge number ended the run.
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_TRUE(agree({"hash", "5e1234ab", -1}, {"hash", "5e1234ab", -1}));
  EXPECT_FALSE(std::fetestexcept(FE_OVERFLOW));
}

TEST(Handshake, NumbersBeyondAllSizeAreNoReasonToDie) {
  feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);  // as OpenFOAM does
  EXPECT_FALSE(agree({"g", "1.7e308", 1e-6}, {"g", "-1.7e308", 1e-6}));
  EXPECT_FALSE(agree({"g", "1", 1e-6}, {"g", "1e999", 1e-6}));
  EXPECT_THROW(read_handshake(R"({"items": [["g", "1", 1e999]], "facts": "{}"})"), InputError);
  fedisableexcept(FE_ALL_EXCEPT);
}

TEST(Handshake, IsReadBackOrRefused) {
  const Handshake said = read_handshake(to_text({{{"g", "1 2", 1e-6}, {"version", "0.1"}}, "{}"}));
  ASSERT_EQ(said.items.size(), 2u);
  EXPECT_EQ(said.items[0].value, "1 2");
  EXPECT_EQ(said.items[1].tolerance, -1);
  EXPECT_EQ(said.facts, "{}");
  for (const char* wrong : {"", "[]", "{}", R"({"items": [[1, 2]], "facts": ""})", R"({"items": [], "fac)"})
    EXPECT_THROW(read_handshake(wrong), InputError) << wrong;
  EXPECT_EQ(text_in(words_of("nine bytes")), "nine bytes");
  EXPECT_THROW(text_in({}), RunError);
  EXPECT_THROW(text_in({9, 0}), RunError);
  EXPECT_THROW(text_in({~0ULL, 0}), RunError);
}

TEST(Handshake, NumbersOfDifferentCountOrWithText) {
  EXPECT_FALSE(agree({"box", "0 0 1", 1}, {"box", "0 0", 1}));
  EXPECT_FALSE(agree({"box", "0.2 m", 1}, {"box", "0.2", 1}));
  EXPECT_FALSE(agree({"box", "nan", 1}, {"box", "1", 1}));
}

TEST(Handshake, NamesBothValuesAndSkipsWhatOneSideGives) {
  const auto lines = disagreements({{"version", "1.0", -1}, {"mesh", "48000", 0}},
                                   {{"beads", "3883", 0}, {"version", "1.1", -1}});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "version: foam_side has '1.0', dem_side has '1.1'");
}

}  // namespace
}  // namespace demvof
