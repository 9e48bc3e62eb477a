#!/usr/bin/env bash
# tools/gpu_day.sh pack FILE                 packs the programs of build/release and their libraries, without a driver, in FILE (.tar.zst)
# tools/gpu_day.sh run FILE FOLDER [PART...] on a bare machine with a Vulkan GPU, in a copy of this tree: unpacks FILE with FILE.unpack, and
#     writes results into FOLDER. Needs only bash, tar, coreutils, awk and glibc 2.36. The exit code is 1 if a test failed or did not run, if
#     a scene did not end or its bits depend on the invocation order, or if a benchmark failed.
#     On 16 cores and an NVIDIA H200 runs take 76 s, tests about 260 s, bench 25 s, forms 16 s.
# PART, all of them by default:
#     runs      each scene in both invocation orders: whether the bits are equal, times of a step and of its passes
#     tests     all tests that use a device, with the same validation as ctest
#     bench     sinew bench; forms, kernels and contacts: sinew bench --by-form, --kernels and --contacts
# Environment: JOBS (one per core) and SHARDS (4) of tests; SECONDS_OF_TESTS (300): no test program starts later;
#     SECONDS_OF_TEST (150): limit of one program; FRAMES (200) of a scene; VK_DRIVER_FILES, if the loader does not find the driver's JSON file.
set -euo pipefail
tree=$(cd "$(dirname "$0")/.." && pwd)
[[ ${1:-} == pack || ${1:-} == run ]] && file=$(realpath -m "${2:?no FILE}") && folder=$(realpath -m "${3:-.}")
cd "$tree"

scenes=(cloth_links cloth_study cube organ organ_held clutter pile_8000 pile_100k clutter_bodies cloth_fold stirrer stack organ_incision cube_quarters tube_slice beam)
# Programs that start first, because their longest tests take a minute or more.
longest=(test_contact_lists test_face_lists test_edge_lists test_hard_cases test_cases test_same_state test_forces test_rest_contact test_run)
# Tests that read files of the build folder.
not_here='ExactKernels.*:Kernels.BindAsManyStorageBuffersAsIsSaid:KernelInterface.AgreesWithSpirvCrossOnEveryKernelInTheBuild'

# libraries PROGRAM...: the shared libraries of the programs, without those of the C library
libraries() {
    ldd "$@" | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' | sort -u | grep -vE '/(libc|libm|libdl|librt|libpthread|ld-linux[^/]*)\.so'
}

