# Functions for run.sh and test.sh, which source this file.
# need PACKAGE...: installs missing Debian packages and prints one line; prints nothing if all are installed
need() {
    local package missing=()
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    ((${#missing[@]})) || return 0
    echo "installing ${#missing[@]} packages: ${missing[*]}"
    local root=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null || { echo "error: missing packages: no root rights and no sudo: install them: ${missing[*]}" >&2; exit 1; }
        root=(sudo)
    fi
    local log
    log=$(mktemp)
    if ! { "${root[@]}" apt-get update && "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
        tail -n 20 "$log" >&2
        rm -f "$log"
        echo "error: apt-get failed: see above: mend the package sources and run this again" >&2
        exit 1
    fi
    rm -f "$log"
}

# Packages to build everything but the tests, and to run the programs on a machine without a GPU.
build_packages=(ca-certificates cmake ninja-build g++ libc6-dev
    libvulkan-dev libvulkan1 mesa-vulkan-drivers glslang-tools spirv-tools
    libeigen3-dev libassimp-dev zlib1g-dev libglfw3-dev libimgui-dev libstb-dev fonts-dejavu-core libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev
    librsvg2-bin libbullet-dev # plots of `sinew study` as PNG; `sinew bench --peers`
    pybind11-dev python3-dev python3-numpy # the Python module
    libgtest-dev) # required by the configure step, even without tests
# Further packages for the tests.
test_packages=(clang libx11-dev vulkan-validationlayers spirv-cross xvfb xauth xdotool imagemagick x11-apps
    qt6-base-dev assimp-testmodels python3-minimal python3-pip python3-venv binutils pkg-config clang-format)

# build PRESET [TARGET...]: configures at the first call, then builds.
build() {
    local preset=$1
    shift
    [[ -f build/$preset/build.ninja ]] || cmake --preset "$preset" >/dev/null
    cmake --build "build/$preset" ${@:+--target "$@"} -- --quiet
}
