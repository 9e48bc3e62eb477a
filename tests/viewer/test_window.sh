#!/usr/bin/env bash
# test_window.sh VIEWER SCENE FOLDER: plays the scene in a window under Xvfb with validation, and drives it
# with mouse, keys and many changes of size. Expects a moving picture, a clean end and no messages. FOLDER
# keeps the screenshots.
set -euo pipefail
viewer=$1 scene=$2 folder=$3

here=$(cd "$(dirname "$0")" && pwd)
extent=640x400
. "$here/window.sh"

drag() { # BUTTON DX DY
    xdotool mousemove 300 200 mousedown "$1"
    glide 5 "$2" "$3"
    xdotool mouseup "$1"
}
echo "window: orbit, pan, zoom, pause"
threads=$LP_NUM_THREADS
unset LP_NUM_THREADS # so this viewer tries steps without threads at its end, under validation
start
export LP_NUM_THREADS=$threads
xdotool windowmove "$window" 0 0
keys space
awaitTitle paused
awaitStill paused.png
drag 3 30 -8
awaitOther paused.png orbited.png "an orbit drag changed nothing"
drag 1 0 30 # still on the body: it is held while paused, and the camera does not move
drag 3 -20 0
drag 2 12 6
xdotool click 4 click 4 click 5
awaitOther orbited.png moved.png "pan and wheel changed nothing"
colors=$(convert orbited.png -format %k info:)
((colors > 500)) || fail "the picture has only $colors colours"

echo "window: frame, step, reset, screenshot, vsync, help, panels"
keys Home
awaitOther moved.png framed.png "F changed nothing"
xdotool key --window "$window" --repeat 20 period
awaitOther framed.png stepped.png "twenty steps changed nothing"
keys r
awaitOther stepped.png reset.png "R changed nothing"
keys F12
await 60 says '^picture: '
xdotool key --window "$window" --delay 100 --repeat 4 F12 # pictures of one step, some while others are being written
areWritten() {
    pictures=$(find . -name 'block-000000*.png' | wc -l)
    ((pictures > 1 && pictures == $(grep -c '^picture: ' viewer.out)))
}
awaitIdle
within 30 areWritten || true
[[ $(sort -u <<<"$(grep '^picture: ' viewer.out)" | wc -l) == "$pictures" ]] || fail "two pictures have one name: $(cat viewer.out)"
((pictures > 1)) || fail "there is no second picture of a step"
[[ $(identify -format '%wx%h' block-000000.png) == 640x400 ]] || fail "F12 wrote no picture of the window's size"
dark() { # FILE CROP: whether a panel covers this part, which is light or red without one
    [[ $(convert "$1" -crop "$2" +repage -colorspace sRGB -format '%[fx:mean < 0.33 ? 1 : 0]' info:) == 1 ]]
}
middle=200x200+220+100 side=200x200+420+40
keys v v
awaitStill still.png
dark still.png $middle && fail "something covers the middle"
keys h
awaitStill help.png
dark help.png $middle || fail "H shows no help"
xdotool type --window "$window" --delay 50 redo
awaitOther help.png found.png "typing does not search the help"
keys Escape
awaitStill closed.png
dark closed.png $middle && fail "Escape does not close the help"
dark closed.png $side && fail "panels cover a small window unasked"
keys Tab
awaitStill panels.png
dark panels.png $side || fail "Tab shows no panels"
keys F2
awaitOther panels.png gallery.png "F2 shows no gallery"
xdotool mousemove 20 380 click 1 # beside it
awaitOther gallery.png closed.png "a press in the scene does not close the gallery"
for picture in panels closed; do convert $picture.png -crop 180x160+440+150 +repage $picture-part.png; done
alike panels-part.png closed-part.png || fail "a press in the scene leaves a part of the gallery"
xdotool mousemove 390 154 click 1 # its button resumes, like Space
awaitTitle fps
keys space
awaitTitle paused
keys Tab
awaitStill hidden.png
dark hidden.png $side && fail "Tab does not hide the panels"

