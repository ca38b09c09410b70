#!/usr/bin/env python3
"""Draws the figures of docs/python.md from the gallery's scenes (python3-matplotlib).

Usage: PYTHONPATH=build/release/python scripts/gallery_figures.py
"""

import importlib.util
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

import jawari  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "docs/images/python"
BLUE, RED, GREY = "#1f5f8b", "#b5403a", "#8a8a8a"


def example(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / f"python/examples/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def save(figure, name):
    for axes in figure.axes:
        axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    figure.savefig(FOLDER / f"{name}.svg", metadata={"Date": None})
    pyplot.close(figure)


def bass():
    result = jawari.simulate("lab/bass", law="signorini", duration_s=0.04)
    string = result.strings[0]
    figure, (above, below) = pyplot.subplots(2, 1, sharex=True, figsize=(8, 4.5))
    above.plot(1e3 * result.time_s, 1e3 * result["displacement_m@0.501"], color=BLUE, linewidth=0.8)
    above.set_ylabel("u(0.501 m) (mm)")
    row, fret = np.nonzero(string.impulse_Ns)
    below.scatter(1e3 * result.time_s[row], fret + 1, s=3e6 * string.impulse_Ns[row, fret] + 0.5, color=RED, linewidths=0)
    below.set_xlabel("time (ms)")
    below.set_ylabel("fret")
    save(figure, "published_bass")


def convergence():
    module = example("convergence")
    errors = module.main(0.02)
    rates = np.array(module.RATES_HZ[:-1])
    figure, axes = pyplot.subplots(figsize=(5.5, 3.8))
    axes.loglog(rates / 1e3, 100 * np.array(errors), "o-", color=BLUE)
    axes.loglog(rates / 1e3, 100 * errors[0] * rates[0] / rates, "--", color=GREY, label="first order")
    axes.set_xlabel("contact rate (kHz)")
    axes.set_ylabel("relative L2 error (%)")
    axes.legend(frameon=False)
    save(figure, "convergence")


def unrolling():
    module = example("unrolling")
    duration_s = 0.03
    simulation = jawari.Simulation(module.sitar(duration_s))
    string = simulation.strings[0]
    times, places = [], []

    def look(_):
        touching = np.flatnonzero(string.impulse_Ns)
        times.extend([1e3 * simulation.time_s] * len(touching))
        places.extend(1e3 * string.contact_position_m[touching])

    simulation.advance(seconds=duration_s, callback=look)
    figure, axes = pyplot.subplots(figsize=(8, 3.2))
    axes.scatter(times, places, s=1.5, color=BLUE, linewidths=0)
    axes.set_xlabel("time (ms)")
    axes.set_ylabel("where it touches (mm)")
    save(figure, "unrolling")


def spectra(curves, name, to_hz, floor_db=-90):
    """One spectrum for each (label, values, rate_hz) [dB of its highest line]."""
    figure, axes = pyplot.subplots(figsize=(8, 3.6))
    for (label, values, rate_hz), colour in zip(curves, (GREY, BLUE, RED)):
        power = np.abs(np.fft.rfft(values * np.hanning(len(values)))) ** 2
        level = 10 * np.log10(power / power.max() + 1e-30)
        axes.plot(np.fft.rfftfreq(len(values), 1 / rate_hz), level, color=colour, linewidth=0.8, label=label)
    axes.set_xlim(0, to_hz)
    axes.set_ylim(floor_db, 3)
    axes.set_xlabel("frequency (Hz)")
    axes.set_ylabel("level (dB)")
    axes.legend(frameon=False)
    save(figure, name)


def tanpura():
    with_bridge, without = example("tanpura").with_and_without_bridge(0.5)
    rate_hz = with_bridge.output_rate_hz
    spectra([("without the bridge", without[0], rate_hz), ("with the bridge", with_bridge[0], rate_hz)], "tanpura", 5000, -120)


def plate():
    curves = []
    for height_m, label in ((None, "no stop"), (-2e-5, "stop 20 um below")):
        result = jawari.simulate(example("plate").with_stop(height_m, 0.2), contacts=False)
        curves.append((label, result.probes[:, 0], result.output_rate_hz))
    spectra(curves, "plate", 12000, -80)


def main():
    if len(sys.argv) > 1:
        sys.exit("gallery_figures.py: takes no arguments")
    pyplot.rcParams.update({"font.size": 9, "svg.hashsalt": "jawari"})
    FOLDER.mkdir(parents=True, exist_ok=True)
    for draw in (bass, convergence, tanpura, unrolling, plate):
        draw()


if __name__ == "__main__":
    main()
