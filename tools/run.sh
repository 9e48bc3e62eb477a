#!/usr/bin/env bash
# tools/run.sh [SCENE|MESH] [viewer options]: installs what is missing, builds, and shows the scene: in a window if there is a
# display, else as pictures in out/. The default is scenes/organ.toml.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

scene=scenes/organ.toml
if (($#)) && [[ $1 != -* ]]; then
    scene=$1
    shift
    [[ $scene = /* ]] || scene=$OLDPWD/$scene
fi
need "${build_packages[@]}"
echo "building (build/release)"
build release sinew_viewer sinew_cli
viewer=build/release/bin/sinew-viewer
if [[ -n ${DISPLAY:-} ]]; then
    echo "opening $scene in the viewer"
    exec "$viewer" "$scene" "$@"
fi
name=$(basename "${scene%.*}")
echo "no display: drawing $scene to out/$name"
"$viewer" "$scene" --headless --frames 240 --every 20 --out "out/$name" "$@"
echo "pictures: out/$name"
