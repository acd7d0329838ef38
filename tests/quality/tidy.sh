#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tidy.sh BUILD FOLDER...: clang-tidy finds nothing in the source files of the folders, as BUILD compiles them.
# Exit code 77 (skipped) without clang-tidy.
build=$1
shift
cd "$(dirname "$0")/../.." || exit 2
if ! command -v clang-tidy >/dev/null; then
    echo "SKIPPED: clang-tidy is not installed (Debian: apt-get install clang-tidy)"
    exit 77
fi
find "$@" -name '*.cpp' -print0 | xargs -0 -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet \
    --extra-arg-before=-include --extra-arg-before="$PWD/tests/quality/clang_reads_openfoam.hpp" 2>/dev/null
