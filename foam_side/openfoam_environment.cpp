// SPDX-License-Identifier: GPL-3.0-or-later
// OpenFOAM's libraries look for their etc files while they are loaded, before main, and end the
// program without WM_PROJECT_DIR. Functions in .preinit_array run before any library is initialised:
// where the user has no OpenFOAM environment, this one starts the program once more with the
// packages' one. The C library is not initialised yet either, hence the bare arrays.

#include <unistd.h>

#include <cstring>

namespace {

char variable[] = "WM_PROJECT_DIR=/usr/share/openfoam";  // where Debian's packages keep them

void set_openfoam_environment(int, char** argv, char** environment) {
  constexpr int most = 4096;  // entries; a larger environment is left alone
  static char* extended[most + 2];
  int count = 0;
  for (; environment[count]; ++count) {
    if (count == most || std::strncmp(environment[count], variable, std::strlen("WM_PROJECT_DIR=")) == 0)
      return;
    extended[count] = environment[count];
  }
  extended[count] = variable;
  execve("/proc/self/exe", argv, extended);  // returns only if it cannot: OpenFOAM will say what is missing
}

__attribute__((section(".preinit_array"), used)) auto* const before_all_libraries = &set_openfoam_environment;

}  // namespace
