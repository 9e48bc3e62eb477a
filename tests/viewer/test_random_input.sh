#!/usr/bin/env bash
# test_random_input.sh VIEWER EXAMPLES FOLDER [SECONDS]: sends random input to the window under validation:
# clicks, drags, keys, the wheel, sizes. Lasts twenty seconds and the time to end, or ten minutes with
# SINEW_FULL=1; SINEW_SEED is the seed. The viewer must not crash, hang or cause a validation message. FOLDER
# keeps the input, one line an event.
set -euo pipefail
viewer=$1 examples=$2 folder=$3
seconds=${4:-$([[ -n ${SINEW_FULL:-} ]] && echo 600 || echo 20)}
seed=${SINEW_SEED:-1}
here=$(cd "$(dirname "$0")" && pwd)
extent=900x640
. "$here/window.sh"

# A film program that discards its input, so that only the pictures cost time.
mkdir bin played
printf '#!/bin/sh\nfor last; do :; done\n: >"${last#file:}"\nexec cat >/dev/null\n' >bin/ffmpeg
chmod +x bin/ffmpeg
PATH=$folder/bin:$PATH
cp "$here/block.toml" played
cp "$examples"/{cloth,chain,clutter}.toml played
cat >played/colored.toml <<'END'
[solver]
name = "gauss_seidel"
substeps = 8
[[cloth]]
size = [12, 12]
spacing = 0.08
pinned = ["first_row"]
[[plane]]
END
printf 'name = \n' >played/broken.toml
printf 'v 0 0 0\nf 1 2 3\n' >played/broken.obj

keyNames=(k shift+k d shift+d t shift+t g shift+g space p period comma F7 r c Escape n s 1 2 3 4 5 6 m i f Home Prior Next F1 F8 F9 F11 F12 v h Tab ctrl+s ctrl+z ctrl+shift+z ctrl+plus
    ctrl+minus a b d e g j k l o t u w x y z 0 7 8 9 Return BackSpace Delete Left Right Up Down comma minus plus ctrl+a ctrl+c)
roll() { rolled=$((RANDOM % $1)); }
place() { # a point in the window or slightly outside
    roll 920; local x=$rolled
    roll 660
    event+=(mousemove "$x" "$rolled")
}
# Sleeps between events are real time: they spread the events over pictures.
drag() { # BUTTON
    place
    event+=(mousedown "$1")
    roll 8
    for ((way = rolled + 1; way > 0; --way)); do
        roll 160; local dx=$((rolled - 80))
        roll 160
        event+=(mousemove_relative -- "$dx" $((rolled - 80)) sleep 0.02)
    done
    event+=(mouseup "$1")
}
throw() { # chooses one event
    event=()
    roll 100
    local kind=$rolled
    if ((kind < 30)); then
        drag 1
    elif ((kind < 38)); then
        roll 2; drag $((rolled + 2))
    elif ((kind < 50)); then
        place; roll 3
        event+=(click $((rolled + 1)))
    elif ((kind < 55)); then # in the panels on the right
        roll 280; local x=$((610 + rolled))
        roll 620
        event+=(mousemove "$x" "$rolled" click 1)
    elif ((kind < 62)); then
        place; roll 2; local button=$((rolled + 4))
        roll 6
        local notches=$((rolled + 1))
        roll 3 # with Shift it resizes the poke
        ((rolled > 0)) || event+=(keydown shift)
        event+=(click --repeat "$notches" --delay 10 "$button")
        ((rolled > 0)) || event+=(keyup shift)
    elif ((kind < 93)); then
        roll ${#keyNames[@]}
        event+=(key "${keyNames[rolled]}")
    elif ((kind < 97)); then
        roll 900; local width=$((rolled + 20))
        roll 650
        event+=(windowsize "$window" "$width" $((rolled + 20)))
    elif ((kind < 98)); then
        event+=(windowunmap "$window" sleep 0.2 windowmap "$window")
    else
        event+=(keydown ctrl)
        drag 1
        event+=(keyup ctrl)
    fi
}
checkWords() { # checks the output of a running or ended viewer
    ! grep -q '^validation:' viewer.err || fail "validation has something to say, see $folder/events"
}
checkEnd() { # input can reach the quit button, too
    local code=0
    wait "$running" || code=$?
    [[ $code == 0 ]] || fail "exit code $code, expected 0, see $folder/events"
    checkWords
    scenes=$((scenes + $(grep -c ' on .* (' viewer.out)))
    warnings=$((warnings + $(grep -c '^warning' viewer.err || true)))
    runs=$((runs + 1))
}
isUp() { kill -0 "$running" 2>/dev/null; }
begin() {
    start
    xdotool windowmove "$window" 0 0 windowfocus "$window"
}

echo "random input: $seconds s, seed $seed"
RANDOM=$seed
scene=played/block.toml scenes=0 warnings=0 runs=0 events=0 sent=0
begin
keys Prior # loads another scene in any case
until=$((SECONDS + seconds))
while ((SECONDS < until)); do
    throw
    echo "${event[*]}" >>events
    if xdotool "${event[@]}" >/dev/null 2>&1; then sent=$((sent + 1)); fi # fails if the window has just closed
    events=$((events + 1))
    roll 4
    sleep "0.0$rolled"
    if ! isUp; then
        checkEnd
        xdotool keyup ctrl mouseup 1 mouseup 2 mouseup 3
        begin
    fi
    ((events % 20 == 0)) || continue
    checkWords
    rm -f ./*.png ./*.mp4
    xdotool windowsize "$window" 900 640 windowmove "$window" 0 0 2>/dev/null || true # location of its panels
done
checkWords
xdotool keyup ctrl keyup shift mouseup 1 mouseup 2 mouseup 3
xdotool windowmap "$window" windowsize "$window" 900 640 2>/dev/null || true
for _ in {1..900}; do # it may have many events left
    isUp || break
    xdotool key --window "$window" Escape ctrl+q 2>/dev/null || true
    sleep 0.2
done
isUp && fail "Ctrl + Q does not end it: it hangs"
checkEnd
echo "$events events, $sent sent, $runs runs, $scenes scenes, $warnings warnings"
((sent >= 20 && 2 * sent > events)) || fail "of $events events only $sent were sent"
((scenes > 1)) || fail "no other scene was seen than the first"
echo "passed"
