"""The level of the presets, stated once: make_presets.py names it in the files, tests/presets/check_levels.py aims at it."""

AIM_DB = -5.0
