#!/usr/bin/env bash
# Compiles the engine, and of the host what a plugin would use (files, MIDI, player), for 64-bit ARM, where the kernels are
# NEON's; and the engine for one scalar lane. Nothing is run.
# Usage: scripts/check_neon.sh     needs g++-aarch64-linux-gnu (scripts/setup.sh --full)
# The files of a folder are read together, and only checked: code is generated for one kernel, whose symbols tell whether NEON
# was chosen.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

units=$(mktemp -d)
trap 'rm -rf "$units"' EXIT
# Header-only libraries and declarations in plain C are the same for every processor; the rest of /usr/include is not.
mkdir "$units/include"
ln -s /usr/include/hwy /usr/include/eigen3/Eigen /usr/include/nlohmann /usr/include/boost /usr/include/sndfile.h "$units/include/"

flags=(-std=c++20 -O1 -Wall -Wextra -Wconversion -Wshadow -Werror -ffp-contract=off -Iengine/include -isystem "$units/include")
# As engine/CMakeLists.txt has it for this processor; that GCC 10 passed pairs differently concerns nobody.
neon=(aarch64-linux-gnu-g++ '-DHWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)' -Wno-psabi "${flags[@]}")
scalar=(g++ -DHWY_COMPILE_ONLY_SCALAR "${flags[@]}")

# make_units FOLDER...: one file per folder below that includes its sources, and one per source that Highway reads once per
# instruction set, because it does so for one file of a unit.
make_units() {
    local folder source unit
    while read -r folder; do
        unit=$units/$(tr / _ <<< "$folder").cpp
        for source in "$folder"/*.cpp; do
            if grep -q 'hwy/foreach_target\.h' "$source"; then
                echo "#include \"$PWD/$source\"" > "$units/$(tr / _ <<< "${source%.cpp}").cpp"
            else
                echo "#include \"$PWD/$source\"" >> "$unit"
            fi
        done
    done < <(find "$@" -name '*.cpp' -printf '%h\n' | sort -u)
}

# check NAME COMPILER FLAG...: every unit, in parallel.
check() {
    local name=$1
    shift
    find "$units" -maxdepth 1 -name '*.cpp' -print0 | xargs -0 -P "$(nproc)" -n 1 "$@" -fsyntax-only
    echo "$name: $(cat "$units"/*.cpp | wc -l) sources compile"
}

make_units engine/src
check "scalar, engine" "${scalar[@]}" -Iengine/src
check "NEON, engine" "${neon[@]}" -Iengine/src
"${neon[@]}" -Iengine/src -c engine/src/string/kernels/mode_run.cpp -o "$units/mode_run.o"
nm -C "$units/mode_run.o" | grep -q 'N_NEON::run_modes' || { echo "check_neon.sh: no NEON kernels" >&2; exit 1; }
rm "$units"/*.cpp
make_units host/base host/formats host/instrument host/midi host/stage host/player host/plugin/core
check "NEON, player" "${neon[@]}" -Ihost
