#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Looks for case files and handshakes that end the reader: fuzz.sh [SECONDS], by default an hour for each. What is found
# is left in build/fuzz; new texts that reach more of the code are kept in build/fuzz/found.
# -timeout: by the clock on the wall; on a busy machine a mutant that needs 0.1 s took 5.
cd "$(dirname "$0")/../.." || exit 2
seconds=${1:-3600}
cmake --preset fuzz && cmake --build --preset fuzz || exit
cd build/fuzz || exit
for target in case_file handshake; do
    mkdir -p found/$target
    bin/fuzz_$target found/$target ../../tests/fuzz/corpus/$target -max_total_time="$seconds" -timeout=30 \
        -rss_limit_mb=1024 -max_len=20000 -artifact_prefix=${target}_ || exit
done
