# What run.sh and test.sh share: missing Debian packages and the configured build folder. To be sourced;
# expects `root`, the folder of the project.

say() { printf '%s\n' "$*" >&2; }

# Installs the packages of packages.txt that are missing. Asks dpkg alone when nothing is.
install_packages() {
    local wanted missing
    wanted=$(grep -v '^#' "$root/packages.txt")
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
    if [ "$home" = "$root" ] && [ -f "$root/$folder/build.ninja" ]; then
        return 0
    fi
    local fresh=()
    [ -z "$home" ] || fresh=(--fresh)
    cmake "${fresh[@]}" -S "$root" -B "$root/$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release "${@:2}" >&2
}
