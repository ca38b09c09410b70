#!/usr/bin/env bash
# Which lines of engine/ and host/ the tests never run.
# Usage: scripts/coverage.sh [--engine] [--no-run]
#   --engine: the engine and its own tests alone
#   --no-run: of the counts that are there, without running the tests again
# Prints a table of the files, least covered first; build/coverage/uncovered.txt (build/coverage-engine with --engine) has the
# lines themselves. Progress goes to standard error. Needs clang and llvm: scripts/setup.sh --coverage. Left out: tests of
# pitches, presets and peers, which run code that others run as well. What a killed program ran is not counted. Tests of full
# disks and missing rights, where the counts cannot be written either, and of gaps in the sound fail under it.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

run=true
host=ON
build=build/coverage
folders=(engine host)
targets=(jawari engine_tests host_tests thread_tests plugin_tests play_tests stress_tests midi_sender machine_gaps jawari_fuzzers)
for argument in "$@"; do
    case "$argument" in
        --engine) host=OFF build=build/coverage-engine folders=(engine) targets=(engine_tests) ;;
        --no-run) run=false ;;
        *) echo "coverage.sh: unknown argument '$argument' (allowed: --engine, --no-run)" >&2; exit 2 ;;
    esac
done
for tool in clang++ llvm-profdata llvm-cov; do
    command -v "$tool" > /dev/null || { echo "coverage.sh: no $tool; scripts/setup.sh --coverage" >&2; exit 1; }
done

profiles=$PWD/$build/profiles
if $run; then
    # Optimised a little, and with as few random scenes as under sanitizers: the tests are long. Kernels for one instruction
    # set, or the counts of their copies would not be told apart.
    cmake -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1" -DJAWARI_BUILD_BENCHMARKS=OFF -DJAWARI_BUILD_HOST=$host \
        -DCMAKE_CXX_FLAGS="-fprofile-instr-generate -fcoverage-mapping -fprofile-update=atomic -DJAWARI_SANITIZED -DHWY_COMPILE_ONLY_STATIC" > /dev/null
    cmake --build "$build" --parallel "${JOBS:-$(nproc)}" --target "${targets[@]}" >&2
    rm -rf "$profiles"
    mkdir -p "$profiles"
    # Each program adds to one of two files of its own.
    LLVM_PROFILE_FILE="$profiles/%2m.profraw" ctest --test-dir "$build" -j "${JOBS:-$(nproc)}" \
        -E 'NOT_BUILT|RenderPitch|^(peers|presets|examples|embed)|live.loop_latency' --timeout 1500 >&2 ||
        echo "coverage.sh: tests failed; counts are of what ran" >&2
fi

llvm-profdata merge -sparse "$profiles"/*.profraw -o "$build/all.profdata"
programs=()
for program in "$build"/bin/*; do programs+=(-object "$program"); done
llvm-cov export -format=lcov -instr-profile="$build/all.profdata" "${programs[@]:1}" "${folders[@]}" > "$build/coverage.lcov"
/usr/bin/python3 - "$build/coverage.lcov" "$build/uncovered.txt" << 'PYTHON'
import os
import re
import sys

counts = {}  # of a file's lines: how often each ran
for entry in open(sys.argv[1], encoding="utf-8"):
    kind, _, rest = entry.rstrip().partition(":")
    if kind == "SF":
        lines = counts.setdefault(os.path.relpath(rest), {})
    elif kind == "DA":
        number, count = map(int, rest.split(",")[:2])
        lines[number] = lines.get(number, 0) + count

files = []
with open(sys.argv[2], "w", encoding="utf-8") as uncovered:
    for name, lines in sorted(counts.items()):
        source = open(name, encoding="utf-8").read().splitlines()
        # Regions hold comments, empty lines and lone braces as well.
        code = {number: count for number, count in lines.items() if not re.fullmatch(r"\s*(//.*|[{}();,]*)\s*", source[number - 1])}
        missed = [number for number, count in sorted(code.items()) if count == 0]
        files.append((name, len(code), len(missed)))
        for number in missed:
            uncovered.write(f"{name}:{number}: {source[number - 1].strip()}\n")

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
