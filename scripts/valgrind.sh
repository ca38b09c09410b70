#!/usr/bin/env bash
# Runs what the audio thread runs under valgrind's memcheck: reads of memory that nothing has written, and reads and writes
# outside blocks that address sanitizer cannot see (uninitialised values are beyond it).
# Usage: scripts/valgrind.sh [--all]
#   --all: every test of the engine instead of those that render, and an hour of patience
# One line for each run on standard output, what valgrind says in build/valgrind/*.log. The program is the ordinary release
# build: Highway then chooses among the instruction sets that valgrind knows (AVX2 and below).
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

filter='Realtime.*:*NonFinite*:Storm.*:Touches.*:Hammer.*:Bend.*:Transfer.*:InstrumentQualities.*:Render.*:Frame.*:ShortFrame.*'
case "${1:-}" in
    "") ;;
    --all) filter='*' ;;
    *) echo "valgrind.sh: unknown argument '$1' (allowed: --all)" >&2; exit 2 ;;
esac

cmake --preset release > /dev/null
cmake --build --preset release --parallel "${JOBS:-$(nproc)}" --target jawari engine_tests >&2
logs=build/valgrind
mkdir -p "$logs"
failed=0

# memcheck NAME COMMAND...
memcheck() {
    local name=$1 begin=$SECONDS status=0
    shift
    echo "-- $name" >&2
    valgrind --tool=memcheck --error-exitcode=99 --track-origins=no --leak-check=full --errors-for-leak-kinds=definite \
        --suppressions=tests/valgrind.supp --log-file="$logs/$name.log" "$@" > "$logs/$name.out" 2>&1 || status=$?
    echo "$name: $(sed -n 's/.*ERROR SUMMARY: \([0-9]* errors from [0-9]* contexts\).*/\1/p' "$logs/$name.log" | tail -1)," \
        "exit $status, $((SECONDS - begin)) s"
    ((status == 0)) || { failed=1; tail -n 5 "$logs/$name.out" >&2; }
}

song=$logs/short.mid
/usr/bin/python3 - "$song" << 'PYTHON'
import sys
# A fretted note that is bent, a second on another string, a pedal; a tick is a millisecond.
events = [(0, 0x90, 31, 110), (60, 0xB0, 64, 127), (20, 0xE0, 0, 90), (20, 0x90, 45, 90), (100, 0x80, 31, 64),
          (50, 0xB0, 64, 0), (50, 0x80, 45, 64)]
track = b"".join(bytes(event) for event in events) + bytes([0, 0xFF, 0x2F, 0])
with open(sys.argv[1], "wb") as out:
    out.write(b"MThd" + bytes([0, 0, 0, 6, 0, 0, 0, 1, 1, 244]) + b"MTrk" + len(track).to_bytes(4, "big") + track)
PYTHON
memcheck render build/release/bin/jawari render "$song" --preset bass-fretted -o "$logs/short.wav" --tail 0.2 --jobs 1
memcheck render-body build/release/bin/jawari render "$song" --preset sitar -o "$logs/short.wav" --tail 0.2 --jobs 1
# Traps of memory and of system calls meet valgrind's own.
memcheck engine-tests build/release/bin/engine_tests --gtest_brief=1 \
    --gtest_filter="$filter-Realtime.TheAllocationTrapFires:Realtime.*SystemCalls"
exit "$failed"
