#!/usr/bin/env bash
# test_first_use.sh VIEWER FOLDER: things first used while a scene plays (layers, a section, pictures, a film,
# larger contact capacity, a second solver) must appear, and the thread that handles keys must make no
# pipeline for them.
set -euo pipefail
viewer=$1 folder=$2
here=$(cd "$(dirname "$0")" && pwd)
extent=320x200
options=(--validation --timing)
. "$here/window.sh"

# Capacity for a single neighbour.
cat >crowd.toml <<'TOML'
name = "crowd"
[solver]
substeps = 9
[contacts]
room = 1
[[box]]
name = "a"
particles = [8, 8, 8]
spacing = 0.05
collides = true
center = [0, 0.5, 0]
young_modulus = 3e4
density = 1000
cuttable = true
color = [0.70, 0.20, 0.16]
[[box]]
name = "b"
particles = [4, 4, 4]
spacing = 0.05
collides = true
center = [0, 1.0, 0]
young_modulus = 3e4
density = 1000
color = [0.20, 0.40, 0.70]
[[plane]]
TOML
scene=crowd.toml
start
xdotool windowmove "$window" 0 0
xdotool mousemove 160 110
reds() { # FILE: number of pixels of the red body; color maps have none
    red "$1" 1.5 30% -format '%[fx:round(mean*w*h)]'
}
echo "first use: more room for contacts, while the window goes on"
inputs() { grep -c '^input: ' viewer.out || true; }
isSaved() { (($(inputs) > before)); }
for _ in {1..600}; do
    before=$(inputs)
    keys F8
    await 60 isSaved
    room=$(cat crowd-*.input | sed -n 's/^room //p' | sort -n | tail -n 1)
    ((${room:-1} > 1)) && break
    sleep 0.1
done
((room > 1)) || fail "there is no more room for contacts"
keys space
awaitTitle paused
shoot bare.png
(($(reds bare.png) > 100)) || fail "no body is seen"
echo "first use: every layer and the section"
keys l 1 2 3 4 5 m i # the first group is made, then the things requested meanwhile
areMapped() { awaitStill layers.png && (($(reds layers.png) < 20)); }
within 180 areMapped || fail "bodies do not get the colors of the map"
echo "first use: a picture, a film"
keys F12
await 60 says '^picture: '
grep -q '^picture: ' viewer.out || fail "F12 made no picture"
keys F9
await 60 says '^recording '
awaitStill layers.png
keys period
awaitOther layers.png filmed.png "a step changes nothing"
keys F9
await 60 says '^[1-9][0-9]* pictures\? in '
echo "first use: another solver beside"
line() { convert "$1" -crop 2x160+159+0 +repage -colorspace sRGB -format '%[fx:mean < 0.1 ? 1 : 0]' info:; } # dark line between the halves
areHalves() { shoot halves.png && [[ $(line halves.png) == 1 ]]; }
awaitHalves() { pause=3 within 90 areHalves || fail "$1"; } # WHY
[[ $(line layers.png) == 0 ]] || fail "there are halves before B"
keys b
awaitHalves "B compares nothing where gauss_seidel cannot play the scene"
[[ ! -s viewer.err ]] || fail "something was said on stderr"
quit
awaitEnd 0
(($(grep -c 'pipelines made while keys waited: 0$' viewer.out) == 1)) || fail "the window's thread made pipelines: $(grep pipelines viewer.out)"
grep -q 'pipelines made while keys waited: [^0]' viewer.out && fail "the window's thread made pipelines: $(grep pipelines viewer.out)"

echo "first use: a solver that was chosen and cannot play the scene is refused"
start --beside gauss_seidel
refused() { grep -q "^warning: Can't compare: .*solver gauss_seidel does not support" viewer.err; }
await 60 refused
(($(wc -l <viewer.err) == 1)) || fail "more was said on stderr: $(cat viewer.err)"
: >viewer.err
quit
awaitEnd 0

echo "first use: another solver beside the first, in halves"
sed -e '/cuttable/d' -e '/collides/d' -e s/crowd/loose/ crowd.toml >loose.toml
scene=loose.toml
start --beside jacobi
xdotool windowmove "$window" 0 0
awaitHalves "--beside shows no halves"
halfReds() { convert "$1" -crop "160x200+$2+0" +repage half.png && reds half.png; }
(($(halfReds halves.png 0) > 30 && $(halfReds halves.png 160) > 30)) || fail "a body is missing in a half"
keys F12 # writes a picture that is copied where the window's pictures are shown
await 60 says '^picture: ' # of halves
grep -qv '^warning: beside: .* softer than asked' viewer.err && fail "a picture of halves: $(cat viewer.err)"
: >viewer.err
keys b
isWhole() { shoot whole.png && [[ $(line whole.png) == 0 ]]; }
pause=3 within 30 isWhole || fail "B does not end it"
quit
awaitEnd 0
(($(grep -c 'pipelines made while keys waited: 0$' viewer.out) == 1)) || fail "the window's thread made pipelines: $(grep pipelines viewer.out)"

echo "first use: B compares in the next scene, too, which needs another default"
: >viewer.err
start
keys b
awaitHalves "B shows no halves"
keys Prior
awaitTitle 'crowd.*fps' # the picture is that of the scene
awaitHalves "the comparison ends with the scene: $(cat viewer.err)"
grep -q "Can't compare" viewer.err && fail "another default was not tried: $(cat viewer.err)"
: >viewer.err
quit
awaitEnd 0
echo passed
