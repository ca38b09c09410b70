"""The level of the presets, stated once: make_presets.py names it in the files, scripts/voice.py --gains aims at it.

The same phrase is equally loud on all of them; tests/presets/check_levels.py sees to it that the loudest chord stays below full scale.
"""

PHRASE_LUFS = -26.5
