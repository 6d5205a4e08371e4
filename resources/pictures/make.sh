#!/usr/bin/env bash
# Makes the picture of the window that the README shows, with the program that is built; no display needed.
set -euo pipefail
folder=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=${1:-$folder/../../build/bin/extremal}

shot() {
    QT_QPA_PLATFORM=offscreen EXTREMAL_STAGE=picture \
        EXTREMAL_SHOT="$folder/$1.png" EXTREMAL_SHOT_THEME="$2" EXTREMAL_SHOT_SIZE="$3" "$program" "$4"
    printf '%s\n' "$folder/$1.png"
}

shot window light 1600x1000 preset:spring-pendulum
