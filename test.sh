#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs missing packages, builds everything, runs all tests, and compiles the benchmarks. Arguments are passed to ctest:
# ./test.sh -R laws
#
# ./test.sh --strict checks what a build does not: it compiles everything in build-strict without precompiled headers and
# without batches of files, so that each file shows what it fails to include, with all warnings, those of memory errors
# included; and it checks the formatting of all sources, the rules of the source tree, and with clang-tidy (.clang-tidy) the
# sources that differ from the commit before; with EXTREMAL_TIDY=all, which takes about an hour on two cores, all of them.
#
# ./test.sh --sanitize address,undefined (or thread) builds everything with these sanitizers of the compiler, in a folder of
# its own, and runs all tests; the first report of one is a failure. What is not ours to mend is suppressed by name, with the
# reason, in tests/sanitizers. Takes about five hours on two cores: quadruple precision takes 25 times as long, the rest ten.
set -euo pipefail
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/.ci/prepare.sh"

# The sources of the program that clang-tidy is to look at, each ended by a null character.
sources_to_tidy() {
    local folders=(engine library ui app)
    if [ "${EXTREMAL_TIDY:-changed}" = all ]; then
        find "${folders[@]}" -name '*.cpp' -print0
    elif git rev-parse --verify --quiet HEAD~1 >/dev/null 2>&1; then
        git diff --name-only --diff-filter=d -z HEAD~1 -- "${folders[@]/%//*.cpp}"
    else
        say "No history here: clang-tidy is left out; EXTREMAL_TIDY=all runs it on all sources."
    fi
}

strict() {
    configure build-strict -DEXTREMAL_PCH=OFF -DEXTREMAL_UNITY=OFF
    cd "$root"
    find engine library ui app tests -name '*.[ch]pp' -print0 | xargs -0 clang-format --dry-run -Werror
    cmake -DROOT="$root" -P tests/tree/check_tree.cmake
    ninja -C build-strict all bench >&2
    sources_to_tidy | xargs -0 -r -n 1 -P "$(nproc)" clang-tidy -p build-strict --quiet
    ctest --test-dir build-strict --output-on-failure -L tree "$@"
}

sanitize() {
    local sanitizers=$1 folder="build-${1//,/-}" lists="$root/tests/sanitizers"
    export ASAN_OPTIONS="detect_stack_use_after_return=1:strict_string_checks=1"
    export LSAN_OPTIONS="suppressions=$lists/leaks.txt:print_suppressions=0"
    export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1"
    export TSAN_OPTIONS="halt_on_error=1:second_deadlock_stack=1:suppressions=$lists/races.txt"
    export QTEST_FUNCTION_TIMEOUT=3000000  # milliseconds
    configure "$folder" -DEXTREMAL_SANITIZE="$sanitizers" -DEXTREMAL_UNITY=ON -DEXTREMAL_BENCH=OFF
    ninja -C "$root/$folder" >&2
    ctest --test-dir "$root/$folder" --parallel 2 --output-on-failure "${@:2}"
}

install_packages
if [ "${1:-}" = "--sanitize" ]; then
    [[ "${2:-}" =~ ^(address|undefined|thread)(,(address|undefined))*$ ]] || {
        say "./test.sh --sanitize needs sanitizers: address,undefined or thread"
        exit 2
    }
    sanitize "${@:2}"
    exit
fi
if [ "${1:-}" = "--strict" ]; then
    strict "${@:2}"
    exit
fi
configure
ninja -C "$root/build" >&2
ctest --test-dir "$root/build" --parallel 2 --output-on-failure "$@"
ninja -C "$root/build" bench >&2
