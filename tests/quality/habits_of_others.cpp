// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded in front of all libraries by the preset asan, for what MPI's and the solvers' libraries do.
#include <dlfcn.h>

#include <cstddef>

extern "C" {
// No library is unloaded, so that at the end of a program the leak sanitizer still knows whose memory it is
// that their modules keep (leaks_of_others.txt names them).
int dlclose(void*) {
  return 0;
}

void __asan_poison_memory_region(const volatile void*, std::size_t) __attribute__((weak));
}

// The distribution's libOpenFOAM reads an array of doubles in pairs, and so 8 bytes beyond one of odd length
// (Foam::sqr of a Field<vector>): where the allocator's memory ends there the program would. Arrays get room
// behind them, which the programs' own code may not touch.
void* operator new[](std::size_t size) {
  using Allocate = void* (*)(std::size_t);
  static const auto allocate = reinterpret_cast<Allocate>(dlsym(RTLD_NEXT, "_Znam"));
  constexpr std::size_t room = 16;
  auto* const array = static_cast<char*>(allocate(size + room));
  if (__asan_poison_memory_region) __asan_poison_memory_region(array + size, room);
  return array;
}
