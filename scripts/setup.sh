#!/usr/bin/env bash
# Installs what building and testing need on Debian 12: the one list of every dependency.
# Usage: scripts/setup.sh [--full] [--bench] [--coverage] [--realtime]
#   --full: also what scripts/test.sh --full needs (lint, fuzzing, instruction counts)
#   --bench: also what scripts/bench.sh needs (plots, instruction counts, other people's instruments)
#   --coverage: also what scripts/coverage.sh needs
#   --realtime: also what scripts/realtime_sanitizer.sh needs (a compiler of 2025, from Debian's security archive)
# Asks nothing; does nothing when all is there.
set -euo pipefail

packages=(
    # -- build
    build-essential   # g++ 12
    cmake             # 3.25
    ninja-build       # generator of the presets
    pkg-config        # finds libhwy and libsndfile
    git               # version control; the clone itself
    # -- engine
    libeigen3-dev     # dense linear algebra while compiling models
    libhwy-dev        # SIMD kernels with run-time dispatch (Highway)
    # -- program
    libcli11-dev      # command line
    nlohmann-json3-dev # scenes and presets
    libsndfile1-dev   # WAV
    libhdf5-dev       # .h5 recordings
    libboost-dev      # Boost.Lockfree: queues between threads; in tests Boost.Multiprecision: 100-digit references
    gnuplot-nox       # --plot
    fonts-dejavu-core # its labels
    librtaudio-dev    # play: audio devices
    librtmidi-dev     # play: MIDI devices
    libjack-jackd2-dev # the JACK that the two are used with here (they would take the older one)
    libedit-dev       # play: shell
    liblo-dev         # play: Open Sound Control
    # -- tests and benchmarks
    libgtest-dev      # GoogleTest
    libbenchmark-dev  # Google Benchmark
    midicsv           # independent reading of MIDI files
    jackd2            # live tests: a sound server without hardware
    python3           # test scripts
    python3-numpy     # reference simulations, pitch measurement
    python3-h5py      # independent reading of .h5 recordings
    python3-mpmath    # high-precision references
    python3-siconos   # the published nonsmooth solver, as an oracle
)
packages_full=(
    clang-format      # scripts/lint.sh
    clang-tidy        # scripts/lint.sh
    clang             # libFuzzer builds
    g++-aarch64-linux-gnu # scripts/check_neon.sh
    libclang-rt-14-dev # libFuzzer and sanitizer run times
    openttd-openmsx   # scripts/real_midi.py: music that nobody here wrote
    valgrind          # instruction counts
)
packages_bench=(
    valgrind          # instruction counts
    python3-matplotlib # plots of docs/benchmarks.md
    csound            # peer: plucked strings, prepared piano
    libstk-dev        # peer: plucked strings
    faust             # peer: physical models
)
packages_coverage=(
    clang             # counts what runs
    libclang-rt-14-dev # its run time
    llvm              # sums it up
)
packages_realtime=(
    clang-22          # -Wfunction-effects, -fsanitize=realtime
    libclang-rt-22-dev # the sanitizer's run time
    llvm-22           # llvm-symbolizer: lines instead of addresses
)

for argument in "$@"; do
    case "$argument" in
        --full) packages+=("${packages_full[@]}") ;;
        --bench) packages+=("${packages_bench[@]}") ;;
        --coverage) packages+=("${packages_coverage[@]}") ;;
        --realtime) packages+=("${packages_realtime[@]}") ;;
        *) echo "setup.sh: unknown argument '$argument' (allowed: --full, --bench, --coverage, --realtime)" >&2; exit 2 ;;
    esac
done

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    echo "setup.sh: no apt here; install the equivalents of: ${packages[*]}" >&2
    exit 1
fi

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
    [[ "$status" == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    echo "setup: all ${#packages[@]} packages are installed"
    exit 0
fi

as_root=()
if [[ $(id -u) != 0 ]]; then
    if ! command -v sudo > /dev/null; then
        echo "setup.sh: not root and no sudo; as root: apt-get install ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
# All are named, not the missing ones alone: else apt may remove one of them to make room for another.
apt_get() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@" < /dev/null
}
apt_get update -qq
apt_get install -y -qq --no-install-recommends "${packages[@]}"
