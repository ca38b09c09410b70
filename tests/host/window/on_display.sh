#!/bin/bash
# on_display.sh PROGRAM ARGUMENT...: runs it on a display of its own (Xvfb). Without what that takes there is nothing to test: exit
# code 77, which CTest takes for skipped.
for tool in Xvfb xvfb-run xdotool import convert; do
  command -v "$tool" > /dev/null || { echo "skipped: no $tool (scripts/setup.sh --test)"; exit 77; }
done
# A server that starts anew when its last client leaves would refuse the next one meanwhile: -noreset.
exec xvfb-run --auto-servernum --server-args="-screen 0 2200x1500x24 -nolisten tcp -noreset" "$@"
