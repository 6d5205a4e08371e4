#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests, and sees that the benchmarks compile. Arguments go to ctest: ./test.sh -R laws
set -euo pipefail
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/.ci/prepare.sh"

install_packages
configure
ninja -C "$root/build" >&2
ctest --test-dir "$root/build" --parallel 2 --output-on-failure "$@"
ninja -C "$root/build" bench >&2
