#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Own C++ files are as clang-format 14 writes them. Exit code 77 (skipped) without it: other versions write other lines.
cd "$(dirname "$0")/../.." || exit 2
if ! command -v clang-format >/dev/null; then
    echo "SKIPPED: clang-format is not installed (Debian: apt-get install clang-format)"
    exit 77
fi
if ! clang-format --version | grep -q 'version 14\.'; then
    echo "SKIPPED: $(clang-format --version) is not version 14"
    exit 77
fi
find coupler foam_side dem_side tests \( -name '*.cpp' -o -name '*.hpp' \) -print0 | xargs -0 clang-format --dry-run -Werror
