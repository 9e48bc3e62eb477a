#!/usr/bin/env bash
# test_stored_pictures.sh VIEWER SCENES STORED FOLDER: compares headless pictures with those in STORED/DRIVER,
# with a tolerance for each scene. FOLDER receives the stored picture, the new one and their difference where
# they differ. SINEW_STORE=1 stores the new pictures instead.
set -euo pipefail
viewer=$1 scenes=$2 stored=$3 folder=$4
here=$(cd "$(dirname "$0")" && pwd)
for program in convert compare; do
    command -v "$program" >/dev/null || { echo "SKIPPED: $program is not installed (package imagemagick)"; exit 77; }
done
rm -rf "$folder"
mkdir -p "$folder"

# Tolerance of the RMS color difference, relative to the largest possible one: far above the rounding of a
# compiler and far below the change by one step.
pictures=( # name, tolerance, frame, scene, options
    "block 0.01 8 $here/block.toml"
    "organ_section 0.01 2 $scenes/organ.toml --section 0.3,0.2,1,0"
    "clutter_section 0.01 2 $scenes/clutter.toml --section 0,0,1,0"
    "cloth_strain 0.01 6 $scenes/cloth_cut.toml --show strain"
    "block_layers 0.01 8 $here/block.toml --show glass,particles,wires"
)
failed=0
for picture in "${pictures[@]}"; do
    read -r name tolerance frame scene options <<<"$picture"
    # shellcheck disable=SC2086
    "$viewer" "$scene" --headless --picture-frames "$frame" --size 320x180 --out "$folder/$name" $options >"$folder/$name.out" 2>&1 ||
        { cat "$folder/$name.out"; exit 1; }
    driver=$(sed -n 's/.* on \([A-Za-z0-9]*\).*/\1/p' "$folder/$name.out" | head -n 1)
    now=$folder/$name.png
    convert "$folder/$name"/frame_*.png -strip +dither -colors 96 "PNG8:$now"
    if [[ ${SINEW_STORE:-0} == 1 ]]; then
        mkdir -p "$stored/$driver"
        cp "$now" "$stored/$driver/$name.png"
        continue
    fi
    [[ -d $stored/$driver ]] || { echo "SKIPPED: no pictures of the driver $driver are stored"; exit 77; }
    differ() { compare -metric RMSE "$1" "$now" "$folder/$name.difference.png" 2>&1 | sed 's/.*(\(.*\)).*/\1/' || true; }
    by=$(differ "$stored/$driver/$name.png")
    echo "$name: differs by $by, $tolerance is allowed"
    if awk "BEGIN { exit !($by <= $tolerance) }"; then
        rm "$folder/$name.difference.png"
    else
        cp "$stored/$driver/$name.png" "$folder/$name.stored.png"
        failed=1
    fi
    # A picture shifted by two pixels must fail.
    convert "$stored/$driver/$name.png" -roll +2+1 "$folder/moved.png"
    moved=$(compare -metric RMSE "$folder/moved.png" "$now" null: 2>&1 | sed 's/.*(\(.*\)).*/\1/' || true)
    awk "BEGIN { exit !($moved > $tolerance) }" || { echo "FAILED: $name moved by two pixels passes: $moved"; exit 1; }
done
((failed == 0)) || { echo "FAILED: see $folder/*.stored.png, *.png and *.difference.png"; exit 1; }
echo "passed"