echo "window: section, what the pointer is on framed, what the camera turns around"
xdotool mousemove 300 200
keys l
awaitOther hidden.png opened.png "L opens nothing"
xdotool keydown alt click 5 click 5 keyup alt
awaitOther opened.png slid.png "Alt and the wheel do not move the plane"
keys shift+l
awaitOther slid.png turned.png "Shift + L does not turn the plane"
keys l
awaitSame hidden.png closed.png "L does not close what it has opened, or leaves something behind"
xdotool click --repeat 2 --delay 50 1
awaitOther closed.png centered.png "a double click changes nothing"
keys f
awaitOther centered.png body.png "F changes nothing"

echo "window: a hand grabs the body, lifts it and lets go"
# The block is the only red object. Prints the rows of its lowest and its highest pixel.
rows() { # FILE
    red "$1" 1.5 30% -trim -format '%O %h\n' | sed 's/.*+\([0-9]*\) \([0-9]*\)$/\1 \2/'
}
awaitRest() {
    for _ in {1..120}; do
        shoot one.png
        sleep 1 # real time of playing: at rest is what does not move in it
        shoot two.png
        [[ $(rows one.png) == "$(rows two.png)" ]] && return
    done
    fail "the block does not come to rest"
}
keys r
keys space
awaitTitle fps
awaitRest # on the floor
keys space
awaitTitle paused
awaitStill fallen.png
keys Home
awaitOther fallen.png nearer.png "Home does not frame what has fallen"
xdotool mousemove 320 200 click --repeat 5 --delay 50 5
awaitOther nearer.png before.png "the wheel changes nothing"
keys space
awaitTitle fps
read -r top height < <(rows before.png)
((height > 20)) || fail "the block is not seen: $height rows"
awaitTop() { # FILE TEST ROW: waits until the block's top is there
    isThere() {
        shoot "$1"
        read -r now height < <(rows "$1")
        test "$now" "$2" "$3"
    }
    pause=3 within 30 isThere "$@" || fail "the top of the block is at $now, not $2 $3"
}
xdotool mousemove 320 $((top + height / 2)) mousedown 1
awaitTitle holding
glide 12 0 -8
awaitTop held.png -lt $((top - 30))
lifted=$now
for _ in {1..20}; do # a slow window shows it on its way up
    sleep 0.5 # real time of playing
    shoot held.png
    read -r now height < <(rows held.png)
    ((now < lifted)) || break
    lifted=$now
done
xdotool mouseup 1
await 60 lacksTitle holding
[[ $(title) != *holding* ]] || fail "the block was not let go"
awaitTop dropped.png -gt $((lifted + 20)) # at any place
keys space
awaitTitle paused

echo "window: a blade cuts it through, the halves part, undo joins them"
inside() { # FILE: pixels of the inside, the only dark red ones
    red "$1" 2 8% -format '%[fx:round(mean*w*h)]'
}
keys space
awaitTitle fps
awaitRest
read -r now height < <(rows two.png)
xdotool keydown ctrl mousemove 100 100 mousemove 110 100
awaitTitle blade
xdotool keyup ctrl
await 60 lacksTitle blade
[[ $(title) != *blade* ]] || fail "the blade stays when Ctrl is let go"
keys c
awaitTitle blade
strokes=0
stroke() {
    strokes=$((strokes + 1))
    xdotool mousemove 320 $((now - 25)) mousedown 1
    glide $(((height + 67) / 8)) 0 8
    xdotool mouseup 1
}
stroke
within 30 hasTitle pieces || stroke # if the slow window saw only an end of the first stroke
awaitTitle 'pieces'
keys c # back to the grab tool
shoot cut.png
xdotool mousemove 345 $((now + height / 2)) mousedown 1
awaitTitle holding
glide 20 8 -3
isParted() { shoot parted.png && (($(inside parted.png) > 200)); }
pause=3 within 30 isParted || fail "the inside is not seen: $(inside parted.png) pixels of it"
xdotool mouseup 1
keys space
awaitTitle paused
for ((undo = 1; undo < strokes; ++undo)); do keys ctrl+z; awaitIdle; done # of a stroke beside
keys ctrl+z
await 60 lacksTitle pieces # at once: no step follows
awaitStill undone.png # the title changes before the picture
(($(inside undone.png) < 50)) || fail "the inside is still seen: $(inside undone.png) pixels of it"
for ((redo = 1; redo < strokes; ++redo)); do keys ctrl+shift+z; awaitIdle; done
keys ctrl+shift+z
awaitTitle 'pieces.*paused'
keys space
awaitTitle fps
for knob in k k d t shift+g; do keys $knob; done # the log below contains them
hasFile() { compgen -G "$1" >/dev/null; }
saveInput() { # as the only log in the folder
    rm -f block-*.input
    keys F8
    await 60 hasFile 'block-*.input'
}
areTurned() {
    saveInput
    grep -q '^material 2 1 0\.6' block-*.input && grep -q '^gravity 9\.5' block-*.input
}
await 60 areTurned
keys space
awaitTitle paused

