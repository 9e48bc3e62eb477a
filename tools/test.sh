#!/usr/bin/env bash
# tools/test.sh [ctest options]: installs what is missing, builds everything and runs every test, on lavapipe.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

need "${build_packages[@]}" "${test_packages[@]}"
echo "checking layers and format"
python3 tools/check_layers.py
find src apps tools tests \( -name '*.cpp' -o -name '*.hpp' \) -print0 | xargs -0 clang-format --dry-run --Werror
echo "building (build/release)"
build release
echo "testing"
# on the software device, whatever else the machine has
for icd in /usr/share/vulkan/icd.d/lvp_icd.*.json; do export VK_ICD_FILENAMES=$icd; done
ctest --preset release --output-on-failure -j2 "$@"
