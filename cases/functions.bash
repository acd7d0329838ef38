# SPDX-License-Identifier: GPL-3.0-or-later
# What the Allrun scripts of the cases share; sourced by them.

# run_case DIR OPTIONS...: runs case.yaml of this folder into DIR with the given options of `demvof run`, and makes
# the report, also of a run that stopped early. In the source tree it builds first what is not built; elsewhere
# it takes the demvof of the installation that the cases lie in, or the one in PATH.
# Returns the exit code of `demvof run`, or Allwmake's if nothing could be built.
run_case() {
    local out=$1 status=0 root demvof
    shift
    root=$(cd ../.. && pwd)
    demvof=$root/../../bin/demvof
    if [ -x "$root/Allwmake" ]; then
        "$root/Allwmake" || return $?
        demvof=$root/build/release/bin/demvof
    elif [ ! -x "$demvof" ]; then
        demvof=demvof
    fi
    "$demvof" run case.yaml --out "$out" "$@" || status=$?
    if [ $status -ne 2 ]; then    # 2: wrong input, nothing was run
        "$demvof" report "$out" || [ $status -ne 0 ] || status=3
    fi
    return $status
}

# needs_value OPTION COUNT: ends the script when the option is the last word of its command line.
needs_value() {
    if [ "$2" -lt 2 ]; then
        echo "Allrun: $1 needs a value; see Allrun --help" >&2
        exit 2
    fi
}