echo "window: what hands did leads to the same state without a window"
saveInput
await 60 says "^input: $(echo block-*.input),"
hash=$(sed -n 's/^input: .*\(state hash .* steps\)$/\1/p' viewer.out | tail -n 1)
[[ -n $hash ]] || fail "F8 saved no input"
grep -q '^material 2 1 0\.6' block-*.input && grep -q '^gravity 9\.5' block-*.input || fail "keys turned no knobs: $(grep '^material\|^gravity' block-*.input)"
"$viewer" --headless --replay block-*.input >replay.out 2>replay.err || fail "the replay failed: $(cat replay.err)"
grep -q "^$hash, as recorded$" replay.out || fail "the replay came to $(cat replay.out), not to $hash"
more=$(($(sed 's/.* after \([0-9]*\) steps/\1/' <<<"$hash") + 7))
"$viewer" --headless --replay block-*.input --frames $more >replay.out 2>replay.err || fail "the replay failed: $(cat replay.err)"
grep -q "^$hash, as recorded$" replay.out || fail "with more steps the replay came to $(cat replay.out), not to $hash"
grep -q " after $more steps$" replay.out || fail "nothing is said of the steps after the replay: $(cat replay.out)"

echo "window: a state that is saved goes on in another run, cut and seen as it was"
find . -name 'block-*.png' -delete
keys F12
await 60 hasFile 'block-*.png'
keys ctrl+s
await 60 says '^state: '
grep -q '^state: block-[0-9]*\.state$' viewer.out || fail "Ctrl + S saved no state"
for run in first second; do
    "$viewer" block-*.state --headless --frames 9 --picture-frames 0 --size 640x400 --out "$run" >"$run.out" 2>"$run.err" ||
        fail "the state does not go on: $(cat "$run.err")"
    grep '^state hash' "$run.out" >"$run.hash" || fail "nothing is said of the state in the end: $(cat "$run.out")"
done
cmp -s first.hash second.hash || fail "two runs from a state differ: $(cat first.hash second.hash)"
# The window's renderer draws the picture of F12. Its format may differ, which changes the mixing of edges.
alike block-*.png first/frame_0000.png || fail "what was saved is not seen as it was"
head -c 3000 block-*.state >short.state
"$viewer" short.state --headless --frames 1 --out short >short.out 2>short.err && fail "half a state is taken for one"
(($(grep -c '^error: cannot read a state: .*short.state: it is cut short' short.err) == 1)) || fail "half a state: $(cat short.err)"

echo "window: sizes, hiding, full screen"
keys space
awaitTitle fps
for size in "200 300" "700 120" "1 1" "640 480" "33 500" "900 650" "123 77" "640 400"; do
    xdotool windowsize "$window" $size
    sleep 0.15 # the pace of a hand: some sizes are drawn, others are not
done
for size in {1..30}; do xdotool windowsize "$window" $((300 + 11 * size)) $((400 - 7 * size)); done
xdotool windowunmap --sync "$window"
awaitIdle # nothing is drawn while it is hidden
xdotool windowmap "$window"
keys F11
await 60 hasSize "$screen"
keys F11
await 60 lacksSize "$screen"
awaitTitle fps
quit
awaitEnd 0
uncut=$scene
scene=$(echo block-*.state)
state=$scene
start
awaitTitle 'pieces'

