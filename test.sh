#!/usr/bin/env bash
# Installs missing packages, builds everything, runs all tests, and compiles the benchmarks. Arguments are passed to ctest:
# ./test.sh -R laws
#
# ./test.sh --strict checks what a build does not: it compiles everything in build-strict without precompiled headers and
# without batches of files, so that each file shows what it fails to include, with all warnings, those of memory errors
# included; and it checks the formatting of all sources and the rules of the source tree.
set -euo pipefail
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/.ci/prepare.sh"

strict() {
    configure build-strict -DEXTREMAL_PCH=OFF -DEXTREMAL_UNITY=OFF
    cd "$root"
    find engine ui app tests -name '*.[ch]pp' -print0 | xargs -0 clang-format --dry-run -Werror
    cmake -DROOT="$root" -P tests/tree/check_tree.cmake
    ninja -C build-strict all bench >&2
    ctest --test-dir build-strict --output-on-failure -L tree "$@"
}

install_packages
if [ "${1:-}" = "--strict" ]; then
    strict "${@:2}"
    exit
fi
configure
ninja -C "$root/build" >&2
ctest --test-dir "$root/build" --parallel 2 --output-on-failure "$@"
ninja -C "$root/build" bench >&2