pack() { # FILE
    local folder program name tests=(test_run test_same_state) # these start a program that opens a device
    folder=$(mktemp -d)
    mkdir "$folder/bin" "$folder/lib" "$folder/layers"
    for program in build/release/bin/test_*; do
        name=$(basename "$program")
        [[ $name == test_viewer_* || $name == test_gpu_compiler ]] && continue # a window; a simulated GPU
        if [[ $(nm -C "$program") == *' sinew::test::device()'* ]]; then tests+=("$name"); fi
    done
    for program in "${tests[@]}" sinew; do strip -o "$folder/bin/$program" "build/release/bin/$program"; done
    sed -nE 's/^ *sinew_test\((test_[a-z_0-9]+) PLAYED.*/\1/p' tests/*/CMakeLists.txt >"$folder/played"
    pwd -P >"$folder/source"
    mapfile -t loaded < <(libraries "$folder"/bin/*)
    cp "${loaded[@]}" /usr/lib/*/libVkLayer_khronos_validation.so "$folder/lib/"
    cp -L /usr/lib/*/libvulkan.so.1 "$folder/lib/"
    cp /usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json "$folder/layers/"
    mkdir -p "$(dirname "$1")"
    # programs contain the same kernels: a match window as long as all programs finds them
    tar -C "$folder" -cf - . | zstd -q -12 --long=31 -T0 -f -o "$1"
    cp "$(command -v zstd)" "$1.unpack"
    rm -rf "$folder"
    ls -l "$1" "$1.unpack"
}

# failures LOG...: the lines that name failed tests
failures() {
    awk '/^\[  FAILED  \] .*\([0-9]+ ms\)$/' "$@"
}

# one TEST SHARD SHARDS: runs a part of a test program and prints a line of tests.txt: tenths of a second, exit code, tests that passed,
# tests that failed, name and shard.
one() {
    local log=$FOLDER/logs/$1.$2.log start=$EPOCHREALTIME state=0 passed failed
    if ((EPOCHSECONDS > LAST_START)); then
        echo "0 left-out 0 0 $1.$2"
        return
    fi
    if grep -qx "$1" "$PACK/played"; then export SINEW_PLAYED=1; fi
    GTEST_TOTAL_SHARDS=$3 GTEST_SHARD_INDEX=$2 VK_LAYER_ENABLES=VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT \
        timeout -k 5 "${SECONDS_OF_TEST:-150}" "$PACK/bin/$1" "--gtest_filter=-$not_here" --gtest_color=no >"$log" 2>&1 || state=$?
    passed=$(awk '/^\[       OK \]/ { n += 1 } END { print n + 0 }' "$log")
    failed=$(failures "$log" | wc -l)
    echo "$(((${EPOCHREALTIME/./} - ${start/./}) / 100000)) $state $passed $failed $1.$2"
}

timed() { # PART COMMAND...: runs the command and prints its time and exit code
    local part=$1 start=$SECONDS state=0
    shift
    "$@" || state=$?
    echo "$part: $((SECONDS - start)) s, exit $state"
    return "$state"
}

tests() {
    local shards=${SHARDS:-4} test i
    export LAST_START=$((EPOCHSECONDS + ${SECONDS_OF_TESTS:-300}))
    {
        for test in "${longest[@]}"; do
            for ((i = 0; i < shards; ++i)); do echo "$test $i $shards"; done
        done
        for ((i = 0; i < shards; ++i)); do
            for test in "$PACK"/bin/test_*; do
                test=$(basename "$test")
                [[ " ${longest[*]} " == *" $test "* ]] || echo "$test $i $shards"
            done
        done
    } | xargs -P "${JOBS:-$(nproc)}" -L 1 tools/gpu_day.sh one >"$FOLDER/tests.txt"
    awk '{ passed += $3; failed += $4; if ($2 == "left-out") left += 1; else if ($2 != 0 && $4 == 0) bad += 1 }
        END { printf "tests: %d passed, %d failed; shards that ended otherwise: %d, that did not start: %d\n", passed, failed, bad, left }' "$FOLDER/tests.txt"
    {
        failures "$FOLDER"/logs/*.log | sort
        awk '$2 != 0' "$FOLDER/tests.txt"
    } >"$FOLDER/failed.txt"
    head -n 60 "$FOLDER/failed.txt"
    tar -C "$FOLDER" -czf "$FOLDER/logs.tar.gz" logs
    [[ -s $FOLDER/tests.txt && ! -s $FOLDER/failed.txt ]]
}

runs() {
    local scene order file hashes bad=0
    for scene in "${scenes[@]}"; do
        for order in '' '--reversed --pass-times'; do
            file=$FOLDER/runs/$scene${order:+.reversed}
            # shellcheck disable=SC2086 # options
            timeout 60 "$PACK/bin/sinew" run "scenes/$scene.toml" --frames "${FRAMES:-200}" $order --json "$file.json" >"$file.out" 2>&1 ||
                echo "$scene $order: exit $?: $(tail -n 1 "$file.out")"
        done
        # two lines, or fewer if a run did not end
        hashes=$(awk 'match($0, /"state_hash": "[0-9a-f]+"/) { print substr($0, RSTART, RLENGTH) }' "$FOLDER/runs/$scene"{,.reversed}.json)
        if (($(wc -l <<<"$hashes") == 2 && $(sort -u <<<"$hashes" | wc -l) == 1)); then
            printf '%-16s equal bits in both orders; %s\n' "$scene" "$(awk '/ms each/' "$FOLDER/runs/$scene.out")"
        else
            printf '%-16s OTHER BITS in the other order, or no result\n' "$scene"
            bad=1
        fi
    done
    tar -C "$FOLDER" -czf "$FOLDER/runs.tar.gz" runs
    return "$bad"
}

run() { # FILE FOLDER [PART...]
    export PACK FOLDER
    FOLDER=$2
    PACK=$(mktemp -d)
    mkdir -p "$FOLDER/logs" "$FOLDER/runs"
    "$1.unpack" -q -d --long=31 "$1" -c | tar -C "$PACK" -xf -
    export LD_LIBRARY_PATH=$PACK/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} VK_LAYER_PATH=$PACK/layers
    # tests expect scenes and programs at the path of the build
    local source
    source=$(<"$PACK/source")
    if [[ ! -e $source ]]; then
        mkdir -p "$(dirname "$source")"
        ln -s "$PWD" "$source"
    fi
    mkdir -p build/release
    if [[ ! -d build/release/bin || -L build/release/bin ]]; then ln -sfn "$PACK/bin" build/release/bin; fi
    "$PACK/bin/sinew" devices | tee "$FOLDER/device.txt"
    shift 2
    (($#)) || set -- runs tests bench forms kernels contacts
    local part bad=0
    for part; do
        case $part in
            tests | runs) timed "$part" "$part" || bad=1 ;;
            bench) timed bench timeout 60 "$PACK/bin/sinew" bench --seconds 4 --json "$FOLDER/bench.json" || bad=1 ;;
            forms) timed forms timeout 90 "$PACK/bin/sinew" bench --by-form --json "$FOLDER/forms.json" || bad=1 ;;
            kernels | contacts) timed "$part" timeout 90 "$PACK/bin/sinew" bench "--$part" --json "$FOLDER/$part.json" || bad=1 ;;
            *) echo "error: no part is named $part" >&2; exit 2 ;;
        esac
    done
    rm -rf "$FOLDER/logs" "$FOLDER/runs" "$PACK"
    return "$bad"
}

case ${1:-} in
    pack) pack "$file" ;;
    run) shift 3; run "$file" "$folder" "$@" ;;
    one) shift; one "$@" ;;
    *) sed -n '2,13p' "$0"; exit 2 ;;
esac
