#!/usr/bin/env bash
# test_devices.sh VIEWER SCENE FOLDER: two devices in the panel (the same driver twice), the scene goes from one to the other; one that
# is no longer there is said to be missing, and the scene stays where it is. FOLDER keeps the screenshots.
set -euo pipefail
viewer=$1 scene=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
extent=900x640
. "$here/window.sh"

driver=${VK_ICD_FILENAMES:-}
[[ -f $driver ]] || { echo "SKIPPED: VK_ICD_FILENAMES names no single driver"; exit 77; }
cp "$driver" other.json
export VK_ICD_FILENAMES=$driver:$folder/other.json

headlines() { grep -c ' on .* (software)$' viewer.out || true; }
listFrom() { xdotool mousemove 700 44 click 1; } # the list of devices, at the top of the panel
choose() { # ENTRY COMMAND: again until the command is true, since on a busy machine a click may come before the list
    local place=$((80 + 38 * $1))
    shift
    for _ in {1..12}; do
        listFrom
        sleep 2
        shoot list.png
        xdotool mousemove 700 $place click 1
        for _ in {1..60}; do "$@" && return; sleep 0.1; done
    done
    fail "the choice never came to anything: $*"
}
hasHeadlines() { (($(headlines) >= $1)); }

echo "devices: both are listed, the scene goes to the other one and back"
start --device 0
xdotool windowmove "$window" 0 0
sleep 2
choose 1 hasHeadlines 2
awaitTitle fps
[[ ! -s viewer.err ]] || fail "something was said on stderr"
choose 0 hasHeadlines 3
awaitTitle fps

echo "devices: one that has gone is refused in the window"
export VK_ICD_FILENAMES=$driver
rm other.json
choose 1 test -s viewer.err
shoot refused.png
grep -q '^warning: no usable Vulkan device is called "1"' viewer.err || fail "nothing was said of a device that has gone"
! grep -qv '^warning: no usable Vulkan device' viewer.err || fail "more was said on stderr"
(($(headlines) == 3)) || fail "another scene was opened"
: >viewer.err
awaitTitle fps
keys ctrl+q
awaitEnd 0
echo "passed"
