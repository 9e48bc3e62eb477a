#!/usr/bin/env bash
# tools/test.sh [ctest options]: installs what is missing, builds everything and runs every test, on lavapipe.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

need "${build_packages[@]}" "${test_packages[@]}"
echo "checking layers and format"
python3 tools/check_layers.py
git ls-files -z '*.cpp' '*.hpp' | xargs -0 -r clang-format --dry-run --Werror
echo "building (build/release)"
build release
echo "testing"
ctest --preset release --output-on-failure -j2 "$@"
