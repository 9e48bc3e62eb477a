# Sourced by tests that play in a window: starts an X server and the viewer, and queries the window's title
# and picture. Needs `viewer`, `folder`, and `extent` of the window; `scene` may be empty, and `options`
# precede others. Changes to the folder.
. "$here/waits.sh"
screen=${screen:-1000x700}
[[ -v options ]] || options=(--validation)
for program in Xvfb xdotool convert; do
    command -v "$program" >/dev/null || { echo "SKIPPED: $program is not installed (packages xvfb xdotool imagemagick)"; exit 77; }
done
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

processes=()
finish() {
    for process in "${processes[@]}"; do kill "$process" 2>/dev/null || true; done
    wait
}
trap finish EXIT
fail() { # writes to stderr, because stdout may be a value
    echo "FAILED: $1" >&2
    cat viewer.out viewer.err >&2
    exit 1
}

exec 3<>"$folder/display"
Xvfb -displayfd 3 -screen 0 "${screen}x24" -fbdir "$folder" -nolisten tcp -noreset >/dev/null 2>&1 &
processes+=($!)
for _ in {1..100}; do [[ -s display ]] && break; sleep 0.1; done
[[ -s display ]] || fail "Xvfb did not start"
# The number of threads that lavapipe takes anyway. Where it is set, the viewer does not try at its end whether fewer are
# faster: two more simulations, which take most of the time of its end.
export LP_NUM_THREADS=${LP_NUM_THREADS:-$(nproc)}
export XDG_CONFIG_HOME=$folder/config
export DISPLAY=:$(tr -d '[:space:]' <display)

awaitWindow() { # NAME: waits up to two minutes. The previous program's window may remain for a while
    for _ in {1..1200}; do
        window=$(xdotool search --all --pid "$running" --name "$1" 2>/dev/null | head -n 1) && [[ -n $window ]] && break
        kill -0 "$running" 2>/dev/null || fail "the viewer ended at once"
        sleep 0.1
    done
}
launch() { # PROGRAM ARGUMENTS...: starts with empty output files, because the background shell makes its files later
    rm -f viewer.out viewer.err
    touch viewer.out viewer.err
    "$@" >>viewer.out 2>>viewer.err &
    running=$!
    processes+=("$running")
}
start() {
    launch "$viewer" ${scene:+"$scene"} "${options[@]}" --size "$extent" "$@"
    awaitWindow '^Sinew'
    awaitTitle fps
}
says() { grep -q "$1" viewer.out; }
hasEnded() { [[ ! -d /proc/$running ]]; }
hasTitle() { [[ $(title) =~ $1 ]]; }
lacksTitle() { [[ ! $(title) =~ $1 ]]; }
title() { xdotool getwindowname "$window"; }
awaitTitle() { # PATTERN
    for _ in {1..1200}; do
        [[ $(title) =~ $1 ]] && return
        kill -0 "$running" 2>/dev/null || fail "the viewer ended while waiting for the title $1"
        sleep 0.1
    done
    fail "the title never showed $1: $(title)"
}
# Moves the pointer at the pace of a hand, which is the real time of a stroke.
glide() { # TIMES DX DY
    local moves=()
    for ((move = 0; move < $1; ++move)); do moves+=(mousemove_relative -- "$2" "$3" sleep 0.05); done
    xdotool "${moves[@]}"
}
keys() { xdotool key --window "$window" "$@"; }
quit() { # quits by the key. xdotool fails if the window closes before it releases the keys, and Q would stay pressed for the next one
    keys ctrl+q 2>/dev/null || true
    for _ in {1..1200}; do
        kill -0 "$running" 2>/dev/null || { xdotool keyup q keyup ctrl; return; }
        sleep 0.1
    done
    fail "Ctrl + Q does not end it"
}
# Reads the screen where the server keeps it: a busy server takes seconds to answer a program that asks for it.
shoot() { convert "xwd:$folder/Xvfb_screen0" -crop "$extent+0+0" +repage -quality 10 "$1"; } # as large as the window, which is in the corner; barely compressed
awaitMotion() { # waits until the picture changes: steps are on their way
    cp Xvfb_screen0 motion
    hasMoved() { ! cmp -s Xvfb_screen0 motion; }
    await 60 hasMoved
}
# Waits until the viewer waits for input, and the X server for the viewer: what was asked for is done, and a paused
# software device has drawn its last picture in full quality. Until then it draws without a pause. A picture that
# stands for three seconds counts as well, since the viewer may draw the same one again and again.
awaitIdle() {
    local before stood=0
    used "$running" "${processes[0]}"
    for _ in {1..600}; do
        before=$ticks
        sleep 0.15 # the time in which nothing may be done
        used "$running" "${processes[0]}"
        [[ $isRunning ]] || ((ticks - before > 1)) || return 0
        if cmp -s Xvfb_screen0 stood; then ((++stood)); else stood=0; fi
        ((stood < 20)) || return 0
        ((stood > 0)) || cp Xvfb_screen0 stood
        kill -0 "$running" 2>/dev/null || fail "the viewer ended while it was to finish its work"
    done
    fail "the viewer is never idle"
}
awaitStill() { # FILE: waits for the last picture of a paused scene
    awaitIdle
    shoot "$1"
}
awaitOther() { # BEFORE FILE WHY: pipelines may have to be made first
    for _ in {1..150}; do
        awaitStill "$2" # pictures in between may differ for a moment
        same "$1" "$2" || return 0
    done
    fail "$3"
}
awaitSame() { # BEFORE FILE WHY: waits for a picture like that before
    for _ in {1..150}; do
        awaitStill "$2"
        same "$1" "$2" && return
    done
    fail "$3"
}
hasSize() { [[ $(xdotool getwindowgeometry "$window") == *"$1"* ]]; }
lacksSize() { ! hasSize "$1"; }
same() { compare -metric AE "$1" "$2" null: >/dev/null 2>&1; }
# Pixels whose red exceeds FACTOR times green, and LEAST. -fx would need a second of processor time.
red() { # FILE FACTOR LEAST OPERATORS...
    convert "$1" -colorspace sRGB -color-matrix "1 -$2 0 1 0 0 0 0 0" -channel R -threshold 0 -channel G -threshold "$3" \
        +channel -separate -delete 2 -compose multiply -composite "${@:4}" info:
}
alike() { # within 0.5 % RMS: a shift by two pixels exceeds it
    local off
    off=$(compare -metric RMSE "$1" "$2" null: 2>&1 || true)
    off=${off#*(}
    python3 -c 'import sys; sys.exit(not float(sys.argv[1]) < 0.005)' "${off%)*}"
}
cutDown() { # X FROM TO: a stroke down the window, repeated if a slow window saw only an end of it
    keys c
    awaitTitle blade
    for _ in {1..5}; do
        xdotool mousemove "$1" "$2" mousedown 1
        awaitWork "$running" 15 # pictures that see the button go down, and the end of the stroke
        glide $((($3 - $2 + 7) / 8)) 0 8
        awaitWork "$running" 15
        xdotool mouseup 1
        within 5 hasTitle pieces && return
    done
    fail "nothing was cut"
}
awaitEnd() { # CODE
    local code=0
    wait "$running" || code=$?
    [[ $code == "$1" ]] || fail "exit code $code, expected $1"
    [[ ! -s viewer.err ]] || fail "something was said on stderr"
}
