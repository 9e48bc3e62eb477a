#!/usr/bin/env bash
# tools/step_times.sh [STEPS [SCENE...]]: prints a table of the time of a step of every shipped scene (docs/performance.md): the median
# and what 99 % of STEPS steps (120) stay below, with one thread of the software device and with all. Needs jq and a machine without
# other load; `tools/run.sh` builds what it needs. Takes some five minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
steps=${1:-120}
(($# > 0)) && shift
for icd in /usr/share/vulkan/icd.d/lvp_icd.*.json; do export VK_ICD_FILENAMES=$icd; done
said=$(mktemp)
trap 'rm -f "$said"' EXIT
left_out='pile_100k|drop_mesh' # too large; needs a mesh
(($# > 0)) || set -- $(ls scenes/*.toml | grep -vE "/($left_out)\.toml$")

report() { # THREADS SCENE: the report of a run; ends with what the run says if it fails
    LP_NUM_THREADS=$1 build/release/bin/sinew run "$2" --frames "$steps" --json - 2>"$said" || { cat "$said" >&2 && exit 1; }
}
row='def ms: . * 100 | round / 100; ([.frame_ms.p50, .frame_ms.p99] | map(ms) | map(tostring) | join(" | "))'
echo "| scene | particles | substeps | one thread: median | 99 % | all threads: median | 99 % |"
echo "|---|---|---|---|---|---|---|"
for scene; do
    one=$(report 0 "$scene")
    all=$(report "$(nproc)" "$scene")
    echo "| \`$(basename "$scene" .toml)\` | $(jq -r '"\(.particles) | \(.substeps)"' <<<"$one") | $(jq -r "$row" <<<"$one") |" \
        "$(jq -r "$row" <<<"$all") |"
done
