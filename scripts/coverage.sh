#!/usr/bin/env bash
# Which lines of engine/ and host/ the tests never run.
# Usage: scripts/coverage.sh [--engine] [--no-run]
#   --engine: the engine and its own tests alone, a third of the time
#   --no-run: of the counts that are there, without running the tests again
# Prints a table of the files, least covered first; build/coverage/uncovered.txt has the lines themselves. Progress goes to
# standard error. Needs gcovr: scripts/setup.sh --coverage. Left out: tests of pitches, peers and devices, which run code
# that others run as well.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

run=true
host=ON
targets=(jawari engine_tests host_tests thread_tests play_tests stress_tests jawari_fuzzers)
for argument in "$@"; do
    case "$argument" in
        --engine) host=OFF targets=(engine_tests) ;;
        --no-run) run=false ;;
        *) echo "coverage.sh: unknown argument '$argument' (allowed: --engine, --no-run)" >&2; exit 2 ;;
    esac
done
command -v gcovr > /dev/null || { echo "coverage.sh: no gcovr; scripts/setup.sh --coverage" >&2; exit 1; }

build=build/coverage
if $run; then
    # Optimised a little: the tests are long. Not more, or lines would be merged.
    cmake -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g" \
        -DCMAKE_CXX_FLAGS="--coverage -fprofile-update=prefer-atomic" -DJAWARI_BUILD_BENCHMARKS=OFF -DJAWARI_BUILD_HOST=$host > /dev/null
    cmake --build "$build" --parallel "${JOBS:-$(nproc)}" --target "${targets[@]}" >&2
    find "$build" -name '*.gcda' -delete
    # Not soak_tests, peers, presets, live: they are not built here.
    ctest --test-dir "$build" -j "${JOBS:-$(nproc)}" -E 'NOT_BUILT|RenderPitch|^(peers|presets|examples|live|embed)' \
        --timeout 1500 >&2 || echo "coverage.sh: tests failed; counts are of what ran" >&2
fi

gcovr --root . --object-directory "$build" --filter engine/ --filter host/ --exclude-unreachable-branches \
    --gcov-ignore-parse-errors --json "$build/coverage.json" "$build" 2> "$build/gcovr.log" >&2
/usr/bin/python3 - "$build/coverage.json" "$build/uncovered.txt" << 'PYTHON'
import json
import sys

files = []
with open(sys.argv[2], "w", encoding="utf-8") as uncovered:
    for entry in json.load(open(sys.argv[1], encoding="utf-8"))["files"]:
        counts = {}
        for line in entry["lines"]:  # an inline function or template has a count for each of its copies
            if not line.get("gcovr/noncode", False):
                counts[line["line_number"]] = counts.get(line["line_number"], 0) + line["count"]
        missed = [number for number, count in sorted(counts.items()) if count == 0]
        files.append((entry["file"], len(counts), len(missed)))
        source = open(entry["file"], encoding="utf-8").read().splitlines()
        for number in missed:
            uncovered.write(f"{entry['file']}:{number}: {source[number - 1].strip()}\n")

print("| file | lines | never run | covered |\n|---|---|---|---|")
files.sort(key=lambda file: (-file[2], file[0]))
for name, lines, missed in files:
    if missed:
        print(f"| {name} | {lines} | {missed} | {100 * (lines - missed) / lines:.1f} % |")
for folder in sorted({file[0].split("/")[0] + "/" for file in files}):
    lines = sum(file[1] for file in files if file[0].startswith(folder))
    missed = sum(file[2] for file in files if file[0].startswith(folder))
    print(f"| all of {folder} | {lines} | {missed} | {100 * (lines - missed) / max(1, lines):.1f} % |")
PYTHON
