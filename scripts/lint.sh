#!/usr/bin/env bash
# Checks formatting (.clang-format) of all C++ sources, then runs clang-tidy (.clang-tidy) over engine, host and python.
# Usage: scripts/lint.sh [--fix-format|--analyze]
#   --fix-format: reformat in place instead of checking
#   --analyze: each file by itself, with the path-sensitive analyzer (clang-analyzer-*) and with performance-unnecessary-value-param, which
#              takes a third of the time of all checks: several times as long
# Without it, clang-tidy reads up to eight files of a layer at a time, because most of its time goes to the headers they share;
# a few checks look at a file only if it is read by itself.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

fix=false
unity=ON
checks=(-checks=-clang-analyzer-\*,-bugprone-suspicious-include,-performance-unnecessary-value-param)
case "${1:-}" in
    "") ;;
    --fix-format) fix=true ;;
    --analyze) checks=() unity=OFF ;;
    *) echo "lint.sh: unknown argument '$1' (allowed: --fix-format, --analyze)" >&2; exit 2 ;;
esac

# files_in FOLDER...: sources and headers; not what pip has left in python/build.
files_in() { find "$@" -path python/build -prune -o \( -name '*.cpp' -o -name '*.h' \) -print | sort; }

mapfile -t sources < <(files_in benchmarks docs engine host python tests)
if $fix; then
    clang-format -i "${sources[@]}"
    exit 0
fi

failed=0
printf '%s\0' "${sources[@]}" | xargs -0 -n 50 -P "$(nproc)" clang-format --dry-run --Werror || failed=1
((failed)) && echo "lint: formatting differs; scripts/lint.sh --fix-format" >&2

# configure FOLDER UNITY: compile commands for build/FOLDER.
configure() {
    cmake --preset lint -B "build/$1" -DCMAKE_UNITY_BUILD="$2" -DJAWARI_JOIN_FILES="$2" > /dev/null
}

# Kernels are read for one instruction set: the other copies are the same source.
tidy() {
    clang-tidy -quiet -p "build/$1" "${checks[@]}" -extra-arg=-DHWY_COMPILE_ONLY_STATIC "$2" 2> /dev/null
}

# units_of FOLDER: what is compiled for engine, host and python, the units that take longest (those of several files) first.
units_of() {
    sed -n 's/^  "file": "\(.*\)".*/\1/p' "build/$1/compile_commands.json" | grep -E "^$PWD/((build/$1/)?(engine|host|python)/)" |
        grep -v builtin_table | sort -u | awk '{ print (/_cxx\.cxx$/ ? 0 : 1), $0 }' | sort | cut -d ' ' -f 2-
}

# lint_unit FILE: what clang-tidy finds. Files that use one name for two things cannot be read together: then one by one.
lint_unit() {
    local found member bad=0
    if [[ $1 != *_cxx.cxx ]]; then
        tidy lint-files "$1"
        return
    fi
    found=$(tidy lint "$1") && return
    if [[ $found != *clang-diagnostic-error* ]]; then
        printf '%s\n' "$found"
        return 1
    fi
    while read -r member; do tidy lint-files "$member" || bad=1; done < <(sed -n 's/^#include "\(.*\)"$/\1/p' "$1")
    return "$bad"
}

configure lint-files OFF
if [[ $unity == ON ]]; then
    configure lint ON
    mapfile -t units < <(units_of lint)
else
    mapfile -t units < <(files_in engine host python | grep '\.cpp$')
fi
export -f tidy lint_unit
export checks_text="${checks[*]}"
printf '%s\0' "${units[@]}" |
    xargs -0 -n 1 -P "$(nproc)" bash -c 'read -ra checks <<< "$checks_text"; lint_unit "$0"' || failed=1
((failed == 0)) && echo "lint: clean"
exit "$failed"