echo "window: what hands did since a state was loaded leads there again, in the window and without"
xdotool mousemove 320 $((now + height / 2)) mousedown 1
glide 10 4 -6
xdotool mouseup 1
keys space
awaitTitle paused
rm block-*.input
keys F8
await 60 says '^input: '
hash=$(sed -n 's/^input: .*\(state hash .* steps\)$/\1/p' viewer.out)
[[ -n $hash ]] || fail "F8 saved no input of a state"
log=$(echo block-*.input)
grep -q '^press ' "$log" || fail "what hands did is not in the log"
quit
awaitEnd 0
"$viewer" --headless --replay "$log" >replay.out 2>replay.err || fail "the replay failed: $(cat replay.err)"
grep -q "^$hash, as recorded$" replay.out || fail "from a state the replay came to $(cat replay.out), not to $hash"
scene=
played() { within 60 says "^$hash, as recorded$" || fail "the replay in the window did not come to $hash"; }
start --replay "$log"
played
quit
awaitEnd 0
start --replay "$log"
keys r # starts it again
beginsAgain() { (($(grep -c ' particles, ' viewer.out) >= 2)); }
await 30 beginsAgain
played
quit
awaitEnd 0
cp "$state" kept.state
sed 's/^from [0-9a-f]*/from 123/' "$log" >other.input
for run in "--headless" ""; do
    code=0
    "$viewer" $run --replay other.input >replay.out 2>replay.err || code=$?
    [[ $code == 3 && $(wc -l <replay.err) == 1 ]] || fail "from another state: exit code $code: $(cat replay.err)"
    grep -q '^error: cannot play input: it begins from a state: /.*/block-' replay.err || fail "from another state: $(cat replay.err)"
done
rm "$state"
code=0
"$viewer" --headless --replay "$log" >replay.out 2>replay.err || code=$?
[[ $code == 3 && $(wc -l <replay.err) == 1 ]] || fail "without its state: exit code $code: $(cat replay.err)"
mv kept.state "$state"
scene=$state
start
awaitTitle 'pieces'
keys r
await 60 lacksTitle pieces
[[ $(title) != *pieces* ]] || fail "a reset does not lead from a state to the start of its scene"
quit
awaitEnd 0
scene=$uncut

echo "window: another scene, one that cannot be opened, a film"
mkdir scenes
cp "$scene" scenes/block.toml
printf 'name = "other"\n[[box]]\nparticles = [4, 4, 4]\ncenter = [0, 0.5, 0]\nspacing = 0.1\n[[plane]]\n' >scenes/other.toml
echo 'name = ' >scenes/broken.toml
scene=scenes/block.toml
start
keys Prior # Page Up wraps around the end of the list
awaitTitle 'other'
keys space
awaitTitle paused
keys Prior
await 60 test -s viewer.err
[[ $(cat viewer.err) == "warning: cannot read scene: "*broken.toml* ]] || fail "a scene that is none was not refused in a line"
[[ $(title) == *other*paused* ]] || fail "a scene that is none took the place of one"
keys F9
await 60 says '^recording other-'
awaitStill filmed.png
for step in {1..4}; do # one after the other, because a busy machine is slow to draw a whole picture
    mv filmed.png unfilmed.png
    keys period
    awaitOther unfilmed.png filmed.png "step $step of the film changes nothing"
done
keys F9
await 60 says '^4 pictures in other-'
grep -q '^4 pictures in other-' viewer.out || fail "F9 made no film of the four steps"
film=$(sed -n 's/^recording //p' viewer.out)
[[ -s $film && ( ! -d $film || -s $film/frame_0003.png ) ]] || fail "the film is not there"
[[ $(wc -l <viewer.err) == 1 ]] || fail "more was said on stderr"
keys ctrl+o
awaitOther filmed.png asked.png "Ctrl + O asks for no path"
xdotool type --window "$window" --delay 50 "$folder/scenes/block.toml"
keys Return
awaitTitle 'block'
keys Prior
awaitTitle 'other'
keys space
awaitTitle paused
awaitStill asked.png
keys ctrl+o
awaitOther asked.png listed.png "Ctrl + O lists no files"
xdotool type --window "$window" --delay 50 block.t # a part of a name chooses in the list
keys Return
awaitTitle 'block'
keys Tab # the panels into which it was typed
keys Prior
awaitTitle 'other'
quit
code=0
wait "$running" || code=$?
[[ $code == 0 ]] || fail "exit code $code, expected 0"

