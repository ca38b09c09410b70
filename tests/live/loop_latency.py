#!/usr/bin/python3
"""Key to sound through JACK: MIDI out of one client, through the program, back into its audio input.

loop_latency.py PROGRAM SENDER PROBE [NOTES [FRAMES...]]: a line per block size. Without block sizes, 256, and the bound
is asserted: an event sounds one block after it came in, and comes in with the block in which, or after which, it was sent.
"""
import sys

import numpy as np

from live_bench import Bench

RATE_HZ = 48000


def measure(program, sender_program, probe, notes, frames):
    with Bench("loop", program, sender_program, RATE_HZ, frames) as bench:
        player = bench.play("--preset", "bass-fretted", "--midi", "jack", "--midi-in", "virtual", "--fixed-quality")
        player.expect("real-time priority")
        ran = bench.tool(probe, str(notes), "jawari-midi:in", "jawari:outport 0")
        assert ran.returncode == 0, ran.stderr
        xruns = (bench.folder / "jackd.log").read_text().count("XRun")
        assert player.end() == 0, player.err
        return np.array([int(line) for line in ran.stdout.split()]), xruns


def main(program, sender_program, probe, notes="40", *block_sizes):
    for frames in map(int, block_sizes or ["256"]):
        delays, xruns = measure(program, sender_program, probe, int(notes), frames)
        assert (delays >= 0).all(), f"{(delays < 0).sum()} notes were not heard"
        milliseconds = 1000 * delays / RATE_HZ
        print(f"{frames} frames: {len(delays)} notes, {np.median(delays):.0f} frames ({np.median(milliseconds):.1f} ms) in the "
              f"median, {delays.min()} to {delays.max()}; {np.median(delays) / frames:.2f} blocks; {xruns} xruns")
        if not block_sizes:
            assert np.median(delays) <= 3 * frames, "more than three blocks from key to sound"


if __name__ == "__main__":
    main(*sys.argv[1:])
