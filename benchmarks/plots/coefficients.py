#!/usr/bin/env python3
"""Plots docs/images/benchmarks/coefficients.svg from docs/benchmarks/coefficients.csv.

    benchmarks/plots/coefficients.py
"""
import math

import style
from style import plt

import results

COLUMNS = {"engine": ("closed form (engine)", "#08519c", "o-"), "source's formula": ("source's formula", "#d95f02", "s--"),
           "1 + e - A": ("1 + e - A", "#e7298a", "^--"), "Taylor, order 7": ("Taylor, order 7", "#999999", "v--"),
           "conditioning of the sine in double": ("conditioning of the sine in double", "#41ae76", ":")}


def main():
    rows = results.read("coefficients")
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6), sharey=True)
    for axis, damping, title in zip(axes, ("0 to 1", "1 to 1e6"), ("underdamped", "overdamped")):
        mine = [r for r in rows if r["sigma/omega"] == damping]
        middle = [math.sqrt(float(r["omega h"].split(" to ")[0]) * float(r["omega h"].split(" to ")[1])) for r in mine]
        for column, (label, colour, line) in COLUMNS.items():
            values = [min(max(float(r[column]), 1e-17), 1e2) for r in mine]
            axis.plot(middle, values, line, color=colour, label=label)
        axis.set(xscale="log", yscale="log", xlabel="omega h", title=f"{title} (sigma/omega {damping})", ylim=(2e-17, 2e2))
    axes[0].set_ylabel("largest relative error of w\n(clipped at 100)")
    axes[0].legend(fontsize=9)
    figure.tight_layout()
    style.save(figure, "coefficients")


if __name__ == "__main__":
    main()
