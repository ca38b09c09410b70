#!/usr/bin/env bash
# Installs what the program needs, builds it and the plugin, and renders the demo pieces and a plucked string to out/.
# Usage: scripts/demo.sh
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

scripts/setup.sh
# The folder of scripts/test.sh, so that it finds the program built; there without tests, unless they were asked for before.
[[ -e build/release/build.ninja ]] || cmake --preset release -DJAWARI_BUILD_TESTS=OFF -DJAWARI_BUILD_BENCHMARKS=OFF
cmake --build --preset release --parallel "$(nproc)" --target jawari
plugin=
if grep -q '^JAWARI_BUILD_PLUGINS:BOOL=ON' build/release/CMakeCache.txt; then
    cmake --build --preset release --parallel "$(nproc)" --target jawari_plugins
    plugin=build/release/plugins
fi

jawari=build/release/bin/jawari
mkdir -p out
"$jawari" render presets/demo/slap.mid --preset bass-fretted -o out/demo.wav --plot out/demo.png
scripts/make_demo_midi.py --list | while read -r piece preset; do
    "$jawari" render "presets/demo/$piece.mid" --preset "$preset" -o "out/$piece.wav"
done
"$jawari" simulate lab/bass --out out/bass.wav --plot out/bass.png

echo
echo "Listen to: $PWD/out/demo.wav   presets/demo/slap.mid on the preset bass-fretted"
echo "Its sound: $PWD/out/demo.png   waveform and spectrogram"
echo "More:      $PWD/out/*.wav      a piece for each kind of instrument (docs/presets.md)"
[[ -z $plugin ]] || echo "In a DAW:  $PWD/$plugin   the plugin as CLAP, VST 3 and LV2; cmake --install build/release --component plugin-user"
echo "A string:  $PWD/out/bass.png   the scene lab/bass: string over its frets, probe, when which fret is struck"
