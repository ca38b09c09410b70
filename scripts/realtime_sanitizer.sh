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
mkdir -p $build
failed=0

# The effects of a function that is not marked are found from its body, where the compiler sees it; what is called in
# another file must be marked there. One instruction set is read: the other copies are the same source.
mapfile -t sources < <(grep -l JAWARI_REALTIME -r engine/src host --include='*.cpp' | sort)
: > $build/effects.log
for source in "${sources[@]}"; do
    echo "-- $source" >&2
    $compiler -fsyntax-only -std=c++20 -Wfunction-effects -DHWY_COMPILE_ONLY_STATIC -Iengine/include -Iengine/src -Ihost \
        -isystem /usr/include/eigen3 "$source" 2>> $build/effects.log || failed=1
done
# Every warning ends in a reason. Reasons that are known, and why they do no harm, are named here; any other is a failure.
/usr/bin/python3 - $build/effects.log ${#sources[@]} << 'PYTHON' || failed=1
import collections
import re
import sys

KNOWN = (  # what the last notes of a warning say, what to call it
    (r"no definition in this translation unit\n.*\| void operator delete\(", "vectors copied into room that is there"),
    (r"no definition in this translation unit", "function of another file that is not marked: left to the sanitizer"),
    (r"function pointer cannot be inferred", "the clock, a function pointer"),
    (r"vector\.tcc:\d+:\d+: note: .*throws|stl_uninitialized\.h:\d+:\d+: note: .*throws",
     "push_back() into room that is reserved"),
    (r"eigen3/Eigen/src/Core/util/Memory\.h:\d+:\d+: note: .*throws", "Eigen's solver, on the stack up to 128 KiB"),
    (r"spsc_queue<", "a queue without locks"),
)
text = open(sys.argv[1], encoding="utf-8").read()
warnings = re.split(r"(?m)^(?=\S+: warning: )", text)[1:]
kinds, unknown = collections.Counter(), []
for warning in warnings:
    kind = next((name for pattern, name in KNOWN if re.search(pattern, warning)), None)
    kinds[kind] += 1
    if kind is None:
        unknown.append(warning)
print(f"function effects: {sys.argv[2]} files, {len(warnings)} warnings, {len(unknown)} of them unexplained")
for kind, count in kinds.most_common():
    if kind:
        print(f"  {count}: {kind}")
for warning in unknown:
    print(warning, file=sys.stderr)
sys.exit(bool(unknown) or "error:" in text)
PYTHON
$run || exit $failed

cmake -B $build -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
    -DCMAKE_C_COMPILER=clang-22 -DCMAKE_CXX_COMPILER=$compiler -DJAWARI_SANITIZE=realtime -DJAWARI_BUILD_BENCHMARKS=OFF \
    -DJAWARI_BUILD_HOST=OFF > /dev/null
cmake --build $build --parallel "${JOBS:-$(nproc)}" --target engine_tests >&2
export RTSAN_OPTIONS=halt_on_error=false:suppress_equal_stacks=true
export RTSAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-22

# The sanitizer is shown to find something.
printf '#include <cstdlib>\nvoid* taken = nullptr;\nvoid take() noexcept [[clang::nonblocking]] { taken = std::malloc(9); }\nint main() { take(); }\n' > $build/takes.cpp
$compiler -fsanitize=realtime $build/takes.cpp -o $build/takes
$build/takes 2>&1 | grep -q 'ERROR: RealtimeSanitizer' || { echo "realtime_sanitizer.sh: the sanitizer finds nothing at all" >&2; exit 1; }

# What marked functions do in tests that play: not whether it is exact.
filter='Storm.*:*InstrumentNonFinite*:*NonFinite*:Touches.*:Hammer.*:Bend.*:Transfer.*:InstrumentQualities.*:Render.*'
begin=$SECONDS status=0
$build/bin/engine_tests --gtest_brief=1 --gtest_filter="$filter" > $build/engine.out 2> $build/engine.log || status=$?
found=$(grep -c 'ERROR: RealtimeSanitizer' $build/engine.log || true)
echo "realtime sanitizer: $(sed -n 's/.*PASSED.*  *\([0-9]* tests\).*/\1/p' $build/engine.out) passed, $found calls found, exit $status, $((SECONDS - begin)) s"
((found == 0 && status == 0)) || failed=1
exit $failed
