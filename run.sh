#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Starts Extremal: installs what is missing, builds the program, opens the window on a scene.
# Without a display the same comparison runs headless, into out/.
set -euo pipefail
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/.ci/prepare.sh"

if [ $# -gt 1 ] || [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
    say "usage: ${BASH_SOURCE[0]} [SCENE]"
    say "  SCENE   a scene file or preset:NAME; preset:spring-pendulum if left out"
    say "The program itself is build/bin/extremal, and build/bin/extremal --help lists what else it does."
    [ $# -le 1 ] && exit 0 || exit 2
fi
scene=${1:-preset:spring-pendulum}
program=$root/build/bin/extremal

install_packages program
configure
build_program

headless() {
    local status=0
    "$program" run "$scene" --out "$root/out" || status=$?
    [ "$status" -le 1 ] || exit "$status"
    "$program" snapshot "$scene" --out "$root/out/comparison.png" --quiet || exit
    say ""
    say "The comparison is in $root/out:"
    say "  comparison.png            the stage and the plots"
    say "  summary.csv, *.csv        cost and errors, and the samples of every scheme"
    say "  scene.json                the scene itself, every default filled in"
    exit "$status"
}

if [ -z "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    say "There is no display: running without the window."
    headless
fi
status=0
# The pictures of the start page are made while the window is open already; without them it draws its own.
ninja -C "$root/build" extremal_pictures >/dev/null 2>&1 &
pictures=$!
"$program" "$scene" || status=$?
kill "$pictures" 2>/dev/null || true  # a next start builds in the same folder
# The program gives 2 for a scene it cannot use, which it has named, and for a display it cannot open.
if [ "$status" -eq 2 ] && "$program" check "$scene" --quiet >/dev/null 2>&1; then
    say "The display cannot be used: running without the window."
    headless
fi
exit "$status"
