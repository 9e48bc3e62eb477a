#!/usr/bin/env bash
# tools/frame_times.sh [SCENE [SIZE]]: prints tables of the window's frame times (docs/performance.md) on the software device, under an
# X server without a screen: without input, in an orbit, in a grab, in three cuts and after them, with panels and without.
# Needs xvfb, xdotool and imagemagick, and a machine without other load.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
for icd in /usr/share/vulkan/icd.d/lvp_icd.*.json; do export VK_ICD_FILENAMES=$icd; done
here=tests/viewer viewer=${SINEW_VIEWER:-$root/build/release/bin/sinew-viewer} folder=$(mktemp -d)
scene=$(realpath "${1:-scenes/organ.toml}")
extent=${2:-1280x720}
screen=$extent
options=(--no-validation --timing)
. "$here/window.sh"
width=${extent%x*} height=${extent#*x}

said() { grep -c '^frame times' viewer.out || true; }
table() { # NAME PANELS
    local before
    before=$(said)
    keys F7
    hasTable() { (($(said) > before)); }
    await 30 hasTable
    echo "$1, $2"
    tac viewer.out | sed '/^frame times/q' | tac | grep -v '^input waited'
}
# Every sleep from here on is real time of playing, which the tables are about.
anew() { # resets the scene; later tables exclude earlier pictures
    keys r
    sleep 3
    table ignored ignored >/dev/null
}
drag() { # BUTTON X Y DX DY TIMES
    xdotool mousemove "$2" "$3" mousedown "$1"
    for ((i = 0; i < $6; ++i)); do xdotool mousemove_relative -- "$4" "$5"; sleep 0.03; done
    xdotool mouseup "$1"
}
play() { # PANELS
    anew
    sleep 5
    table "left alone" "$1"
    anew
    drag 3 $((width / 2)) $((height / 2)) 4 1 50
    drag 3 $((width / 2)) $((height / 2)) -4 -1 50 # back to the first view
    table orbit "$1"
    anew
    drag 1 $((2 * width / 5)) $((height / 2)) 3 -2 100
    table grab "$1"
    anew
    keys c
    for x in 44 52 60; do drag 1 $((x * width / 100)) $((height / 6)) 0 8 $((height / 12)); sleep 1; done
    keys c
    table "three cuts" "$1"
    sleep 6
    table "left alone after three cuts" "$1"
}

start
xdotool windowmove "$window" 0 0
play "with panels"
keys Tab
play "without panels"
keys ctrl+q
wait "$running"
rm -r "$folder"
