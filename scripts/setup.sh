#!/usr/bin/env bash
# Installs the packages that a use of this tree needs: the one list of every dependency. For Debian 12, Debian 13 and the
# Ubuntus made from them; which names a system has is asked of apt, not of its release.
# Usage: scripts/setup.sh [--python] [--test] [--full] [--bench] [--voice] [--coverage] [--hosts] [--realtime] [--compilers]
#   (none): what building and running the program needs
#   --python: also what the Python package needs
#   --test: also what scripts/test.sh needs
#   --full: also what scripts/test.sh --full needs (lint, fuzzing, instruction counts)
#   --bench: also what scripts/bench.sh needs (plots, instruction counts, other people's instruments)
#   --voice: also what scripts/voice.py needs (recorded instruments, what plays them)
#   --coverage: also what scripts/coverage.sh needs
#   --hosts: also the hosts in which the plugin is tried (tests/hosts)
#   --realtime: also what scripts/realtime_sanitizer.sh needs (a compiler of 2025, from Debian's security archive)
#   --compilers: also every compiler that scripts/check_compilers.sh tries
# Asks nothing; does nothing when all is there. A package that only an oracle or an extra needs is optional: where the system
# does not have it, a line says what is left out.
set -euo pipefail

# use[?]  package[|package...]  purpose, or after "?" what is left out without it. Of several packages the first that there is;
# CLANG stands for the version of the system's clang.
list() {
    cat << 'LIST'
program      build-essential         C++20 compiler
program      cmake                   3.25 or later
program      ninja-build             generator of the presets
program      pkg-config              finds libhwy, libsndfile and what play needs
program      libeigen3-dev           dense linear algebra while compiling models
program      libhwy-dev              SIMD kernels with run-time dispatch (Highway)
program      libcli11-dev            command line
program      nlohmann-json3-dev      scenes and presets
program      libsndfile1-dev         WAV
program      libhdf5-dev             .h5 recordings
program      libboost-dev            Boost.Lockfree: queues between threads; tests: Boost.Multiprecision, 100-digit references
program      gnuplot-nox             --plot
program      fonts-dejavu-core       labels of plots
program      librtaudio-dev          play: audio devices
program      librtmidi-dev           play: MIDI devices
program      libjack-jackd2-dev      the JACK that the two are used with here (they would take the older one); play: connections that are cut
program      libedit-dev             play: shell
program      liblo-dev               play: Open Sound Control
program      python3                 names of the demo pieces
program?     dpf-source              headers of CLAP and VST 3: the plugin is not built
program?     libgl-dev               the window is not built
program?     libx11-dev              the window is not built
program?     libxext-dev             the window is not built
program?     libxcursor-dev          the window is not built
program?     libxrandr-dev           the window is not built
program?     lv2-dev                 headers of LV2: the plugin is not built as LV2
python       pybind11-dev            the Python package
python       python3-dev             Python's headers: the Python package
python       python3-numpy           the Python package
python       python3-pip             pip install ./python
python       python3-venv            environments of its own
python       python3-setuptools      pip install --no-build-isolation
python?      python3-xarray          labelled results: to_xarray() does not work
python?      python3-h5py            campaigns: no results.h5
python?      python3-distributed     campaigns: --dask does not work
test         git                     which files are tracked
test         libgtest-dev            GoogleTest
test         libbenchmark-dev        Google Benchmark
test         python3-numpy           reference simulations, measurement of pitch and level
test?        python3-siconos         the published nonsmooth solver: its tests are skipped, scripts/bench.sh siconos cannot run
test?        python3-mpmath          high-precision references: their tests are skipped
test?        python3-h5py            independent reader of .h5 recordings: its tests are skipped
test?        pybind11-dev            the Python package is not built, and not tested
test?        python3-dev             Python's headers: the Python package is not built, and not tested
test?        python3-xarray          labels and netCDF: their tests are skipped
test?        python3-h5netcdf        independent reader of netCDF: its tests are skipped
test?        python3-jsonschema      independent judge of the schema of scenes: its test is skipped
test?        python3-distributed     campaigns on Dask: their test is skipped
test?        slurmctld               campaigns on Slurm: their test is skipped
test?        slurmd                  campaigns on Slurm: their test is skipped
test?        slurm-client            campaigns on Slurm: their test is skipped
test?        munge                   campaigns on Slurm: their test is skipped
test?        midicsv                 independent reader of MIDI files: its tests are skipped
test?        sordi                   reads LV2 bundles (lv2_validate): its test is skipped
test?        lilv-utils              what LV2 hosts see (lv2info): its test is skipped
test?        jalv                    LV2 host: live.jalv is skipped
test?        jackd2                  sound server without hardware: live.* are skipped
test?        jack-example-tools|jackd2 jack_wait and jack_rec: live.* are skipped
test?        xvfb                    a display without a screen: window.display is skipped
test?        xdotool                 mouse and keys: window.display is skipped
test?        imagemagick             screenshots: window.display is skipped
test?        libgl1-mesa-dri         OpenGL in software: window.display is skipped
full         clang                   libFuzzer and sanitizer builds
full         clang-format            scripts/lint.sh
full         clang-tidy              scripts/lint.sh
full         libclang-rt-CLANG-dev|libclang-common-CLANG-dev libFuzzer and sanitizer run times
full         valgrind                instruction counts
full?        g++-aarch64-linux-gnu   cross compiler: scripts/check_neon.sh cannot run
full?        doxygen                 reference of the public headers: docs.doxygen is skipped
full?        openttd-openmsx         music that nobody here wrote: scripts/real_midi.py needs --download
bench        valgrind                instruction counts
bench        python3-matplotlib      plots of docs/benchmarks.md
bench?       csound                  peer (plucked strings, prepared piano): scripts/bench.sh peers cannot run
bench?       libstk-dev              peer (plucked strings): scripts/bench.sh peers cannot run
bench?       faust                   peer (physical models): scripts/bench.sh peers cannot run
voice        fluidsynth              plays the recorded sets (scripts/voice.py)
voice        fluid-soundfont-gm      recorded set
voice        timgm6mb-soundfont      recorded set
voice        musescore-general-soundfont recorded set
voice        python3-matplotlib      picture of docs/voicing.md
coverage     clang                   counts what runs
coverage     libclang-rt-CLANG-dev|libclang-common-CLANG-dev its run time
coverage     llvm                    sums it up
hosts        ardour                  hosts.ardour, hosts.ardour_windows
hosts?       qtractor                hosts.qtractor_windows is skipped
hosts?       libqt5x11extras5        jalv.qt5: left out of hosts.jalv_windows
hosts?       openbox                 window manager of the hosts: hosts.*_windows are skipped
realtime     clang-22                -Wfunction-effects, -fsanitize=realtime
realtime     libclang-rt-22-dev      the sanitizer's run time
realtime     llvm-22                 llvm-symbolizer: lines instead of addresses
compilers?   g++-12                  not tried
compilers?   g++-13                  not tried
compilers?   g++-14                  not tried
compilers?   clang-14                not tried
compilers?   clang-15                not tried
compilers?   clang-16                not tried
compilers?   clang-17                not tried
compilers?   clang-18                not tried
compilers?   clang-19                not tried
LIST
}

