#!/usr/bin/env bash
# tools/window_picture.sh [FILE]: draws the README's picture of the window with its panels (docs/images/window.png): scenes/organ_draped.toml on
# the software device after 45 steps, coloured by strain, under an X server without a screen. Needs xvfb, xdotool and imagemagick.
set -euo pipefail
cd "$(dirname "$0")/.."
file=$(realpath -m "${1:-docs/images/window.png}")
for icd in /usr/share/vulkan/icd.d/lvp_icd.*.json; do export VK_ICD_FILENAMES=$icd; done
root=$PWD
here=tests/viewer viewer=$root/build/release/bin/sinew-viewer folder=$(mktemp -d) extent=1200x700 screen=1200x700
scene=$root/scenes/organ_draped.toml
options=(--no-validation --show strain)
. "$here/window.sh"

start
xdotool windowmove "$window" 0 0
keys space
awaitTitle paused
keys r
xdotool key --window "$window" --repeat 45 period
sleep 5 # real time: a message stays for four seconds
awaitStill window.png
convert window.png +dither -colors 250 -define png:compression-level=9 PNG8:"$file"
keys ctrl+q
wait "$running"
rm -r "$folder"
stat -c '%n: %s bytes' "$file"
