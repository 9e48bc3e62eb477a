#!/usr/bin/env bash
# tools/platforms.sh PLATFORM [build] [tests [NAME...]] [states [STEPS]]: builds core, `sinew` and the tests of src/vk and src/sim
# for another platform, and runs them on this machine; without a second word all three. Installs what is missing. Platforms:
#   windows   mingw-w64 with POSIX threads, GoogleTest from Debian's sources, no assimp; run by wine, on lavapipe of this machine
#   arm64     g++ for aarch64 and Debian's packages for arm64, unpacked into build/arm64-root; run by qemu, on lavapipe for arm64
#   clang     clang++ with libstdc++
#   swiftshader  the release build on SwiftShader, unpacked from Debian's chromium-common into build/swiftshader-root
#   linux     the release build on lavapipe, to compare with
# `tests` runs the named test programs, or all of them (arm64: six); `states` writes the hashes of the states of all shipped
# scenes after STEPS steps (60; arm64: 4) to out/platforms/PLATFORM-STEPS.txt.
# tools/platforms.sh table STEPS: prints these files side by side. docs/platforms.md has results.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

left_out='pile_100k|drop_mesh' # too large for a quick check; needs a mesh
results=out/platforms
scenes() {
    local file
    for file in scenes/*.toml; do [[ $(basename "$file" .toml) =~ ^($left_out)$ ]] || echo "$file"; done
}

if [[ ${1:-} == table ]]; then
    steps=$2
    platforms=()
    for platform in linux clang windows arm64 swiftshader; do [[ -f $results/$platform-$steps.txt ]] && platforms+=("$platform"); done
    printf '| scene |'; printf ' %s |' "${platforms[@]}"; echo
    printf '|---|'; printf -- '---|%.0s' "${platforms[@]}"; echo
    for scene in $(scenes); do
        name=$(basename "$scene" .toml)
        printf '| `%s` |' "$name"
        for platform in "${platforms[@]}"; do
            hash=$(sed -n "s/^$name //p" "$results/$platform-$steps.txt")
            printf ' %s |' "${hash:-not run}"
        done
        echo
    done
    exit
fi

platform=${1:-}
if [[ $platform == windows && -z ${SINEW_HAS_DISPLAY:-} ]]; then # wine's Vulkan needs a display
    need xvfb xauth
    SINEW_HAS_DISPLAY=1 exec xvfb-run -a "$0" "$@"
fi
root=build/$platform-root
folder=build/$platform
run=() suffix='' steps=60
# Tests of the validation layer, of spirv-cross and of libraries of Linux, which wine and qemu do not have.
filter='*'
layered='-Layer.*:Validation.*:*GpuAssisted*:Faults.*:Buffer.IsNamedInValidationMessages:Device.MayMoveUnder*:Device.WithoutADriver*'
layered+=':KernelInterface.AgreesWithSpirvCross*:Loader.NamesTheLibraryItCannotOpen'
programs=()
export LP_NUM_THREADS=0 MESA_SHADER_CACHE_DIR=$PWD/build/$platform-shaders
options=(-DCMAKE_BUILD_TYPE=Release -DSINEW_BUILD_VIEWER=OFF -DSINEW_BUILD_PYTHON=OFF -DSINEW_BENCH_NATIVE=OFF -DSINEW_BENCH_PEERS=OFF
    '-DSINEW_TEST_PARTS=vk;sim;cases')
case $platform in
    windows)
        options+=(-DCMAKE_TOOLCHAIN_FILE=cmake/toolchains/windows.cmake -DSINEW_IMPORT=OFF)
        export WINEPREFIX=$PWD/build/windows-wine WINEDEBUG=-all SINEW_UNVALIDATED=1
        run=(/usr/lib/wine/wine64) suffix=.exe filter=$layered
        ;;
    arm64)
        options+=(-DCMAKE_TOOLCHAIN_FILE=cmake/toolchains/arm64.cmake)
        run=(qemu-aarch64 -L "$root") steps=4 filter=$layered
        export SINEW_UNVALIDATED=1
        programs=(test_vk test_determinism test_physics test_gauss_seidel test_forces test_saved_state) # qemu takes some 100 times as long
        ;;
    clang)
        options+=(-DCMAKE_CXX_COMPILER=clang++)
        folder=build/platform-clang # build/clang has all tests
        ;;
    linux | swiftshader) folder=build/release ;;
    *) sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2 ;;
esac
[[ $platform == arm64 ]] && architecture=aarch64 || architecture=x86_64
export VK_ICD_FILENAMES=/usr/share/vulkan/icd.d/lvp_icd.$architecture.json # lavapipe, even if the machine has a GPU

if [[ $platform == swiftshader ]]; then
    steps=4
    VK_ICD_FILENAMES=$PWD/$root/usr/lib/chromium/vk_swiftshader_icd.json
    if [[ ! -f $VK_ICD_FILENAMES ]]; then
        mkdir -p $root
        (cd $root && apt-get -qq download chromium-common && dpkg-deb -x chromium-common_*.deb . && rm chromium-common_*.deb)
    fi
fi

# A prefix for mingw of headers alone: /usr/include itself would hide those of the compiler.
windows_root() {
    need g++-mingw-w64-x86-64-posix wine64 googletest "${build_packages[@]}"
    local name package target
    mkdir -p $root/include
    for name in vulkan vk_video eigen3 fmt nlohmann CLI toml++; do ln -sfn /usr/include/$name $root/include/$name; done
    while read -r package target name; do
        mkdir -p $root/lib/cmake/$package
        echo 'set(PACKAGE_VERSION_COMPATIBLE TRUE)' >$root/lib/cmake/$package/${package}ConfigVersion.cmake
        printf 'add_library(%s INTERFACE IMPORTED)\ntarget_include_directories(%s INTERFACE "%s")\n' "$target" "$target" "$PWD/$root/$name" \
            >$root/lib/cmake/$package/${package}Config.cmake
    done <<'END'
fmt fmt::fmt-header-only include
nlohmann_json nlohmann_json::nlohmann_json include
CLI11 CLI11::CLI11 include
Eigen3 Eigen3::Eigen include/eigen3
END
    echo 'target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_HEADER_ONLY=1)' >>$root/lib/cmake/fmt/fmtConfig.cmake
    [[ -f $root/lib/libgtest.a ]] && return
    cmake -S /usr/src/googletest -B build/windows-gtest -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_GMOCK=OFF -DCMAKE_INSTALL_LIBDIR=lib \
        -DCMAKE_INSTALL_PREFIX="$PWD/$root" -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/toolchains/windows.cmake" >/dev/null
    cmake --build build/windows-gtest --target install -- --quiet >/dev/null
    timeout 120 "${run[0]}" wineboot -u >/dev/null 2>&1
}

# Debian's packages for arm64, by an apt with lists of its own: this machine's list of packages stays as it is.
arm64_root() {
    need g++-aarch64-linux-gnu qemu-user "${build_packages[@]}"
    [[ -f $root/complete ]] && return
    local apt=$PWD/$root/.apt package link library=usr/lib/aarch64-linux-gnu
    mkdir -p "$apt"/{lists,archives}/partial
    : >"$apt/status"
    cat >"$apt/apt.conf" <<END
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Install-Recommends "false";
Dir::State "$apt";
Dir::State::status "$apt/status";
Dir::Cache "$apt";
END
    echo "unpacking packages for arm64 into $root"
    APT_CONFIG=$apt/apt.conf apt-get -qq update
    APT_CONFIG=$apt/apt.conf apt-get -qq -y --download-only install libc6-dev mesa-vulkan-drivers libvulkan1 libvulkan-dev libassimp-dev \
        zlib1g-dev libgtest-dev libfmt-dev libeigen3-dev nlohmann-json3-dev libcli11-dev libtomlplusplus-dev
    for package in "$apt"/archives/*.deb; do dpkg-deb -x "$package" $root; done
    # Links and files of CMake lead into the folder, not to the root of this machine.
    find $root -type l -lname '/*' | while read -r link; do ln -sfnr "$root$(readlink "$link")" "$link"; done
    grep -rlE "/$library/lib" $root/$library/cmake | xargs sed -i -E "s#([\"; :])/$library/lib#\1$PWD/$root/$library/lib#g"
    rm -rf "$apt"
    touch $root/complete
}

build_platform() {
    [[ $platform == windows || $platform == arm64 ]] && "${platform}_root"
    [[ $platform == clang ]] && need clang "${build_packages[@]}"
    [[ -f $folder/build.ninja ]] || cmake -S . -B "$folder" -G Ninja "${options[@]}" >/dev/null
    list_programs
    cmake --build "$folder" --target sinew_cli "${programs[@]}" -- --quiet
}

# All test programs of the build, unless a platform has a list of its own.
list_programs() {
    ((${#programs[@]})) || mapfile -t programs < <(ninja -C "$folder" -t targets all | sed -nE "s#^bin/(test_[a-z_]+)$suffix: .*#\1#p" | sort -u)
}

# Each program in one process, since wine and qemu start slowly.
run_tests() {
    local name output good bad passed=0 failed=0 all=("$@")
    list_programs
    ((${#all[@]})) || all=("${programs[@]}")
    for name in "${all[@]}"; do
        code=0
        output=$("${run[@]}" "$folder/bin/$name$suffix" --gtest_brief=1 --gtest_filter="$filter" 2>&1 | tr -d '\r') || code=$?
        good=$(sed -nE 's/^\[  PASSED  \] ([0-9]+) .*/\1/p' <<<"$output")
        bad=$(sed -nE 's/^\[  FAILED  \] ([^ ,]*[.][^ ,]*).*/\1/p' <<<"$output" | sort -u)
        if [[ -z $good || $code != 0 && -z $bad ]]; then # it crashed
            bad+=" $name ended with $code: $(tail -n 3 <<<"$output")"
        fi
        echo "$name: ${good:-0} passed"
        passed=$((passed + ${good:-0}))
        if [[ -n $bad ]]; then
            echo "  failed: $bad"
            failed=$((failed + $(wc -l <<<"$bad")))
        fi
    done
    echo "$platform: ${#all[@]} programs, $passed tests passed, $failed failed"
    ((failed == 0))
}

write_states() {
    local scene hash failed=0 file=$results/$platform-$1.txt
    mkdir -p $results
    "${run[@]}" "$folder/bin/sinew$suffix" devices | tr -d '\r' | sed -n 's/^\* *[0-9][0-9]* */device: /p' | tee "$file"
    for scene in $(scenes); do
        if ! hash=$("${run[@]}" "$folder/bin/sinew$suffix" run "$scene" --frames "$1" 2>&1 | tr -d '\r' | sed -n 's/^state hash: //p'); then
            failed=1 hash=
        fi
        echo "$(basename "$scene" .toml) ${hash:-failed}" | tee -a "$file"
    done
    return $failed
}

shift
[[ $# == 0 ]] && set -- build tests states
while (($#)); do
    case $1 in
        build) build_platform ;;
        tests)
            names=()
            while [[ ${2:-} == test_* ]]; do names+=("$2"); shift; done
            run_tests "${names[@]}"
            ;;
        states)
            [[ ${2:-} =~ ^[0-9]+$ ]] && { steps=$2; shift; }
            write_states "$steps"
            ;;
        *) echo "error: $1: not build, tests or states" >&2; exit 2 ;;
    esac
    shift
done
