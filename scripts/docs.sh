#!/usr/bin/env bash
# Builds the reference of the public headers with Doxygen and fails at any warning. Outside detail/, a function, type or
# field without a comment is one.
# Usage: scripts/docs.sh [FOLDER]     FOLDER: where html/ goes, build/docs if left out
# Exit code 77: Doxygen is not there.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

if ! command -v doxygen > /dev/null; then
    echo "skipped: doxygen is not installed"
    exit 77
fi
out=${1:-build/docs}
mkdir -p "$out"

# doxygen_with SETTING...: docs/Doxyfile with other settings.
doxygen_with() {
    { cat docs/Doxyfile; printf '%s\n' "$@"; } | doxygen -
}

doxygen_with EXTRACT_ALL=NO WARN_IF_UNDOCUMENTED=YES EXCLUDE=engine/include/jawari/detail GENERATE_HTML=NO GENERATE_XML=YES \
    "OUTPUT_DIRECTORY=$out" "XML_OUTPUT=strict"
rm -rf "$out/strict"
doxygen_with "OUTPUT_DIRECTORY=$out"
echo "$out/html/index.html"
