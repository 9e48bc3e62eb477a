#!/usr/bin/env bash
# test_devices.sh VIEWER SCENE FOLDER: with two devices in the panel (the same driver twice), moves a scene
# from one to the other, also with changed substeps and with cuts that can be undone; it must continue, and a
# replay must reach the same state. A missing device is reported, and the scene stays on its device. FOLDER
# keeps the screenshots.
set -euo pipefail
viewer=$1 scene=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
driver=${VK_ICD_FILENAMES:-$(echo /usr/share/vulkan/icd.d/lvp_icd.*.json)}
[[ -f $driver ]] || { echo "SKIPPED: neither VK_ICD_FILENAMES nor lavapipe names a single driver"; exit 77; }
extent=900x640
. "$here/window.sh"
cp "$driver" other.json
export VK_ICD_FILENAMES=$driver:$folder/other.json

headlines() { grep -c ' on .* (software)$' viewer.out || true; }
listFrom() { xdotool mousemove 700 216 click 1; } # opens the list of devices, the first control of Performance
below() { shoot list.png && convert list.png -crop 220x60+640+228 +repage "$1"; } # where the list opens
isListed() { below listed.png && ! same unlisted.png listed.png; }
choose() { # ENTRY COMMAND: repeats the click until COMMAND succeeds, because a busy machine may miss one
    local place=$((242 + 38 * $1))
    shift
    for _ in {1..12}; do
        below unlisted.png
        listFrom
        within 20 isListed || continue
        xdotool mousemove 700 $place click 1
        within 6 "$@" && return
    done
    fail "the choice never came to anything: $*"
}
stepFive() { xdotool key --window "$window" --repeat 5 period; }
hasHeadlines() { (($(headlines) >= $1)); }

awaitBody() { # FILE: the part beside the panel and below messages, of a picture that no longer changes, without a tooltip
    xdotool mousemove 300 40
    awaitStill whole.png
    convert whole.png -crop 580x480+0+80 +repage "$1"
}
expectTheSame() { # FILE WHAT
    awaitTitle paused
    awaitBody "$1"
    same before.png "$1" || fail "$2 shows another state"
}

echo "devices: both are listed, the scene goes on on the other one and back"
mkdir -p config/sinew
echo "folded = scene material view record compare window" >config/sinew/viewer.conf # Performance is at the top
start --device 0
xdotool windowmove "$window" 0 0
cutDown 290 100 600
keys c space
awaitTitle paused
stepFive
awaitBody before.png
choose 1 hasHeadlines 2
expectTheSame there.png "the other device"
[[ ! -s viewer.err ]] || fail "something was said on stderr"
choose 0 hasHeadlines 3
awaitTitle paused
stepFive
awaitBody moved.png
same before.png moved.png && fail "nothing moves on the device that took over"
mv moved.png before.png

echo "devices: other substeps take over, and a replay comes to the same state"
xdotool mousemove 854 263 click 1     # the "+" beside the substeps: one more
await 60 says ' with 17 substeps, on ' # a busy machine takes long
grep -q ' with 17 substeps, on ' viewer.out || fail "the number of substeps was not turned"
expectTheSame substeps.png "the simulation with more substeps"
stepFive
awaitStill stepped.png

echo "devices: what was cut before all that is undone, and done again"
leads() { [[ $way == ctrl+z && $(title) != *pieces* || $way == ctrl+shift+z && $(title) == *pieces* ]]; }
for way in ctrl+z ctrl+shift+z ctrl+z; do
    keys $way
    awaitIdle
    for _ in {1..100}; do
        leads && break
        keys period # the title changes with the next step
        awaitIdle
    done
    leads || fail "$way leads nowhere"
done
keys F8
await 60 says '^input: '
hash=$(sed -n 's/^input: .*\(state hash .* steps\)$/\1/p' viewer.out)
grep -q '^solve split 16$' block-*.input || fail "the input does not say where another device took over"
grep -q '^solve split 17$' block-*.input || fail "the input does not say where the substeps changed"
"$viewer" --headless --replay block-*.input >replay.out 2>replay.err || fail "the replay failed: $(cat replay.err)"
grep -q "^$hash, as recorded$" replay.out || fail "the replay came to $(cat replay.out), not to $hash"
log=$(echo block-*.input)
keys space
awaitTitle fps

echo "devices: one that has gone is refused in the window"
export VK_ICD_FILENAMES=$driver
rm other.json
choose 1 test -s viewer.err
shoot refused.png
grep -q '^warning: no usable Vulkan device is called "1"' viewer.err || fail "nothing was said of a device that has gone"
! grep -qv '^warning: no usable Vulkan device' viewer.err || fail "more was said on stderr"
(($(headlines) == 4)) || fail "another scene was opened"
: >viewer.err
awaitTitle fps
quit
awaitEnd 0

echo "devices: a replay in the window goes to other substeps, too: to its end, with a pause on the way, and until it is dropped"
scene=
played() { await 90 says "^$hash, as recorded$"; }
start --replay "$log"
played
quit
awaitEnd 0
start --replay "$log"
awaitMotion
keys space
awaitTitle paused
keys r # from the beginning
keys space
played
quit
awaitEnd 0
start --replay "$log"
awaitMotion
keys Escape
keys period
awaitTitle paused
quit
awaitEnd 0
! grep -q "as recorded" viewer.out || fail "a replay that was dropped is compared: $(cat viewer.out)"
echo "passed"
