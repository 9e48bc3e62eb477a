#!/usr/bin/env bash
# tools/film.sh [FILE]: draws the README's moving picture (docs/images/first_minute.gif) without a window: the viewer replays
# tools/first_minute.input, which a window has saved with F8. An organ is pulled and cut, the incision gapes, its flap is pulled open,
# strain is shown, and an undo closes it. Needs the release build and imagemagick; takes some minutes on two cores.
set -euo pipefail
cd "$(dirname "$0")/.."
file=${1:-docs/images/first_minute.gif}
for icd in /usr/share/vulkan/icd.d/lvp_icd.*.json; do export VK_ICD_FILENAMES=$icd; done # the same bits everywhere
first=84 last=327 every=3 strain=(255 300) # steps; the organ rests at the first one, and strain is shown in between
delay=6                                    # of a picture [1/100 s]
pause=60                                   # after the last one
colors=160
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

draw() { # FOLDER FROM TO [OPTIONS]: pictures of these steps
    build/release/bin/sinew-viewer --headless --no-validation --replay tools/first_minute.input --size 960x540 --out "$folder/$1" \
        --picture-frames "$(seq -s , "$2" $every "$3")" "${@:4}" >/dev/null
}
draw plain $first $last
draw strain "${strain[@]}" --show strain
cp "$folder"/strain/*.png "$folder/plain"

# One table of colors without dithering: what stands still is stored once.
mapfile -t pictures < <(printf '%s\n' "$folder"/plain/*.png)
convert "${pictures[@]}" -resize 25% -append +dither -colors $colors "$folder/colors.png"
convert -delay $delay "${pictures[@]:0:${#pictures[@]}-1}" -delay $pause "${pictures[-1]}" -resize "${size:-960x540}" +dither -remap "$folder/colors.png" \
    -layers OptimizeTransparency -loop 0 "$file"
stat -c '%n: %s bytes' "$file"
