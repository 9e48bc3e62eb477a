#!/usr/bin/env bash
# test_framing.sh VIEWER SCENE FOLDER: bodies are framed in the part of the window that the panels leave, in
# windows of several sizes, when it changes and when the panels are hidden; a pin appears under the pointer. Before
# the first picture a text stands in the window.
# FOLDER keeps the screenshots.
set -euo pipefail
viewer=$1 scene=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
extent=800x500
. "$here/window.sh"

# The box of the red pixels in FILE between x = 0 and x = WIDTH, as "left top right bottom". ImageMagick would
# count transparent borders, and its -fx takes two seconds of processor time.
boxOf() { # FILE WIDTH
    convert "$1" -crop "$2x${extent#*x}+0+0" +repage -colorspace sRGB -depth 8 rgb:- | python3 -c '
import sys
width = int(sys.argv[1])
data = sys.stdin.buffer.read()
pixels = zip(data[0::3], data[1::3], data[2::3])
spots = [i for i, (r, g, b) in enumerate(pixels) if r > 0.15 * 255 and r > 1.5 * g and r > 1.3 * b]
if len(spots) < 500: sys.exit("no body is seen")
xs = [i % width for i in spots]
print(min(xs), spots[0] // width, max(xs), spots[-1] // width)' "$2"
}
expectInside() { # FILE FREE WHAT: the body is whole, in the middle of the free part, and not tiny
    local left top right bottom
    read -r left top right bottom <<<"$(boxOf "$1" "$2")"
    ((left > 4 && right < $2 - 5 && top > 4 && bottom < ${extent#*x} - 5)) ||
        fail "$3: the body is cut off: x from $left to $right of $2, y from $top to $bottom"
    local middle=$(((left + right) / 2))
    ((middle > $2 * 40 / 100 && middle < $2 * 60 / 100)) || fail "$3: the body is not in the middle: $left to $right of $2"
    ((right - left > $2 / 4)) || fail "$3: the body is tiny: $left to $right of $2"
}
resize() { # WIDTH HEIGHT
    extent=$1x$2
    xdotool windowsize "$window" "$1" "$2"
    await 60 hasSize "$extent"
}
panel=320 # width of the panels with their margins

echo "framing: a text before the first picture"
launch "$viewer" "$scene" "${options[@]}" --size "$extent" --panels
awaitWindow '^Sinew'
for _ in {1..600}; do
    now=$(title)
    shoot text.png
    [[ $(convert text.png -format '%[fx:mean > 0.1 ? 1 : 0]' info:) == 1 ]] && break
    sleep 0.05 # the text stands for a moment
done
[[ $now == *preparing* ]] || fail "the window is black until the first picture: $now"
colors=$(convert text.png -format %k info:)
((colors > 8 && colors < 300)) || fail "no text on a plain ground: $colors colors"
lit() { convert text.png -crop "$1" +repage -colorspace gray -format '%[fx:maxima > 0.85 ? 1 : 0]' info:; }
[[ $(lit 200x60+300+220) == 1 ]] || fail "no text in the middle"
[[ $(lit 800x200+0+0) == 0 ]] || fail "more than a text before the first picture"

echo "framing: beside the panels of a small window"
awaitTitle fps
xdotool windowmove "$window" 0 0
keys space
awaitTitle paused
awaitStill small.png
expectInside small.png $((800 - panel)) "at first"

echo "framing: a pin stands under the pointer"
read -r left top right bottom <<<"$(boxOf small.png $((800 - panel)))"
x=$(((left + right) / 2)) y=$(((top + bottom) / 2))
xdotool mousemove $x $y
awaitIdle
keys n
awaitOther small.png pinned.png "N pins nothing"
pins() { # the place of the blue pixels beside the toolbar, whose lit tool is blue, too
    convert "$1" -crop "$((800 - panel))x500+0+0" +repage -colorspace sRGB -depth 8 rgb:- | python3 -c '
import sys
width = int(sys.argv[1])
data = sys.stdin.buffer.read()
spots = [i for i, (r, b) in enumerate(zip(data[0::3], data[2::3])) if b > 1.6 * r and b > 0.3 * 255 and i % width > 70]
print(sum(i % width for i in spots) // max(len(spots), 1), sum(i // width for i in spots) // max(len(spots), 1), len(spots))' $((800 - panel))
}
read -r pinX pinY count <<<"$(pins pinned.png)"
((count > 8)) || fail "no pin is seen"
((pinX - x < 5 && x - pinX < 5 && pinY - y < 5 && y - pinY < 5)) || fail "the pin is drawn at $pinX, $pinY, not at $x, $y"

echo "framing: without panels, in a larger window, and again beside panels"
keys Tab
awaitOther pinned.png hidden.png "Tab hides nothing"
expectInside hidden.png 800 "without panels"
resize 960 600
awaitStill large.png
expectInside large.png 960 "in a larger window"
keys Tab
awaitOther large.png beside.png "Tab shows nothing"
expectInside beside.png $((960 - panel)) "beside the panels again"

echo "framing: a view that a person has chosen stays, except for the shift"
xdotool mousemove 300 560 mousedown 3 # orbits
glide 5 10 2
xdotool mouseup 3
awaitStill orbited.png
read -r left top right bottom <<<"$(boxOf orbited.png $((960 - panel)))"
keys Tab
awaitOther orbited.png wide.png "Tab hides nothing"
read -r left2 top2 right2 bottom2 <<<"$(boxOf wide.png 960)"
((left2 - left > panel / 2 - 4 && left2 - left < panel / 2 + 4 && right2 - right > panel / 2 - 4 && right2 - right < panel / 2 + 4)) ||
    fail "the view did not move by half a panel: $left to $right became $left2 to $right2"
((top2 - top < 3 && top - top2 < 3 && bottom2 - bottom < 3 && bottom - bottom2 < 3)) || fail "the view changed its size"
keys Tab

echo "framing: nothing moves while a button is down"
awaitStill again.png
xdotool mousemove 300 560 mousedown 3
keys Tab
awaitOther again.png held.png "Tab hides nothing"
read -r left2 top2 right2 bottom2 <<<"$(boxOf held.png $((960 - panel)))"
((left2 - left < 3 && left - left2 < 3 && right2 - right < 3 && right - right2 < 3)) ||
    fail "the picture moved under a pressed button: $left to $right became $left2 to $right2"
xdotool mouseup 3
awaitOther held.png released.png "the picture stays beside panels that are gone"
read -r left2 top2 right2 bottom2 <<<"$(boxOf released.png 960)"
((left2 - left > panel / 2 - 4 && left2 - left < panel / 2 + 4)) || fail "the view did not move by half a panel: $left became $left2"
keys Tab
keys Home
awaitOther orbited.png home.png "Home changes nothing"
expectInside home.png $((960 - panel)) "on request"
quit
sed -i '/^mesh "organ"/d' viewer.err # the size of the mesh
awaitEnd 0
echo "passed"
