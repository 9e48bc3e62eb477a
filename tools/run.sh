#!/usr/bin/env bash
# tools/run.sh [SCENE|MESH] [viewer options]: installs missing packages, builds, and shows the scene in a window. Without a display it
# writes pictures into out/ (or follows options such as --out DIR --frames 60). The default scene is scenes/organ_draped.toml.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

scene=scenes/organ_draped.toml
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
name=$(basename "$scene")
out=out/${name%.*}
(($#)) || set -- --frames 240 --every 20 --out "$out"
echo "no display: drawing $scene without a window: $*"
"$viewer" "$scene" --headless "$@"
