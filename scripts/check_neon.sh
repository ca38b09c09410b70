#!/usr/bin/env bash
# Compiles the engine for 64-bit ARM, where its kernels are NEON's, and for one scalar lane. Nothing is run.
# Usage: scripts/check_neon.sh     needs g++-aarch64-linux-gnu (scripts/setup.sh --full)
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

objects=$(mktemp -d)
trap 'rm -rf "$objects"' EXIT
# Header-only libraries are the same for every processor; the rest of /usr/include is not.
mkdir "$objects/include"
ln -s /usr/include/hwy /usr/include/eigen3/Eigen "$objects/include/"

# compile NAME COMPILER FLAG...: every source of the engine, in parallel.
compile() {
    local name=$1
    shift
    find engine/src -name '*.cpp' | xargs -P "$(nproc)" -I{} \
        sh -c 'source=$1; object=$2/$(echo "$source" | tr / _).o; shift 2; "$@" -c "$source" -o "$object"' _ {} "$objects" \
        "$@" -std=c++20 -O1 -Wall -Wextra -Wconversion -Wshadow -Werror -ffp-contract=off \
        -Iengine/include -Iengine/src -isystem "$objects/include"
    echo "$name: $(find engine/src -name '*.cpp' | wc -l) sources compile"
}

# As engine/CMakeLists.txt has it for this processor.
compile NEON aarch64-linux-gnu-g++ '-DHWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)'
nm -C "$objects/engine_src_string_kernels_mode_run.cpp.o" | grep -q 'N_NEON::run_modes' || { echo "check_neon.sh: no NEON kernels" >&2; exit 1; }
compile scalar g++ -DHWY_COMPILE_ONLY_SCALAR
