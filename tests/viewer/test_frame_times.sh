#!/usr/bin/env bash
# test_frame_times.sh VIEWER SCENE FOLDER: F7 and --timing report the times of pictures, in the window and
# without one. Checks that the numbers are consistent, but expects no particular times.
set -euo pipefail
viewer=$1 scene=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
extent=640x400
options=(--validation --timing)
. "$here/window.sh"

# Each row has a count and p50 <= p95 <= max. Frames of cuts and slow frames are at most all frames.
agree() { # FILE ROWS...
    local file=$1 row
    shift
    grep -q '^frame times: [0-9.]* pictures a second$' "$file" || fail "$file has no table"
    for row; do grep -qF "  $row " "$file" || fail "$file has no row $row"; done
    awk '/^frame times/ { shown = 1; frames = 0 }
        shown && match($0, /\]/) {
            if ($(NF - 3) < 1 || $(NF - 2) > $(NF - 1) || $(NF - 1) > $NF + 0.01) { print "no order: " $0; exit 1 }
            if ($1 " " $2 == "frame [ms]") { frames = $(NF - 3); longest = $NF }
            if ($1 " " $2 == "frame in" && ($(NF - 3) > frames || $NF > longest)) { print "more cuts than frames"; exit 1 }
        }
        /frames over 100 ms/ {
            slow = $5 + 0
            if (slow > frames || $NF > slow || (slow > 0 ? longest < 99.99 : longest > 100.01)) { print "slow frames: " $0; exit 1 }
            shown = 0; tables++
        }
        END { exit tables > 0 ? 0 : 1 }' "$file" || fail "the numbers of $file do not agree: $(cat "$file")"
}

start
xdotool windowmove "$window" 0 0
keys r
xdotool mousemove 500 330 mousedown 3
glide 20 4 1
xdotool mouseup 3
keys c
xdotool mousemove 320 60 mousedown 1
glide 40 0 8
xdotool mouseup 1
awaitTitle pieces
keys Tab
awaitWork "$running" 100 # pictures with panels
keys F7
await 60 says '^frame times'
cp viewer.out first.out
agree first.out "frame [ms]" "frame in a cut [ms]" "thread of the window" "step, on the device" "drawing, on the device" \
    "panels, on the device" "input to picture, at most" "input to picture [pictures"
frames() { awk '$1 " " $2 == "frame [ms]" { n = $(NF - 3) } END { print n }' "$1"; }
awaitWork "$running" 50 # pictures of the second table
quit
awaitEnd 0
(($(grep -c '^frame times' viewer.out) == 2)) || fail "there is no table at the end"
agree viewer.out "frame [ms]"
tail -n +$(($(grep -n '^frame times' viewer.out | tail -n 1 | cut -d: -f1))) viewer.out >last.out
grep -q 'frame in a cut' last.out && fail "the second table knows of the cut before it"
(($(frames first.out) >= 4)) || fail "few frames: $(cat first.out)"

"$viewer" "$scene" --headless --frames 12 --every 3 --size 160x100 --out pictures --timing >headless.out
agree headless.out "frame [ms]" "step, on the device" "drawing, on the device"
(($(frames headless.out) == 11)) || fail "12 frames are 11 times apart: $(cat headless.out)"
(($(awk '/^  drawing/ { print $(NF - 3) }' headless.out) == 5)) || fail "five pictures were drawn: $(cat headless.out)"
echo "passed"
