#!/usr/bin/env bash
# test_lost_display.sh VIEWER SCENE FOLDER: the display disappears during a film, while a scene loads, and
# after a cut. The viewer must report it in one line and end by itself, with whole pictures in its film, kept
# settings, and an input log that can be replayed.
set -euo pipefail
viewer=$1 player=$1 scene=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
extent=640x480
if [[ ! ${4:-} ]]; then
    for loss in film load hands full; do "$0" "$1" "$2" "$3/$loss" "$loss"; done
    exit
fi
. "$here/window.sh"

if [[ $4 == full ]]; then # lets the viewer run in a folder that is removed later
    mkdir gone
    printf '#!/bin/sh\ncd "%s/gone" && exec "%s" "$@"\n' "$folder" "$viewer" >start
    chmod +x start
    viewer=$folder/start
fi
start
case $4 in
film)
    keys F9
    filmed() { (($(find . -name '*.png' | wc -l) >= 3)) || compgen -G '*.part' >/dev/null; } # pictures without ffmpeg, a partial film with it
    await 30 filmed ;;
load)
    keys Next ;;
*)
    keys v
    cutDown 320 100 420 ;;
esac
kept=$folder
if [[ $4 == full ]]; then
    rmdir gone
    kept=$folder/config/sinew
fi
kill "${processes[0]}" # the X server
await 60 hasEnded
code=0
wait "$running" || code=$?
[[ $code == 4 ]] || fail "exit code $code, expected 4"
(($(wc -l <viewer.err) == 1)) || fail "not one line on stderr"
grep -q '^error: the window was closed: its display went away' viewer.err || fail "nothing was said of the display"
for picture in $(find . -name '*.png'); do
    convert "$picture" null: || fail "$picture is not whole"
done
grep -q "^scene = $scene\$" config/sinew/viewer.conf || fail "the scene on show is not remembered"
if [[ $4 == film || $4 == load ]]; then
    [[ -z $(find . -name '*.input') ]] || fail "hands did nothing, and that was kept"
else
    grep -q '^vsync = false$' config/sinew/viewer.conf || fail "what V chose is not remembered"
    input=$(sed -n 's/.*: --replay \(.*\) replays the input$/\1/p' viewer.err)
    [[ $input == "$kept"/block-*.input && -s $input ]] || fail "what hands did is not kept"
    played() { # LOG: state at the end of its replay
        "$player" --headless --replay "$1" >replay.out 2>replay.err || fail "the replay failed: $(cat replay.err)"
        sed -n 's/^state hash \([0-9a-f]*\) after [1-9][0-9]* steps.*/\1/p' replay.out
    }
    hands=$(played "$input")
    grep -e '^sinew' -e '^scene' -e '^solver' -e '^substeps' -e '^steps' "$input" >idle.input
    idle=$(played idle.input)
    [[ -n $hands && -n $idle && $hands != "$idle" ]] || fail "the replay does not cut: $hands, $idle without hands"
fi
echo "$4: passed"
