"""Imports what another program is compared with; without it the test is skipped (CTest's SKIP_RETURN_CODE), not failed."""

import importlib
import sys

SKIPPED = 77


def need(module, library):
    """`module`, which needs `library`; ends the program with the reason if that is not there."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        print(f"skipped: {library} is not installed ({error})")
        sys.exit(SKIPPED)
