#!/usr/bin/env bash
# test_signals.sh VIEWER SCENE FOLDER LAYERS: sends SIGINT and SIGTERM to an open window, during the
# preparation of its first scene, in a step of several seconds, and in a driver call that never returns. The
# viewer must end within 2 s (longer on a busy machine) with one line, exit code 130 and no partial files; a
# playing window keeps its films and settings whole.
set -euo pipefail
viewer=$1 scene=$2 folder=$3 layers=$4
here=$(cd "$(dirname "$0")" && pwd)
extent=320x240 options=(--no-validation)
. "$here/window.sh"
. "$here/signals.sh"
mkdir bin # replaces ffmpeg: its last argument is the file
printf '#!/bin/sh\nfor last; do :; done\nexec cat >"${last#file:}"\n' >bin/ffmpeg
chmod +x bin/ffmpeg
PATH=$folder/bin:$PATH

endsSoon() { # SIGNAL
    endsWithin 6 "$1" "$running"
    (($(grep -c '^error: interrupted' viewer.err) == 1)) || fail "SIG$1: nothing, or more than a line, is said of it"
}
expectFilm() {
    local film bytes
    film=$(sed -n 's/^recording //p' viewer.out)
    bytes=$(stat -c %s "$film") || fail "the film is lost"
    ((bytes > 0 && bytes % (320 * 240 * 4) == 0)) || fail "the film has $bytes bytes, which are no whole pictures"
}
expectSettings() { # LINE: the setting that a key has changed
    grep -qx "$1" config/sinew/viewer.conf || fail "settings are lost: $1"
}

printf '[solver]\nsubsteps = 1000\n[[box]]\nparticles = [40, 40, 40]\nspacing = 0.02\ncenter = [0, 1, 0]\nyoung_modulus = 1e5\n[[plane]]\n' >slow.toml
for signal in INT TERM; do
    echo "signals: SIG$signal in the window"
    rm -rf config
    start
    keys v
    keys F9
    await 30 isFilming 600k
    endsSoon $signal
    expectFilm
    expectSettings 'vsync = false'

    echo "signals: SIG$signal while the first scene is prepared"
    launch "$viewer" slow.toml --size $extent
    await 60 says ' on ' # the scene is loaded, and pipelines are made
    endsSoon $signal

    echo "signals: SIG$signal in a step that takes seconds"
    launch "$viewer" slow.toml "${options[@]}" --size $extent
    awaitWindow '^Sinew.*particles'
    awaitWork "$running" 100 # a step is running
    endsSoon $signal
done

for call in vkQueuePresentKHR vkAcquireNextImageKHR vkQueueSubmit vkWaitForFences vkQueueWaitIdle; do
    echo "signals: SIGTERM in $call, which never comes back"
    rm -f block blocked
    VK_LAYER_PATH=$layers VK_INSTANCE_LAYERS=VK_LAYER_SINEW_losing SINEW_BLOCK_CALL=$call SINEW_BLOCK_FROM=block SINEW_BLOCK_REPORT=blocked start
    touch block
    keys v # waits for the device
    await 30 test -s blocked # the call
    endsSoon TERM
done
echo "passed"