echo "window: without a scene the last one, interrupted"
mkdir bin # replaces ffmpeg: its last argument is the file
printf '#!/bin/sh\nfor last; do :; done\nexec cat >"${last#file:}"\n' >bin/ffmpeg
chmod +x bin/ffmpeg
PATH=$folder/bin:$PATH
grep -q '^scene = .*/scenes/other.toml$' config/sinew/viewer.conf || fail "the last scene is not remembered"
scene=
start
[[ $(title) == *other* ]] || fail "the last scene is not opened again"
keys F9
await 60 isFilming 1000k
kill -INT "$running"
code=0
wait "$running" || code=$?
[[ $code == 130 && $(grep -c "^error: interrupted" viewer.err) == 1 ]] || fail "interrupted: exit code $code, $(cat viewer.err)"
film=$(sed -n 's/^recording //p' viewer.out)
bytes=$(stat -c %s "$film") || fail "interrupted, the film is lost"
((bytes > 0 && bytes % (640 * 400 * 4) == 0)) || fail "interrupted, the film has $bytes bytes, which are no whole pictures"
[[ -z $(find . -name '*.part') ]] || fail "interrupted, there is a part of a film: $(find . -name '*.part')"

echo "window: an encoder that ends, as on a full disk, ends the film alone"
cp bin/ffmpeg whole
printf '#!/bin/sh\nhead -c 3000000 >/dev/null\nexit 1\n' >bin/ffmpeg
start
keys F9
await 60 test -s viewer.err
[[ $(cat viewer.err) == "warning: cannot write video: "*": ffmpeg has stopped: see its message above" ]] || fail "nothing was said of an encoder that ended"
mv whole bin/ffmpeg
keys space # it goes on without the encoder
awaitTitle paused
keys space
awaitTitle fps
keys F9
await 60 isFilming 1000k
keys F9
await 60 says ' pictures\? in other-.*\.mp4$'
grep -q ' pictures\? in other-.*\.mp4$' viewer.out || fail "there is no film after the one that failed"
quit
code=0
wait "$running" || code=$?
[[ $code == 0 && $(wc -l <viewer.err) == 1 ]] || fail "exit code $code, or more than one line, after an encoder that ended"

echo "window: what the command line says goes before what is remembered, and is not remembered"
cp config/sinew/viewer.conf before.conf
scene=scenes/block.toml
start --panels --no-vsync --scale 1.5 --full-screen
await 60 hasSize "$screen" # --full-screen fills it
keys space
awaitTitle paused
extent=$screen awaitStill whole.png
keys Tab
extent=$screen awaitStill bare.png
same whole.png bare.png && fail "--panels shows none" # the previous run had none in its small window
keys Tab
quit
awaitEnd 0
diff <(grep -v '^scene' before.conf) <(grep -v '^scene' config/sinew/viewer.conf) >/dev/null || fail "what the command line said is remembered: $(cat config/sinew/viewer.conf)"
start --vsync
keys v ctrl+plus # selected explicitly
quit
awaitEnd 0
grep -q '^vsync = false' config/sinew/viewer.conf || fail "what V chose is not remembered"
grep -q '^scale = 1\.125' config/sinew/viewer.conf || fail "what Ctrl + plus chose is not remembered"

echo "window: no display"
code=0
DISPLAY='' WAYLAND_DISPLAY='' "$viewer" >viewer.out 2>viewer.err || code=$?
[[ $code == 4 ]] || fail "without a display: exit code $code, expected 4"
[[ $(wc -l <viewer.err) == 1 ]] || fail "without a display: more than one line"
grep -q -- '--headless' viewer.err || fail "without a display: no way out is offered"
echo "passed"
