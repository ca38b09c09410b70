#!/usr/bin/env bash
# Compiles every source with every compiler that is installed, warnings as errors: g++ 12 and later, clang 14 and later.
# Usage: scripts/check_compilers.sh [--optimised] [--apart] [COMPILER...]     such as g++-13 clang++-17; all that are there unless told
#   --optimised: as for a release; without it sources are only read, which takes half as long and leaves out the warnings that
#                GCC's optimiser gives
#   --apart: each file by itself, which shows a missing include and takes three times as long; without it several files are one unit, as
#            in every build but the preset dev
# scripts/setup.sh --compilers installs those that the system has. What compilers say is in build/compilers/COMPILER/warnings.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

how=-fsyntax-only
joined=ON
compilers=()
for argument in "$@"; do
    case "$argument" in
        --optimised) how="-o /dev/null" ;;
        --apart) joined=OFF ;;
        g++-* | clang++-*) compilers+=("$argument") ;;
        *) echo "check_compilers.sh: unknown argument '$argument' (allowed: --optimised, --apart, g++-N, clang++-N)" >&2; exit 2 ;;
    esac
done
if ((${#compilers[@]} == 0)); then
    for version in {12..30}; do command -v "g++-$version" > /dev/null && compilers+=("g++-$version"); done
    for version in {14..30}; do command -v "clang++-$version" > /dev/null && compilers+=("clang++-$version"); done
fi
((${#compilers[@]})) || { echo "check_compilers.sh: no compiler is called g++-N or clang++-N here" >&2; exit 1; }

# compile SOURCE COMMAND: prints its name if the compiler has anything to say.
compile() { bash -c "$2" >> "$warnings" 2>&1 || echo "$1"; }
export -f compile

failed=0
for compiler in "${compilers[@]}"; do
    start=$SECONDS
    build=build/compilers/$compiler
    mkdir -p "$build"
    export warnings=$PWD/$build/warnings
    : > "$warnings"
    cmake -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
        -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DJAWARI_JOIN_FILES=$joined -DJAWARI_WARNINGS_AS_ERRORS=ON > "$build/configure.log" 2>&1 ||
        { cat "$build/configure.log" >&2; failed=1; continue; }
    bad=$(python3 - "$build/compile_commands.json" "$how" << 'PYTHON' | xargs -0 -n 2 -P "${JOBS:-$(nproc)}" bash -c 'compile "$@"' _
import json
import re
import sys

for entry in json.load(open(sys.argv[1], encoding="utf-8")):
    if entry["file"].endswith((".cpp", ".cxx")):  # .cxx: several files in one unit
        command = re.sub(r" -o \S+", " " + sys.argv[2], entry["command"])
        print(entry["file"], f"cd '{entry['directory']}' && {command}", sep="\0", end="\0")
PYTHON
    )
    files=$(grep -cE '"file": .*\.(cpp|cxx)"' "$build/compile_commands.json")
    said=$(grep -c 'warning:' "$warnings" || true)  # of kinds that -Werror leaves
    echo "$compiler ($("$compiler" -dumpfullversion -dumpversion 2> /dev/null)): $files units, $(grep -c . <<< "$bad" || true) refused," \
        "$said warnings, $((SECONDS - start)) s"
    if [[ -n $bad || $said != 0 ]]; then
        printf '%s\n' "$bad" >&2
        failed=1
    fi
done
exit "$failed"
