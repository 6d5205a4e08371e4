#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tasks.sh PROGRAM FOLDER: the ten commonest tasks with mouse and keys on a display of its own, a picture of each in the
# folder, and the clicks and keys that each takes (typing a text counts as one). Needs Xvfb, xdotool and ImageMagick.
# What a task needs is found by its name, in the palette (Ctrl+K), or is in the middle of the window: nothing depends on
# where the window puts it. Ends with 1 if a task does not do what it should, or takes too many.
set -u
program=$(realpath "$1")
folder=$(realpath -m "$2")
mkdir -p "$folder"
cd "$folder" || exit 2
rm -rf ./*.png ./*.json figure.* command.txt report.html home
mkdir -p home
export HOME=$folder/home XDG_CONFIG_HOME=$folder/home XDG_DATA_HOME=$folder/home DISPLAY=:${TASKS_DISPLAY:-87}
Xvfb "$DISPLAY" -screen 0 1600x1000x24 -nolisten tcp 2>/dev/null &
display=$!
trap 'kill $window $display 2>/dev/null' EXIT
until xdotool getdisplaygeometry >/dev/null 2>&1; do sleep 0.1; done
"$program" 2>/dev/null &
window=$!
id=$(xdotool search --sync --onlyvisible --pid $window 2>/dev/null | tail -1)
xdotool windowmove "$id" 0 0 windowsize "$id" 1600 1000 windowfocus "$id"

actions=0 failed=0
key() { xdotool key "$1"; actions=$((actions + 1)); sleep 0.2; }
text() { xdotool type --delay 5 "$1"; actions=$((actions + 1)); sleep 0.2; }
find_it() { key ctrl+k; settle; text "$1"; settle; key Return; settle; xdotool windowfocus "$id"; }
# the mouse in the middle of the window, and a notch of its wheel
middle() { xdotool mousemove --window "$id" 800 500; }
wheel_up() { xdotool click 4; actions=$((actions + 1)); sleep 0.2; }
# until the picture of the window stays the same
settle() {
    local before=none now
    for _ in $(seq 60); do
        sleep 0.4
        now=$(import -window root rgb:- | md5sum)
        [ "$now" = "$before" ] && return
        before=$now
    done
}
# finish NUMBER NAME MOST: the picture, and what it took
finish() {
    settle
    xdotool windowfocus "$id"  # as a window manager does after a dialog
    import -window root "$1-$2.png"
    local verdict=ok
    [ $actions -gt "$3" ] && verdict="too many" && failed=1
    echo "$1 $2: $actions clicks and keys, at most $3: $verdict"
    actions=0
}
check() { if ! eval "$2"; then echo "   $1: not so"; failed=1; fi; }

settle
find_it "open preset: spring-pendulum"
finish 01 open-a-preset 5

find_it "change stiffness"; text 20000; key Return
finish 02 change-a-parameter 5

find_it "add degree 3 lobatto"
finish 03 add-a-scheme 5

find_it "step of midpoint"; text 0.02; key Return
finish 04 change-a-step 5

# Ctrl+S, so that what was done so far can be read
key ctrl+s; settle; text "$folder/edited.json"; key Return; settle; xdotool windowfocus "$id"; actions=0
check "stiffness 20000" 'grep -q "\"k\": 20000" edited.json'
check "seven schemes" '[ $(grep -c "\"label\"" edited.json) -ge 7 ]'
check "step 0.02" 'grep -q "\"step\": 0.02" edited.json'

find_it "maximise the plot energy error"; middle; wheel_up; wheel_up
finish 05 compare-two-energies-zoomed 5

xdotool mousemove --window "$id" 700 520; actions=1
finish 06 values-at-a-time 5

key ctrl+e; settle; text "$folder/figure.pdf"; key Return
finish 07 export-a-figure 5
check "figure.pdf" '[ -s figure.pdf ]'
key Escape; actions=0  # all plots again

key ctrl+shift+e; settle; key Return  # into the folder of the last dialog
for _ in $(seq 120); do [ -s stage.png ] && break; sleep 0.5; done
finish 08 export-everything 5
check "the command and the report" '[ -s command.txt ] && [ -s report.html ]'

key ctrl+shift+n; settle; text "m/2*l^2*theta_t^2 + m*g*l*cos(2*theta)"
finish 09 type-a-lagrangian 10
key ctrl+shift+s; settle; text "$folder/typed.json"; key Return; settle; xdotool windowfocus "$id"; actions=0
check "the formula" 'grep -q "cos(2\*theta)" typed.json'

key ctrl+f; settle; text symplectic; key Return
finish 10 find-help 5
exit $failed
