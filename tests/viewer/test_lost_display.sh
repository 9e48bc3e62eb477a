#!/usr/bin/env bash
# test_lost_display.sh VIEWER SCENE FOLDER: the display goes away while a film is made and while another scene is loaded. The viewer says
# so in one line and ends by itself; the pictures of its film are whole.
set -euo pipefail
viewer=$1 scene=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
extent=640x480
[[ ${4:-} ]] || { "$0" "$1" "$2" "$3/film" film && exec "$0" "$1" "$2" "$3/load" load; exit; }
. "$here/window.sh"

start
if [[ $4 == film ]]; then
    keys F9
    filmed() { (($(find . -name '*.png' | wc -l) >= 3)) || compgen -G '*.part' >/dev/null; } # without ffmpeg, with it
    for _ in {1..300}; do filmed && break; sleep 0.1; done
    filmed || fail "nothing was filmed"
else
    keys Next
fi
kill "${processes[0]}" # the X server
for _ in {1..600}; do kill -0 "$running" 2>/dev/null || break; sleep 0.1; done
code=0
wait "$running" || code=$?
[[ $code == 4 ]] || fail "exit code $code, expected 4"
(($(wc -l <viewer.err) == 1)) || fail "not one line on stderr"
grep -q '^error: the window was closed: its display went away' viewer.err || fail "nothing was said of the display"
for picture in $(find . -name '*.png'); do
    convert "$picture" null: || fail "$picture is not whole"
done
echo "$4: passed"