uses=" program "
for argument in "$@"; do
    case "$argument" in
        --python) uses+="python " ;;
        --test) uses+="test " ;;
        --full) uses+="test full " ;;
        --bench) uses+="test bench " ;;
        --voice) uses+="test voice " ;;
        --coverage) uses+="test coverage " ;;
        --hosts) uses+="test hosts " ;;
        --realtime) uses+="test realtime " ;;
        --compilers) uses+="test compilers " ;;
        *) echo "setup.sh: unknown argument '$argument' (allowed: --python, --test, --full, --bench, --voice, --coverage, --hosts, --realtime, --compilers)" >&2; exit 2 ;;
    esac
done

# wanted: the lines of the list for these uses.
wanted() {
    local use names purpose
    while read -r use names purpose; do
        [[ $uses == *" ${use%\?} "* ]] && printf '%s %s %s\n' "$use" "$names" "$purpose"
    done < <(list)
    return 0
}

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    echo "setup.sh: no apt here; install the equivalents of these (? marks what can be done without):" >&2
    wanted >&2
    exit 1
fi

declare -A status
while read -r name state; do status[$name]=$state; done < <(dpkg-query -W -f '${Package} ${db:Status-Status}\n')
installed() { [[ ${status[$1]:-} == installed ]]; }
# By its own name: where no package has it, apt takes one with a plus sign for a pattern.
available() { [[ $(apt-cache policy "$1" 2> /dev/null) =~ ^"$1":[^:]*Installed:[^:]*Candidate:\ [^\(] ]]; }
clang_version() { apt-cache depends clang 2> /dev/null | sed -n 's/.*Depends: clang-\([0-9]*\)$/\1/p'; }

# choose: sorts what is wanted into packages (there or to be had), left_out (optional ones) and unknown.
choose() {
    local use names purpose name found clang
    clang=$(clang_version)
    packages=() missing=() left_out=() unknown=()
    while read -r use names purpose; do
        found=
        for name in ${names//|/ }; do
            name=${name/CLANG/$clang}
            if installed "$name"; then
                found=$name
            elif available "$name"; then
                found=$name
                missing+=("$name")
            fi
            [[ -n $found ]] && break
        done
        if [[ -n $found ]]; then
            packages+=("$found")
        elif [[ $use == *\? ]]; then
            left_out+=("setup: left out, because this system has no ${names//|/ or }: $purpose")
        else
            unknown+=("$names")
        fi
    done < <(wanted)
}

as_root=()
[[ $(id -u) == 0 ]] || as_root=(sudo)
apt_get() {
    if [[ $(id -u) != 0 ]] && ! command -v sudo > /dev/null; then
        echo "setup.sh: not root and no sudo; as root: apt-get install ${missing[*]} ${unknown[*]}" >&2
        exit 1
    fi
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@" < /dev/null
}

choose
if ((${#missing[@]} + ${#unknown[@]})); then
    apt_get update -qq
    choose
    if ((${#unknown[@]})); then
        echo "setup.sh: apt knows no ${unknown[*]} here (on Ubuntu they are in universe)" >&2
        exit 1
    fi
fi
if ((${#missing[@]})); then
    echo "setup: installing ${missing[*]}"
    # All are named, not the missing ones alone: else apt may remove one of them to make room for another.
    apt_get install -y -qq --no-install-recommends "${packages[@]}"
fi
echo "setup: all ${#packages[@]} packages are installed"
((${#left_out[@]} == 0)) || printf '%s\n' "${left_out[@]}"
