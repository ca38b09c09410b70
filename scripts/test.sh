#!/usr/bin/env bash
# Builds the program and all tests and runs them. Usage: scripts/test.sh [--full]
#   --full: also the benchmarks, warnings as errors, lint, the engine compiled for NEON and for one lane, the tests under
#           address, undefined-behaviour and thread sanitizers, each fuzz target for four seconds, and instruction counts
#           against their table.
# Every stage runs even if one before it failed; what failed ones said last, the time of each stage (and the time its
# processes used, so that an idle core shows) and the summaries of all test runs close the output.
set -uo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." || exit 1

full=false
case "${1:-}" in
    "") ;;
    --full) full=true ;;
    *) echo "test.sh: unknown argument '$1' (allowed: --full)" >&2; exit 2 ;;
esac

jobs=$(nproc)
export CTEST_PARALLEL_LEVEL=$((jobs + 1))  # tests that play or draw wait most of their time; CTest counts a core for each
export UBSAN_OPTIONS=print_stacktrace=1
logs=$(mktemp -d) || exit 1
trap 'rm -rf "$logs"' EXIT
stages=()     # one line each
test_runs=()  # ctest's closing lines of each test run
failures=()   # the last lines of each stage that failed
failed=0

# processor_seconds: what the processes that this script has waited for have used so far, in whole seconds.
processor_seconds() {
    times > "$logs/times"
    used_s=$(tail -n 1 "$logs/times" | tr 'ms' '  ' | awk '{ printf "%d", 60 * ($1 + $3) + $2 + $4 }')
}

# stage NAME COMMAND...: runs it, keeps its output, notes failure and time. Exit code 77: cannot be done on this machine.
stage() {
    local name=$1 start=$SECONDS start_used result=passed took
    processor_seconds
    start_used=$used_s
    shift
    printf '\n== %s\n' "$name"
    "$@" 2>&1 | tee "$logs/last"
    local status=${PIPESTATUS[0]}
    if ((status == 77)); then
        result="skipped, $(sed -n 's/^SKIPPED: //p' "$logs/last" | head -n 1)"
    elif ((status != 0)); then
        result=FAILED
    fi
    processor_seconds
    took="$((SECONDS - start)) s (processors $((used_s - start_used)) s)"
    stages+=("$name: $result, $took")
    if [[ $result == FAILED ]]; then
        failures+=("" "== $name failed:" "$(grep -E -A 30 '\*\*\*(Failed|Exception|Timeout)' "$logs/last" | tail -n 90)"
            "$(tail -n 25 "$logs/last")")
        failed=1
        return 1
    fi
}

# build PRESET [TARGET...]: all of it unless told.
build() {
    local preset=$1
    shift
    cmake --preset "$preset" "${configure_arguments[@]}" && cmake --build --preset "$preset" --parallel "$jobs" ${1:+--target "$@"}
}

# tests PRESET CTEST-ARGUMENTS...: a test run whose closing lines are repeated at the end.
tests() {
    local preset=$1
    shift
    # Tests run side by side; numpy and Siconos must not multiply them. Not for all stages: nproc obeys OMP_NUM_THREADS too.
    stage "tests ($preset)" env OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 ctest --preset "$preset" --no-tests=error --output-junit "$logs/junit.xml" "$@"
    test_runs+=("" "$preset:" "$(sed -n '/% tests passed/,$p' "$logs/last")" "$(scripts/skipped_tests.py "$logs/junit.xml")")
}

# fuzz_target PROGRAM: four seconds, the reading of its seeds included, and a fresh corpus; a crash leaves its input in build/asan-ubsan/.
fuzz_target() {
    local name=${1##*/fuzz_}
    local corpus=$logs/corpus_$name
    mkdir -p "$corpus"
    "$1" -max_total_time=4 -timeout=25 -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 \
        -artifact_prefix="build/asan-ubsan/$name-" "$corpus" "build/asan-ubsan/seeds/$name" > "$corpus.log" 2>&1
    local status=$?
    echo "-- $name"
    cat "$corpus.log"
    return "$status"
}
fuzz() {
    export -f fuzz_target
    export logs
    printf '%s\0' build/asan-ubsan/bin/fuzz_* | xargs -0 -n 1 -P "$jobs" bash -c 'fuzz_target "$0"'
}

stage "setup" scripts/setup.sh "$($full && echo --full || echo --test)" || exit 1
configure_arguments=(-DJAWARI_WARNINGS_AS_ERRORS=$($full && echo ON || echo OFF))
stage "build (release)" build release $($full && echo all || echo jawari_tested) && tests release

if $full; then
    stage "instruction counts" benchmarks/instructions/count.py
    stage "lint" scripts/lint.sh
    stage "other instruction sets" scripts/check_neon.sh
    stage "build (asan-ubsan)" build asan-ubsan jawari engine_tests host_tests thread_tests plugin_tests play_tests window_tests \
        stress_tests jawari_fuzzers &&
        tests asan-ubsan -LE 'peers|presets|examples|live|hosts|window' && stage "fuzzing" fuzz
    stage "build (tsan)" build tsan jawari thread_tests plugin_tests window_tests && tests tsan -L 'threads|plugin'
fi

printf '%s\n' "${failures[@]}"
printf '\n== Summary (%d min %d s)\n' $((SECONDS / 60)) $((SECONDS % 60))
printf '%s\n' "${stages[@]}" "${test_runs[@]}"
exit "$failed"
