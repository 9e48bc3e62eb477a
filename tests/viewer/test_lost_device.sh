#!/usr/bin/env bash
# test_lost_device.sh VIEWER SCENE FOLDER LAYERS: the device is lost, in the window after a cut, and without a
# window during a film. Expects one line, exit code 5, and that settings, the input log and finished pictures
# are kept.
set -euo pipefail
viewer=$1 player=$1 scene=$2 folder=$3 layers=$4
here=$(cd "$(dirname "$0")" && pwd)
extent=640x480 options=(--no-validation)
. "$here/window.sh"
export SINEW_LOSE_DEVICES=$folder/lost
printf '#!/bin/sh\nexec env VK_LAYER_PATH="%s" VK_INSTANCE_LAYERS=VK_LAYER_SINEW_losing "%s" "$@"\n' "$layers" "$player" >start
chmod +x start

mkdir bin # replaces ffmpeg: its last argument is the file
printf '#!/bin/sh\nfor last; do :; done\nexec cat >"${last#file:}"\n' >bin/ffmpeg
chmod +x bin/ffmpeg
PATH=$folder/bin:$PATH
expectFilm() { # FILE BYTES: a film of whole pictures with BYTES each
    local bytes
    bytes=$(stat -c %s "$1") || fail "the film is lost"
    ((bytes > 0 && bytes % $2 == 0)) || fail "the film has $bytes bytes, which are no whole pictures"
    [[ -z $(find . -name '*.part*' -o -name '.*.png*') ]] || fail "partial files: $(find .)"
}

echo "lost device: in the window"
viewer=$folder/start
start
keys v
cutDown 320 100 420
keys F9
await 30 isFilming 4000k
touch lost
await 30 hasEnded
code=0
wait "$running" || code=$?
[[ $code == 5 && $(wc -l <viewer.err) == 1 ]] || fail "exit code $code"
grep -q '^error: .*VK_ERROR_DEVICE_LOST' viewer.err || fail "nothing was said of the device"
expectFilm "$(sed -n 's/^recording //p' viewer.out)" $((640 * 480 * 4))
grep -q '^vsync = false$' config/sinew/viewer.conf || fail "what V chose is not remembered"
input=$(sed -n 's/.*: --replay \(.*\) replays the input$/\1/p' viewer.err)
[[ $input == "$folder"/block-*.input ]] && grep -q '^press ' "$input" || fail "what hands did is not kept"
rm lost
"$player" --headless --replay "$input" >replay.out 2>replay.err || fail "the replay failed: $(cat replay.err)"
grep -q '^state hash' replay.out || fail "the replay came to nothing"

echo "lost device: the window goes on with another one"
start
cutDown 320 100 420
[[ $(title) == *pieces* ]] || fail "nothing is cut"
window_before=$window
echo 1 >lost # also loses the next device; the one after it works
await 30 test -s viewer.err
lost=$EPOCHSECONDS
await 30 lacksTitle pieces # it begins anew
[[ $(wc -l <viewer.err) == 1 ]] || fail "not one line"
input=$(sed -n 's/^warning: .*VK_ERROR_DEVICE_LOST.*: the scene restarts on .*: --replay \(.*\) replays the input$/\1/p' viewer.err)
grep -q '^press ' "$input" || fail "what hands did is not kept"
[[ $(xdotool search --name '^Sinew' | head -n 1) == "$window_before" ]] || fail "it is another window"
keys space
awaitTitle paused
awaitStill after.png
[[ $(convert after.png -unique-colors -format '%w' info:) -gt 500 ]] || fail "nothing is drawn"
keys space
awaitTitle fps
isLater() { ((EPOCHSECONDS > lost + 10)); } # betweenLosses of apps/viewer/interactive.cpp: a loss sooner ends the viewer
await 20 isLater
echo 0 >lost # loses the device again; the next one works
saysTwoLines() { (($(wc -l <viewer.err) == 2)); }
await 30 saysTwoLines # it goes on a second time
echo 0 again >lost    # a loss at once ends the viewer
await 30 hasEnded
code=0
wait "$running" || code=$?
[[ $code == 5 && $(grep -c '^error: .*VK_ERROR_DEVICE_LOST' viewer.err) == 1 ]] || fail "exit code $code after it was lost again"
rm lost

echo "lost device: without a window"
"$folder/start" "$scene" --headless --frames 1000000 --every 5 --size 64x64 --out film --video film.mp4 >viewer.out 2>viewer.err &
running=$!
await 30 test -e film/frame_0010.png
touch lost
await 30 hasEnded
code=0
wait "$running" || code=$?
[[ $code == 5 && $(grep -c '^error: .*VK_ERROR_DEVICE_LOST' viewer.err) == 1 ]] || fail "exit code $code"
expectFilm film.mp4 $((64 * 64 * 4))
for picture in film/*.png; do
    convert "$picture" null: || fail "$picture is not whole"
done
echo "passed"
