#!/usr/bin/env bash
# tools/examples.sh [FOLDER]: installs what the examples of hosts need beside the library (Qt 6), builds and runs them, the window
# without a display and under validation, and puts its pictures into FOLDER (out/examples).
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh
need "${build_packages[@]}" qt6-base-dev vulkan-validationlayers xvfb xauth

folder=${1:-out/examples}
cmake --preset release >/dev/null # Qt may have arrived since
build release example_game example_qt_window
build/release/bin/example_game 1000
VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT \
    xvfb-run -a build/release/bin/example_qt_window --validate --play "$folder"
