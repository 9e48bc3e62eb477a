#!/usr/bin/env bash
# tools/debian.sh [FOLDER]: installs what is missing, builds the Debian packages of the library in a copy of the sources, checks them with
# lintian and puts them into FOLDER (out/debian).
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh
need cmake g++ glslang-tools libvulkan-dev dpkg-dev debhelper lintian

folder=$(realpath -m "${1:-out/debian}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder" "$work/sinew"
tar --exclude=./build --exclude=./out --exclude=./.git -cf - . | tar -xf - -C "$work/sinew"
echo "building the packages"
(cd "$work/sinew" && dpkg-buildpackage -b -us -uc -j2) >"$folder/build.log" 2>&1 || { tail -n 40 "$folder/build.log" >&2; exit 1; }
cp "$work"/*.deb "$work"/*.changes "$folder"
lintian --fail-on error --info "$work"/*.changes
ls -l "$folder"/*.deb
