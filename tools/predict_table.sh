#!/usr/bin/env bash
# tools/predict_table.sh [SCENE...]: the table of docs/performance/model.md made anew: predicted ms a step (calm;
# with lists) of shipped scenes on the cards of tools/sinew/predict/cards.csv, and the longest pass with what bounds it.
set -euo pipefail
cd "$(dirname "$0")/.."
sinew=build/release/bin/sinew
scenes=("$@")
((${#scenes[@]})) || scenes=(cloth_links cube organ stack clutter pile_8000 pile_100k clutter_bodies cloth_fold stirrer tube_slice)
mapfile -t cards < <(grep -v '^#' tools/sinew/predict/cards.csv | tail -n +2 | cut -d, -f1)

# row_of SCENE CARD: "ms of a calm step; ms with lists (longest pass: what most of it is)"
row_of() {
    "$sinew" describe "scenes/$1.toml" --predict "$2" | awk '
        /^  pass / { isFirst = 1; next }
        isFirst { pass = $1; bound = $NF; isFirst = 0 }
        /^  all: / { sub(/^  all: /, ""); sub(/ ms,.*/, ""); all = all (all == "" ? "" : "; ") $0 }
        END { gsub(/  +/, " ", all); printf "%s (%s: %s)", all, pass, bound }'
}

printf '| scene'
printf ' | %s' "${cards[@]}"
printf ' |\n|---%s|\n' "$(printf '|---%.0s' "${cards[@]}")"
for scene in "${scenes[@]}"; do
    printf '| %s' "$scene"
    for card in "${cards[@]}"; do
        row=$(row_of "$scene" "$card") # ends the script if it fails
        printf ' | %s' "$row"
    done
    printf ' |\n'
done
