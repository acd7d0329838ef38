// SPDX-License-Identifier: GPL-3.0-or-later
// What the partner says at the handshake may be any bytes: it is understood or refused.
#include "coupler/link/handshake.hpp"

#include <cfenv>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/link/text_message.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace demvof;
  static const std::vector<HandshakeItem> mine = {{"version", "0.1.0"},
                                                  {"gravity, m/s2", "0 0 -9.81", 1e-6},
                                                  {"largest", "1.7e308 0 5e-324", 1e-6},
                                                  {"number of bulk cells", "256"}};
  feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);  // as OpenFOAM does
  std::vector<std::uint64_t> words(size / 8);
  if (!words.empty()) std::memcpy(words.data(), data, 8 * words.size());
  try {
    const Handshake said = read_handshake(text_in(words));
    // Whichever side compares says the same.
    if (disagreements(mine, said.items).size() != disagreements(said.items, mine).size()) std::abort();
    const Handshake again = read_handshake(to_text(said));
    if (again.items.size() != said.items.size()) std::abort();
  } catch (const InputError&) {
  } catch (const RunError&) {
  }
  fedisableexcept(FE_ALL_EXCEPT);  // libFuzzer computes, too
  return 0;
}
