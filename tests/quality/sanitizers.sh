#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests pass under sanitizers: sanitizers.sh [asan] [tsan], by default both. asan: all programs under the address, leak
# and undefined-behaviour sanitizers; tsan: the coupler's unit and mpi tests under the thread sanitizer.
cd "$(dirname "$0")/../.." || exit 2
for preset in ${*:-asan tsan}; do
    cmake --preset "$preset" && cmake --build --preset "$preset" && ctest --preset "$preset" --no-tests=error || exit
done
