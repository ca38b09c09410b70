#!/usr/bin/env bash
# Proves at compile time, as far as the compiler sees, and watches at run time that what the audio thread runs neither
# allocates nor locks nor asks the system: clang's function effects and its realtime sanitizer.
# Usage: scripts/realtime_sanitizer.sh [--effects]
#   --effects: the first half alone, minutes less
# Needs clang 22: scripts/setup.sh --realtime. Both halves follow the mark JAWARI_REALTIME (engine/include/jawari/realtime.h),
# which every entry of rendering carries. Progress goes to standard error, findings to build/realtime/*.log, a line for each
# half to standard output.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

run=true
case "${1:-}" in
    "") ;;
    --effects) run=false ;;
    *) echo "realtime_sanitizer.sh: unknown argument '$1' (allowed: --effects)" >&2; exit 2 ;;
esac
compiler=clang++-22
command -v $compiler > /dev/null || { echo "realtime_sanitizer.sh: no $compiler; scripts/setup.sh --realtime" >&2; exit 1; }

build=build/realtime
cmake -B $build -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
    -DCMAKE_C_COMPILER=clang-22 -DCMAKE_CXX_COMPILER=$compiler -DJAWARI_SANITIZE=realtime -DJAWARI_BUILD_BENCHMARKS=OFF \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON > /dev/null
failed=0

# The effects of a function that is not marked are found from its body, where the compiler sees it; what a marked function
# calls in another file must be marked there. One instruction set is read: the other copies are the same source.
mapfile -t sources < <(grep -l JAWARI_REALTIME -r engine/src host --include='*.cpp' | sort)
: > $build/effects.log
for source in "${sources[@]}"; do
    echo "-- $source" >&2
    $compiler -fsyntax-only -std=c++20 -Wfunction-effects -DHWY_COMPILE_ONLY_STATIC -Iengine/include -Iengine/src -Ihost \
        -isystem /usr/include/eigen3 "$source" 2>> $build/effects.log || failed=1
done
warnings=$(grep -c 'warning:.*\[-Wfunction-effects\]' $build/effects.log || true)
echo "function effects: ${#sources[@]} files, $warnings warnings"
((warnings == 0)) || failed=1
$run || exit $failed

cmake --build $build --parallel "${JOBS:-$(nproc)}" --target engine_tests jawari_soak replay_events replay_scene >&2
export RTSAN_OPTIONS=halt_on_error=false:suppress_equal_stacks=true
export RTSAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-22

# watched NAME COMMAND...
watched() {
    local name=$1 begin=$SECONDS found status=0
    shift
    echo "-- $name" >&2
    "$@" > "$build/$name.out" 2> "$build/$name.log" || status=$?
    found=$(grep -c 'ERROR: RealtimeSanitizer' "$build/$name.log" || true)
    echo "realtime sanitizer, $name: $found found, exit $status, $((SECONDS - begin)) s"
    if ((found > 0 || status != 0)); then failed=1; fi
}
# The tests of what the engine does, not of whether it is exact.
watched engine $build/bin/engine_tests --gtest_brief=1 --gtest_filter='Storm.*:*InstrumentNonFinite*:*NonFinite*:Touches.*:Hammer.*:Bend.*:Transfer.*:InstrumentRungs.*:Render.*'
watched performances $build/bin/replay_events $build/seeds/events
watched scenes $build/bin/replay_scene $build/seeds/scene
watched playing $build/bin/jawari_soak --hours 0.05 --preset bass-fretted
exit $failed
