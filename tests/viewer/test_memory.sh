#!/usr/bin/env bash
# test_memory.sh VIEWER SCENE FOLDER: switching between two scenes must not enlarge the viewer, because each
# scene returns its memory. Uses the smallest of three readings, since a reading may fall into a switch.
set -euo pipefail
viewer=$1 given=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
extent=640x400 options=(--no-validation) scene=
. "$here/window.sh"
cp "$given" one.toml
sed '0,/^name.*/s//name = "other"/' "$given" >two.toml
scene=$folder/one.toml
start

shown() { grep -c ' particles, ' viewer.out || true; }
change() { # switches to the previous scene of the folder and plays some of it
    local before
    before=$(shown)
    keys Prior
    isNext() { (($(shown) > before)); }
    within 60 isNext || fail "the next scene never came"
    awaitWork "$running" 50
}
resident() { awk '/^VmRSS/ {print $2}' "/proc/$running/status"; } # in kB
least() { # smallest size after each of three switches
    local size=$((1 << 40)) now
    for _ in 1 2 3; do
        change
        now=$(resident)
        ((now < size)) && size=$now
    done
    echo "$size"
}
change
before=$(least)
after=$(least)
after=$(least)
echo "resident: $before kB in the first changes, $after kB six changes later"
((after - before < 100000)) || fail "the viewer grew by $((after - before)) kB"
quit
awaitEnd 0
