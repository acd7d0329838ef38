// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded in front of the C library: no library is unloaded, so that at the end of a program the leak
// sanitizer still knows whose memory it is that MPI's and the solvers' modules keep (leaks_of_others.txt
// names them).
extern "C" int dlclose(void*) {
  return 0;
}
