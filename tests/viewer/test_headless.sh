#!/usr/bin/env bash
# test_headless.sh VIEWER SCENE FOLDER: makes pictures without a display, under validation. Each error gives
# one line.
set -euo pipefail
viewer=$1 scene=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
. "$here/waits.sh"
. "$here/signals.sh"
unset DISPLAY WAYLAND_DISPLAY
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

fail() {
    echo "FAILED: $1"
    cat out err 2>/dev/null
    exit 1
}
expect() { # CODE ARGUMENTS...: runs the viewer
    local wanted=$1 code=0
    shift
    "$viewer" "$@" >out 2>err || code=$?
    [[ $code == "$wanted" ]] || fail "$*: exit code $code, expected $wanted"
    if ((wanted != 0)); then
        (($(grep -c '^error: ' err) == 1)) || fail "$*: not one line of error"
    fi
}

expect 0 "$scene" --headless --frames 30 --every 10 --size 320x200 --out every --validation
[[ $(echo every/*) == "every/frame_0000.png every/frame_0010.png every/frame_0020.png every/frame_0030.png" ]] ||
    fail "--every wrote $(echo every/*)"
SINEW_STEP_PARTS=3 expect 0 "$scene" --headless --frames 30 --every 30 --size 320x200 --out parts --validation
cmp -s every/frame_0030.png parts/frame_0030.png || fail "steps in several submissions led to another picture"
grep -q validation err && fail "validation messages"
grep -q '^30 of 30 steps' err || fail "no progress in a pipe"
expect 0 "$scene" --headless --picture-frames 10,30 --size 320x200 --out listed
cmp every/frame_0010.png listed/frame_0010.png || fail "a picture depends on which others are taken"
cmp every/frame_0030.png listed/frame_0030.png || fail "a picture depends on which others are taken"
cmp -s every/frame_0000.png every/frame_0030.png && fail "nothing has moved"

# Layers appear in pictures, too.
expect 0 "$scene" --headless --picture-frames 30 --size 320x200 --out shown --show strain,wires,particles,contacts --validation
grep -q validation err && fail "validation messages"
cmp -s every/frame_0030.png shown/frame_0030.png && fail "--show shows nothing"

# A step that lacks contact capacity is repeated, and no picture shows the state before it.
balls='name = "balls"
[solver]
substeps = 8
[[particles]]
radius = 0.05
count = [4, 4, 4]
jitter = 0.005
center = [0, 0.3, 0]
[[plane]]
'
printf '%s[contacts]\nroom = 64\n' "$balls" >roomy.toml
printf '%s[contacts]\nroom = 1\n' "$balls" >tight.toml
expect 0 roomy.toml --headless --frames 24 --every 3 --size 160x100 --out roomy --validation
grep -q validation err && fail "validation messages"
expect 0 tight.toml --headless --frames 24 --every 3 --size 160x100 --out tight --validation
grep -q validation err && fail "validation messages"
for picture in roomy/*.png; do
    cmp -s "$picture" tight/"${picture##*/}" || fail "$picture depends on the room at first"
done
cmp -s roomy/frame_0000.png roomy/frame_0024.png && fail "no ball has moved"

# Pieces without a surface are counted separately, as in the report of a run.
printf 'gravity = [0, 0, 0]\n[[mesh]]\ngenerate = "sphere"\ndetail = 32\nsize = 0.3\ncenter = [0, 0, 0]\nresolution = 8\ncuttable = true\n[[blade]]\ntimes = [0, 0.0166667]\nedges = [[[0.1055, 1, -1], [0.1055, 1, 1]], [[0.1055, -1, -1], [0.1055, -1, 1]]]\n' >slice.toml
expect 0 slice.toml --headless --frames 4 --every 4 --size 64x64 --out slice --validation
grep -qx 'cut: [0-9]* links, 2 pieces and 6 fragments without a surface' out || fail "it counts other pieces"

# Over-relaxation that makes the solver diverge.
printf '[solver]\nname = "jacobi"\nsubsteps = 1\niterations = 200\nover_relaxation = 1.99\nweight = 1\n[[cloth]]\nname = "fuse"\nsize = [16, 16]\nspacing = 1\npinned = ["first_row"]\n' >bomb.toml
expect 7 bomb.toml --headless --frames 100000 --every 100000 --size 64x64 --out bomb
grep -q 'body "fuse"' err || fail "a divergence names no body"
[[ -s bomb/frame_0000.png ]] || fail "a divergence lost the pictures before it"

echo occupied >file
expect 6 "$scene" --headless --out file/below
expect 6 "$scene" --headless --frames 1 --video missing/film.mp4
expect 3 missing.toml --headless --out x
expect 3 "$folder" --headless --out x
expect 4 "$scene" --headless --out x --device "no such device"
expect 2 "$scene" --headless --size 20x --out x
expect 2 --surprise
expect 2 "$scene" --headless --out x --show x-rays
expect 3 --headless --replay missing.input
echo "no log" >no.input
expect 3 --headless --replay no.input
[[ ! -e x ]] || [[ -z $(ls x) ]] || fail "a failed run left pictures"

"$viewer" "$scene" --headless --frames 1000000 --every 5 --size 64x64 --out interrupted >out 2>err &
await 60 test -e interrupted/frame_0005.png
kill -INT $!
code=0
wait $! || code=$?
[[ $code == 130 ]] || fail "interrupted: exit code $code, expected 130"
# A signal during the loading of a scene, or in a step of several seconds, ends the viewer within 2 s (longer
# on a busy machine).
endsSoon() { # SIGNAL FILE TICKS ARGUMENTS...: sends the signal when it has worked so long [1/100 s] after it wrote the file
    local signal=$1 file=$2 ticks=$3
    shift 3
    "$viewer" "$@" >out 2>err &
    await 60 test -e "$file"
    awaitWork $! "$ticks"
    endsWithin 4 "$signal" $!
}
printf '[[mesh]]\ngenerate = "organ"\ndetail = 256\nsize = 0.4\nresolution = 120\ncuttable = true\n' >large.toml
printf '[solver]\nsubsteps = 1000\n[[box]]\nparticles = [40, 40, 40]\nspacing = 0.02\ncenter = [0, 1, 0]\nyoung_modulus = 1e5\n[[plane]]\n' >slow.toml
for signal in INT TERM; do
    endsSoon $signal . 30 large.toml --headless --frames 10 --size 64x64 --out loading
    [[ ! -e loading/frame_0000.png ]] || fail "the scene was loaded before the signal came"
    rm -rf slow
    endsSoon $signal slow/frame_0000.png 100 slow.toml --headless --frames 1000 --size 64x64 --out slow # in the first step
done

# Replaces ffmpeg: its last argument is the file.
mkdir bin
printf '#!/bin/sh\nfor last; do :; done\nexec cat >"${last#file:}"\n' >bin/ffmpeg
chmod +x bin/ffmpeg
for signal in INT TERM HUP; do
    # HUP may be ignored, because nohup may run the tests.
    PATH=$folder/bin:$PATH env --default-signal=HUP "$viewer" "$scene" --headless --frames 1000000 --size 64x64 --video film.mp4 >out 2>err &
    await 60 isFilming 16k
    [[ ! -e film.mp4 ]] || fail "a film that is not finished has its name already"
    kill -$signal $!
    code=0
    wait $! || code=$?
    [[ $code == 130 ]] || fail "interrupted while filming: exit code $code, expected 130"
    bytes=$(stat -c %s film.mp4) || fail "the film is lost"
    ((bytes > 0 && bytes % (64 * 64 * 4) == 0)) || fail "the film has $bytes bytes, which are no whole pictures"
    rm film.mp4
done
# Repeats this in a step that lasts longer than the viewer may run after the signal.
PATH=$folder/bin:$PATH "$viewer" slow.toml --headless --frames 1000 --size 64x64 --video film.mp4 >out 2>err &
await 60 isFilming 15k
awaitWork $! 100 # in the next step
kill -INT $!
code=0
wait $! || code=$?
[[ $code == 130 && $(grep -c '^error: interrupted' err) == 1 ]] || fail "interrupted in a step: exit code $code"
bytes=$(stat -c %s film.mp4) || fail "the film is lost"
((bytes > 0 && bytes % (64 * 64 * 4) == 0)) || fail "the film has $bytes bytes, which are no whole pictures"
rm film.mp4
printf '#!/bin/sh\nhead -c 100000 >/dev/null\nexit 1\n' >bin/ffmpeg
code=0
PATH=$folder/bin:$PATH "$viewer" "$scene" --headless --frames 1000000 --size 64x64 --video film.mp4 >out 2>err || code=$?
[[ $code == 6 && ! -e film.mp4 ]] || fail "a film that failed: exit code $code, $(find . -name 'film*')"
[[ -z $(find . -name '*.tmp*' -o -name '*.part*' -o -name '.*.png*') ]] || fail "partial files: $(find .)"
echo "passed"
