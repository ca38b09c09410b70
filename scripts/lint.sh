#!/usr/bin/env bash
# Checks formatting (.clang-format) of all C++ sources, then runs clang-tidy (.clang-tidy) over engine and host.
# Usage: scripts/lint.sh [--fix-format|--analyze]
#   --fix-format: reformat in place instead of checking
#   --analyze: with the path-sensitive analyzer as well (clang-analyzer-*), which takes twice as long
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

fix=false
checks=(-checks=-clang-analyzer-\*)
case "${1:-}" in
    "") ;;
    --fix-format) fix=true ;;
    --analyze) checks=() ;;
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

cmake --preset release > /dev/null
# Kernels are read for one instruction set: the other copies are the same source.
run-clang-tidy -quiet -p build/release -j "$(nproc)" "${checks[@]}" -extra-arg=-DHWY_COMPILE_ONLY_STATIC \
    "$PWD/(engine|host)/.*\.cpp$" > build/release/tidy.log 2>&1 || failed=1
grep -vE '^(clang-tidy|[0-9]+ warnings? generated|Suppressed|Use -header-filter|$)' build/release/tidy.log || true
((failed == 0)) && echo "lint: clean"
exit "$failed"
