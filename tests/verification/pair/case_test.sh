#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A case of cases/ as it is shipped, and its check: case_test.sh DEMVOF PYTHON CASE OUT [OPTIONS OF demvof run]
demvof=$1 python=$2 case=$3 out=$4
shift 4
folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../../cases/$case" && pwd)
"$demvof" run "$folder/case.yaml" --out "$out" --force "$@" && "$python" "$folder/check.py" "$out"
