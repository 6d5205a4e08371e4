# SPDX-License-Identifier: GPL-3.0-or-later
# What run.sh and test.sh share: missing Debian packages and the configured build folder. To be sourced;
# expects `root`, the folder of the project.

say() { printf '%s\n' "$*" >&2; }

# install_packages [program]: installs the packages of packages.txt that are missing; with `program` those alone that the
# program needs. Asks dpkg alone when nothing is missing.
install_packages() {
    local wanted missing list
    list=$(cat "$root/packages.txt")
    [ "${1:-}" != program ] || list=${list%%# the Python module*}
    wanted=$(grep -v '^#' <<<"$list")
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        if ! command -v cmake >/dev/null || ! command -v ninja >/dev/null; then
            say "This machine has no apt-get, so nothing can be installed for you. Extremal is built on Debian 12 from:"
            say "  $(echo $wanted)"
            say "Install what corresponds to these packages, then start this again."
            return 1
        fi
        say "No apt-get here: going on with what is installed (packages.txt names what is needed)."
        return 0
    fi
    missing=$(comm -13 <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null |
        sed -n 's/^installed //p' | sort) <(sort -u <<<"$wanted" | sed '/^$/d'))
    [ -n "$missing" ] || return 0

    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            say "These Debian packages are missing, and there is no sudo to install them with. As root, run:"
            say "  apt-get update && apt-get install --no-install-recommends $(echo $missing)"
            say "Then start this again."
            return 1
        fi
        as_root=(sudo)
    fi
    say "Installing: $(echo $missing)"
    if ! "${as_root[@]}" apt-get update -q >&2; then
        say "apt-get update failed (see above): trying with the package lists that are there."
    fi
    if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -q -y --no-install-recommends $missing >&2; then
        say "apt-get could not install them (see above). Extremal is built on Debian 12; on another release the"
        say "packages may have other names."
        return 1
    fi
    installed_some=yes  # what is found when the build is configured changes
}

# configure [FOLDER OPTION...]: configures FOLDER (build, with batches of files, which are faster to build from scratch)
# once; afterwards the build itself notices changes. A folder that was configured for another place (a copied or moved
# project) is configured anew.
configure() {
    local folder=${1:-build} home=""
    [ $# -gt 0 ] || set -- build -DEXTREMAL_UNITY=ON
    if [ -f "$root/$folder/CMakeCache.txt" ]; then
        home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$root/$folder/CMakeCache.txt")
    fi
    local fresh=()
    if [ "$home" = "$root" ] && [ -f "$root/$folder/build.ninja" ]; then
        [ -n "${installed_some:-}" ] || return 0
    elif [ -n "$home" ]; then
        fresh=(--fresh)
    fi
    cmake "${fresh[@]}" -S "$root" -B "$root/$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release "${@:2}" >&2
}

# build_program: builds the program and nothing else, with one line that says how far it is and how long it will take. What
# the compiler says is shown where it fails.
build_program() {
    local log=$root/build/build.log status=0 line left done all start=$SECONDS last=-10
    : >"$log"
    ninja -C "$root/build" extremal 2>&1 | while IFS= read -r line; do
        printf '%s\n' "$line" >>"$log"
        [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
        done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
        [ "$all" -gt 5 ] || continue  # looking for new files, and little more
        [ "$last" -ge 0 ] || [ -t 2 ] || say "Building the program: a few minutes the first time."
        left=$(((SECONDS - start) * (all - done) / (done > 0 ? done : 1)))
        printf -v line '%3d %%  %d of %d steps, about %d:%02d left' $((100 * done / all)) "$done" "$all" \
            $((left / 60)) $((left % 60))
        if [ -t 2 ]; then
            printf '\r\033[KBuilding the program: %s' "$line" >&2
        elif [ $((SECONDS - last)) -ge 10 ]; then
            last=$SECONDS
            say "$line"
        fi
    done || status=$?
    [ ! -t 2 ] || printf '\r\033[K' >&2
    if [ "$status" -ne 0 ]; then
        grep -v '^\[[0-9]*/[0-9]*\]' "$log" | head -n 60 >&2
        say "The build failed; everything that it said is in $log."
        return "$status"
    fi
    [ $((SECONDS - start)) -lt 5 ] || say "Built in $(((SECONDS - start) / 60)):$(printf %02d $(((SECONDS - start) % 60)))."
}
