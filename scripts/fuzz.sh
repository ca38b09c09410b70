#!/usr/bin/env bash
# Fuzzes for a long time: each target in turn, from its seeds and from what earlier runs have found.
# Usage: scripts/fuzz.sh [SECONDS] [TARGET...] [--merge]
#   SECONDS: of each target; 3600 unless told
#   TARGET: events, scene, preset, ... (tests/fuzz/fuzz_TARGET.cpp); all unless told
#   --merge: afterwards, inputs that reach code which the seeds do not reach are added to tests/fuzz/seeds/found-TARGET.tar.xz
# Progress goes to standard error, a line for each target that is done to standard output. The corpus is kept in
# build/fuzz/TARGET, so that a run that is interrupted goes on where it stopped; inputs that break something are
# build/fuzz/TARGET-crash-*, -timeout-*, -oom-*. To see one again: build/asan-ubsan/bin/fuzz_TARGET FILE
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

seconds=3600
merge=false
targets=()
for argument in "$@"; do
    case "$argument" in
        --merge) merge=true ;;
        -*) echo "fuzz.sh: unknown argument '$argument' (allowed: [SECONDS] [TARGET...] [--merge])" >&2; exit 2 ;;
        *[!0-9]*)
            if [[ ! -f tests/fuzz/fuzz_$argument.cpp ]]; then
                echo "fuzz.sh: no target '$argument' (allowed: $(cd tests/fuzz && ls fuzz_*.cpp | sed 's/fuzz_//; s/\.cpp//' | tr '\n' ' '))" >&2
                exit 2
            fi
            targets+=("$argument") ;;
        *) seconds=$argument ;;
    esac
done

cmake --preset asan-ubsan > /dev/null
cmake --build --preset asan-ubsan --parallel "${JOBS:-$(nproc)}" --target jawari_fuzzers >&2
if ((${#targets[@]} == 0)); then
    for program in build/asan-ubsan/bin/fuzz_*; do targets+=("${program##*/fuzz_}"); done
fi
export UBSAN_OPTIONS=print_stacktrace=1

# pack FOLDER ARCHIVE: the same files make the same bytes, whoever packs them and when.
pack() {
    (export LC_ALL=C; cd "$1" && tar --sort=name --format=ustar --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=644 -cf - -- *) |
        xz -9e > "$2"
}

# Adds to the seeds as few inputs as reach all code that they do not reach, under names that say what they are from.
merge_found() {
    local name=$1 merged=build/fuzz/merged_$1 found=build/fuzz/found_$1 file
    local archive=tests/fuzz/seeds/found-$name.tar.xz
    rm -rf "$merged" "$found"
    mkdir -p "$merged" "$found"
    if [[ -e $archive ]]; then tar -xf "$archive" -C "$found"; fi
    cp "build/asan-ubsan/seeds/$name"/* "$merged"
    build/asan-ubsan/bin/fuzz_"$name" -set_cover_merge=1 -use_counters=0 "$merged" "build/fuzz/$name" 2> /dev/null
    for file in "$merged"/*; do
        [[ -e build/asan-ubsan/seeds/$name/${file##*/} ]] || cp "$file" "$found/found-${file##*/}"
    done
    if [[ -n $(ls "$found") ]]; then pack "$found" "$archive"; fi
    rm -r "$merged" "$found"
}

failed=0
for name in "${targets[@]}"; do
    corpus=build/fuzz/$name
    log=build/fuzz/$name.log
    mkdir -p "$corpus"
    begin=$SECONDS
    status=0
    build/asan-ubsan/bin/fuzz_"$name" -max_total_time="$seconds" -timeout=25 -rss_limit_mb=2048 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/$name-" "$corpus" "build/asan-ubsan/seeds/$name" 2>&1 |
        tee "$log" >&2 || status=$?
    runs=$(sed -n 's/^stat::number_of_executed_units: //p' "$log" | tail -1)
    reached=$(grep -o 'cov: [0-9]*' "$log" | tail -1 | cut -d' ' -f2 || true)
    outcome="nothing found"
    if ((status != 0)); then
        found=$(grep -o "build/fuzz/$name-[a-z]*-[0-9a-f]*" "$log" | tail -1 || true)
        outcome=${found:+FOUND: $found}
        outcome=${outcome:-ended with $status}
    fi
    echo "$name: ${runs:-?} inputs in $((SECONDS - begin)) s, ${reached:-?} edges reached, $(
        find "$corpus" -type f | wc -l) kept, $outcome"
    ((status == 0)) || failed=1
    if $merge; then merge_found "$name"; fi
done
exit "$failed"
