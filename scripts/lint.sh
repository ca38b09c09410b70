#!/usr/bin/env bash
# Checks formatting (.clang-format) of all C++ sources, then runs clang-tidy (.clang-tidy) over engine and host.
# Usage: scripts/lint.sh [--fix-format|--analyze]
#   --fix-format: reformat in place instead of checking
#   --analyze: each file by itself, and with the path-sensitive analyzer as well (clang-analyzer-*): four times as long
# Without it, clang-tidy reads eight files at a time, because most of its time goes to the headers they share; a few
# checks look at a file only if it is read by itself.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

fix=false
unity=ON
checks=(-checks=-clang-analyzer-\*,-bugprone-suspicious-include)
case "${1:-}" in
    "") ;;
    --fix-format) fix=true ;;
    --analyze) checks=() unity=OFF ;;
    *) echo "lint.sh: unknown argument '$1' (allowed: --fix-format, --analyze)" >&2; exit 2 ;;
esac

mapfile -t sources < <(find benchmarks docs engine host tests -name '*.cpp' -o -name '*.h' | sort)
if $fix; then
    clang-format -i "${sources[@]}"
    exit 0
fi

failed=0
clang-format --dry-run --Werror "${sources[@]}" || failed=1
((failed)) && echo "lint: formatting differs; scripts/lint.sh --fix-format" >&2

cmake --preset lint -DCMAKE_UNITY_BUILD="$unity" > /dev/null
# Kernels are read for one instruction set: the other copies are the same source.
run-clang-tidy -quiet -p build/lint -j "$(nproc)" "${checks[@]}" -extra-arg=-DHWY_COMPILE_ONLY_STATIC \
    "$PWD/(build/lint/)?(engine|host)/.*\.c(pp|xx)$" > build/lint/tidy.log 2>&1 || failed=1
grep -vE '^(clang-tidy|[0-9]+ warnings? generated|Suppressed|Use -header-filter|$)' build/lint/tidy.log || true
((failed == 0)) && echo "lint: clean"
exit "$failed"
