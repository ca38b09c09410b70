#!/bin/bash
# The picture of docs/window.md and of README.md, from the built tests of the window: scripts/window_picture.sh [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
tests/host/window/on_display.sh "$build/bin/window_display_tests" --gtest_filter=WindowDisplay.ThePictureOfTheDocumentation
cp "$build/screenshots/window.png" docs/images/window.png
