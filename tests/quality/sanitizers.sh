#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests pass under sanitizers: sanitizers.sh [asan] [tsan], by default both. All programs are built with them; asan:
# address, leak and undefined-behaviour sanitizers; tsan: the thread sanitizer, on the coupler's tests and on pairs that
# run on several ranks, go on, are stopped and killed. Its reports are in files: those of a process that is killed, or ends
# itself without its exit handlers, are seen by no test.
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
