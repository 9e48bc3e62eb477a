#!/usr/bin/env bash
# test_faults.sh VIEWER SCENE FOLDER LAYERS: lets Vulkan calls fail, one after the other: without a window
# while a scene loads, grows, is cut, filmed and played beside another solver, and in the window while input
# films, cuts, saves, changes scenes and quits. The viewer must continue, or end with one line and exit code
# 5, without validation messages and partial files. Takes every 101st call, and every 7th with SINEW_FULL=1.
set -euo pipefail
viewer=$1 player=$1 scene=$2 folder=$3 layers=$4
here=$(cd "$(dirname "$0")" && pwd)
extent=640x480
. "$here/window.sh"
stride=${SINEW_FULL:+7}
stride=${stride:-101}
export VK_LAYER_PATH=$layers:/usr/share/vulkan/explicit_layer.d:/etc/vulkan/explicit_layer.d VK_INSTANCE_LAYERS=VK_LAYER_SINEW_losing
export SINEW_FAIL_REPORT=$folder/struck
results=(-2 -1 -4) # out of device memory, out of host memory, device lost

mkdir bin # replaces ffmpeg: its last argument is the file
printf '#!/bin/sh\nfor last; do :; done\nexec cat >"${last#file:}"\n' >bin/ffmpeg
chmod +x bin/ffmpeg
PATH=$folder/bin:$PATH

expectEnd() { # CODE WHAT: end of a run whose output is in viewer.err
    local said
    said=$(grep -c '^error: ' viewer.err || true)
    grep -q '^validation:' viewer.err && fail "$2: the validation layer complains"
    [[ $1 == 0 && $said == 0 || $1 == 5 && $said == 1 ]] || fail "$2: exit code $1 and $said lines of error"
    [[ -z $(find . -name '*.tmp*' -o -name '*.part*' -o -name '.*.png*') ]] || fail "$2: partial files: $(find .)"
}

echo "faults: without a window"
cat >grow.toml <<'END'
[solver]
substeps = 8
[contacts]
room = 1
[[particles]]
radius = 0.05
count = [3, 3, 3]
jitter = 0.005
center = [0, 0.3, 0]
[[box]]
particles = [4, 4, 4]
spacing = 0.05
center = [0.5, 0.3, 0]
cuttable = true
[[plane]]
[[blade]]
times = [0, 0.0166667]
edges = [[[0.5, 1, -1], [0.5, 1, 1]], [[0.5, -1, -1], [0.5, -1, 1]]]
END
struck=0
for ((call = 1; ; call += stride)); do
    rm -rf struck film film.mp4
    code=0
    SINEW_FAIL_CALL=$call SINEW_FAIL_RESULT=${results[call / stride % 3]} timeout -s KILL 120 \
        "$player" grow.toml --headless --frames 10 --every 2 --size 64x64 --out film --video film.mp4 --beside split:12 \
        --show strain,wires,particles,contacts --validation >viewer.out 2>viewer.err || code=$?
    expectEnd $code "call $call, $(cat struck 2>/dev/null || echo 'not struck')"
    for picture in film/*.png; do [[ ! -e $picture ]] || convert "$picture" null: || fail "call $call: $picture is not whole"; done
    [[ -e struck ]] || break
    ((++struck))
done
((struck >= 10)) || fail "only $struck calls were struck"

echo "faults: in the window"
export SINEW_FAIL_FROM=$folder/go
mkdir played
cp "$scene" played
printf '[[cloth]]\nsize = [8, 8]\nspacing = 0.05\npinned = ["first_row"]\n' >played/cloth.toml
scene=$folder/played/$(basename "$scene")
meet() { # CALL KEYS...: CALL fails after these keys were pressed
    local code=0 call=$1
    shift
    rm -f go struck
    export SINEW_FAIL_CALL=$call
    start
    touch go
    keys "$@" 2>/dev/null || true
    within 120 test -s struck || fail "$*: call $call was never struck"
    keys F7 2>/dev/null || true
    goesOn() { hasEnded || says '^frame times'; } # some calls end it, others cost a picture
    within 60 goesOn || fail "$*: call $call ($(cat struck)): it takes no key"
    hasEnded || keys ctrl+q 2>/dev/null || true
    within 60 hasEnded || fail "$*: call $call ($(cat struck)): it does not end"
    xdotool keyup q keyup ctrl
    wait "$running" || code=$?
    expectEnd $code "$*: call $call, $(cat struck)"
}
export SINEW_FAIL_RESULT=-2
for call in 1 4 5 13; do meet $call space; done
for call in 2 30; do meet $call F9; done
for call in 8 150 600; do meet $call n; done
meet 3 ctrl+s
meet 20 s
echo "passed"
