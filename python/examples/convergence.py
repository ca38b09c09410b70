"""How the answer converges with the contact rate: each rate beside the highest one. The rates run at the same time.

Usage: convergence.py [SECONDS]
"""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import jawari

RATES_HZ = [15680 * 2**n for n in range(2, 11)]


def main(duration_s=0.02):
    def run(rate_hz):
        result = jawari.simulate("lab/bass", law="signorini", contact_rate_hz=rate_hz, output_rate_hz=15680,
                                 duration_s=duration_s, contacts=False)  # fmt: skip
        return result["displacement_m@0.501"]

    with ThreadPoolExecutor() as pool:  # the GIL is released: threads are enough
        *coarse, finest = pool.map(run, RATES_HZ)
    errors = [np.linalg.norm(u - finest) / np.linalg.norm(finest) for u in coarse]
    for rate_hz, error in zip(RATES_HZ, errors):
        print(f"{rate_hz / 1e3:9.1f} kHz: {100 * error:8.4f} %")
    return errors


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
