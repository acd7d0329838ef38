#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The coupler's unit and mpi tests pass under the address and undefined-behaviour sanitizers.
cd "$(dirname "$0")/../.." || exit 2
cmake --preset asan && cmake --build --preset asan && ctest --preset asan --no-tests=error
