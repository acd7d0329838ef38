#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests pass under sanitizers: sanitizers.sh [asan] [tsan], by default both. All programs are built with them; asan:
# address, leak and undefined-behaviour sanitizers; tsan: the thread sanitizer, on the coupler's tests and on pairs that
# run on several ranks, go on, are stopped and killed. Any report fails, also of a process whose exit code nobody sees.
cd "$(dirname "$0")/../.." || exit 2
shopt -s nullglob
for preset in ${*:-asan tsan}; do
    rm -f "build/$preset"/Testing/report.*
    cmake --preset "$preset" && cmake --build --preset "$preset" && ctest --preset "$preset" --no-tests=error
    status=$? reports=("build/$preset"/Testing/report.*)
    if [ ${#reports[@]} -gt 0 ]; then
        cat "${reports[@]}"
        status=1
    fi
    [ $status = 0 ] || exit $status
done
