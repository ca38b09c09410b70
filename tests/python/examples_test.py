"""Runs a script of the gallery and judges what it found. Usage: examples_test.py SCRIPT SECONDS"""

import importlib.util
import os
import sys

try:
    import numpy as np
except ImportError:
    print("SKIPPED: no NumPy here (python3-numpy)")
    sys.exit(77)

#: What must hold of the value that main() returns.
JUDGES = {
    "published_bass": lambda struck: struck > 1e-4,  # frets are hit within 20 ms
    "convergence": lambda errors: errors[-1] < errors[0] / 20 and all(np.diff(errors) < 0),
    "tanpura": lambda ratio: ratio > 1.2,  # the bridge makes the sound brighter
    "unrolling": lambda moved: 1e-4 < moved < 0.015,  # the point moves, and on the bridge
    "plate": lambda ratio: ratio > 1,  # a stop makes it brighter
    "rattle": lambda left: len(left) == 6 and all(0 < share <= 1 + 1e-12 for share in left),
}

path, seconds = sys.argv[1], float(sys.argv[2])
name = os.path.splitext(os.path.basename(path))[0]
spec = importlib.util.spec_from_file_location(name, path)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
value = module.main(seconds)
assert JUDGES[name](value), f"{name} returned {value}"
