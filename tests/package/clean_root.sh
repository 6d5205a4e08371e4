#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# clean_root.sh FOLDER [ROOT]: installs the .deb files of a folder into a clean Debian 12, runs what they install, removes
# them, and looks for what is left. As root, with debootstrap and a mirror; takes some minutes, so it is run by hand
# (`cmake --build build --target check-package`). ROOT: the folder of the clean system, removed in the end.
set -euo pipefail
packages=$(cd "$1" && pwd)
root=${2:-$(mktemp -d)}
say() { printf '\n== %s\n' "$*"; }
inside() { chroot "$root" env -i PATH=/usr/bin:/bin:/usr/sbin:/sbin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
[ "$(id -u)" -eq 0 ] || { echo "clean_root.sh needs root" >&2; exit 2; }
trap 'umount -q "$root/proc" 2>/dev/null || true; [ -n "${2:-}" ] || rm -rf "$root"' EXIT

say "a clean Debian 12"
mirror=$(sed -n 's/^URIs: *//p; s/^deb \(\[[^]]*\] \)\?\([^ ]*\) .*/\2/p' /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | head -n 1 || true)
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 || { tail "$root.log"; exit 1; }
cp /etc/apt/apt.conf.d/99* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
mount -t proc proc "$root/proc"
inside apt-get -q update >/dev/null
inside dpkg-query -W -f '${Package}\n' | sort >"$root.before"

say "installing"
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages/"
inside sh -c 'apt-get install -q -y --no-install-recommends /packages/*.deb libosmesa6 man-db g++ cmake make' >"$root.log" 2>&1 ||
    { tail -n 30 "$root.log"; exit 1; }

say "running"
inside extremal --version --verbose
inside extremal run preset:pendulum --quiet --out /tmp/pendulum
inside extremal snapshot preset:spring-pendulum --quiet --out /tmp/picture.png
inside bash -c 'source /usr/share/bash-completion/completions/extremal; COMP_LINE="extremal study che"; COMP_POINT=18; _extremal; test "${COMPREPLY[*]}" = cheapest'
inside sh -c 'man -l /usr/share/man/man1/extremal.1.gz | grep -q preset:kepler'
inside python3 -c 'import extremal; r = extremal.run("preset:kepler")[0]; print(r.label, abs(r["energy_error"]).max())'
mkdir "$root/example"
cp "$(dirname "$0")"/../library/{example.cpp,CMakeLists.txt} "$root/example/"
inside sh -c 'cd /example && cmake -S . -B build >/dev/null && cmake --build build >/dev/null && build/example'
test -s "$root/tmp/pendulum/summary.csv" && test -s "$root/tmp/picture.png" && test -s "$root/example/energy.svg"

say "removing"
inside apt-get remove -q -y --purge extremal libextremal0.1 libextremal-dev python3-extremal >"$root.log" 2>&1
left=$(inside find /usr /etc /var/lib -iname '*extremal*' -not -path '/var/lib/dpkg/*' -not -path '/var/lib/apt/*')
[ -z "$left" ] || { echo "left behind: $left"; exit 1; }
! inside sh -c 'command -v extremal'
printf "\n1 passed, 0 failed\n"
