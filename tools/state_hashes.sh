#!/usr/bin/env bash
# tools/state_hashes.sh [--update]: runs every shipped scene for 60 steps, on one thread, on all, and reversed, and compares
# the hashes of their states with tests/golden/state_hashes.txt. A change that should keep all bits is checked with it.
#   --update   writes the table instead
# The hashes hold for the device in the first line of the table: other drivers round square roots and quotients otherwise,
# and there only the equality of the three runs is checked. Takes some minutes; `tools/run.sh` builds what it needs.
set -euo pipefail
cd "$(dirname "$0")/.."
sinew=build/release/bin/sinew
table=tests/golden/state_hashes.txt
for icd in /usr/share/vulkan/icd.d/lvp_icd.*.json; do export VK_ICD_FILENAMES=$icd; done
left_out='pile_100k|drop_mesh' # too large for a quick check; needs a mesh
steps=60

# hash_of THREADS SCENE [options]: the hash of the state after the steps.
hash_of() {
    local threads=$1
    shift
    local output
    output=$(LP_NUM_THREADS=$threads "$sinew" run "$@" --frames $steps 2>&1) || { echo "$output" >&2 && exit 1; }
    sed -n 's/^state hash: //p' <<<"$output"
}

device=$("$sinew" devices | sed -n 's/^\* *[0-9][0-9]* *//p')
lines="device: $device"
failed=0
for scene in scenes/*.toml; do
    name=$(basename "$scene" .toml)
    [[ $name =~ ^($left_out)$ ]] && continue
    one=$(hash_of 0 "$scene")
    all=$(hash_of "$(nproc)" "$scene")
    reversed=$(hash_of "$(nproc)" "$scene" --reversed)
    if [[ $one != "$all" || $one != "$reversed" ]]; then
        echo "$name: $one on one thread, $all on all, $reversed reversed"
        failed=1
    fi
    lines+=$'\n'"$name $one"
done
if [[ ${1:-} == --update ]]; then
    echo "$lines" >"$table"
elif [[ $(head -n1 "$table") == "device: $device" ]]; then
    diff "$table" <(echo "$lines") || failed=1
else
    echo "$(head -n1 "$table"), here $device: the table is not compared"
fi
[[ $failed == 1 ]] || echo "states of $(($(wc -l <<<"$lines") - 1)) scenes: no difference"
exit "$failed"
