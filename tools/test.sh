#!/usr/bin/env bash
# tools/test.sh [--clang | --sanitize] [ctest options]: installs missing packages, builds everything and runs all tests on lavapipe.
#   --clang     builds with clang++ in build/clang
#   --sanitize  builds and runs every test under AddressSanitizer and UndefinedBehaviorSanitizer (build/asan), then the
#               programs that start threads under ThreadSanitizer (build/tsan); ends with a summary of both;
#               takes about two hours on two cores
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

mode=release
case ${1:-} in
    --clang) mode=clang; shift ;;
    --sanitize) mode=asan; shift ;;
esac
need "${build_packages[@]}" "${test_packages[@]}"
echo "checking layers, documents and format"
tools/check.sh
# use the software device, even if the machine has a GPU
for icd in /usr/share/vulkan/icd.d/lvp_icd.*.json; do export VK_ICD_FILENAMES=$icd; done

# tests PRESET [ctest options]: runs the tests and copies the output of ctest to build/PRESET/tests.log. Tests
# that play in a window depend on when the X server, the viewer and the test get processor time: if nothing
# else failed, those that failed run once more, alone. Otherwise ends with the reasons and the summary again.
tests() {
    local preset=$1 failed log=build/$1/tests.log
    shift
    echo "testing (build/$preset)"
    ctest --preset "$preset" --output-on-failure -j2 "$@" | tee "$log" && return
    failed=$(sed -n '/The following tests FAILED/,$s/^[[:space:]]*[0-9]* - \([^ ]*\) .*/\1/p' "$log")
    echo "why tests failed:"
    sed -nE '/(^|: )(FAILED:|Failure$|error:|AddressSanitizer|Segmentation)/p' "$log" | tail -n 20
    if [[ -n $failed ]] && ! grep -qvFx -f <(window_tests "$preset") <<<"$failed"; then
        echo "only tests that play in a window failed: again, alone"
        ctest --preset "$preset" --output-on-failure -j1 --rerun-failed | tee -a "$log"
        return
    fi
    sed -n '/tests passed/,$p' "$log"
    return 8
}

# window_tests PRESET: the names of the tests that play in a window.
window_tests() {
    ctest --preset "$1" -N -L '^window$' | sed -n 's/^ *Test *#[0-9]*: //p'
}

# summary PRESET: prints the number of tests that passed and the names of the others.
summary() {
    echo "summary of build/$1:"
    if ! sed -n '/tests passed/,$p' "build/$1/tests.log" 2>/dev/null | grep .; then echo "no test ran"; fi
}

echo "building (build/$mode)"
build "$mode"
if [[ $mode != asan ]]; then
    tests "$mode" "$@"
    exit
fi
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=1} UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export LSAN_OPTIONS=suppressions=$PWD/tools/sanitize/leaks.txt:print_suppressions=0
export TSAN_OPTIONS=suppressions=$PWD/tools/sanitize/races.txt:ignore_noninstrumented_modules=1
# the second sanitizer runs even if the first one fails
failed=0
tests asan "$@" || failed=1
# each line of threaded.txt: a program, and its test suites that start threads
mapfile -t programs < <(cut -d' ' -f1 tools/sanitize/threaded.txt)
suites=$(cut -d' ' -f2 tools/sanitize/threaded.txt | paste -sd'|')
echo "building (build/tsan)"
rm -f build/tsan/tests.log
{ build tsan "${programs[@]}" && tests tsan -R "^($suites)[.]" "$@"; } || failed=1
summary asan
summary tsan
exit "$failed"
