#!/usr/bin/env bash
# tools/check.sh: the checks that need no build: layers, costs of kernels, figures, the gallery, documents and format. Takes a few seconds.
# As a git hook, it refuses a push that continuous integration would refuse: ln -s ../../tools/check.sh .git/hooks/pre-push
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
python3 tools/check_layers.py
python3 tools/kernel_costs.py --check
python3 tools/figures.py --check
python3 tools/gallery.py --check
python3 tools/check_docs.py
find include src apps tools tests python examples \( -name '*.cpp' -o -name '*.hpp' \) -print0 | xargs -0 clang-format --dry-run --Werror
echo "format: good"
