#!/usr/bin/env python3
"""Plots docs/images/benchmarks/peers.svg from docs/benchmarks/peers.csv.

    benchmarks/plots/peers.py
"""
import style
from matplotlib.patches import Patch
from style import plt

import results


COLOURS = {"rigid contact": "#08519c", "hammer or springs": "#d95f02", "no contact": "#fdae61"}


def kind(row):
    if "rigid" in row["contact"]:
        return "rigid contact"
    return "no contact" if row["contact"] == "none" else "hammer or springs"


def main():
    rows = results.read("peers")[::-1]
    figure, axis = plt.subplots(figsize=(10, 0.36 * len(rows) + 1))
    colours = [COLOURS[kind(row)] for row in rows]
    costs = [float(r["cost"]) for r in rows]
    axis.barh([r["peer"].replace("`", "") for r in rows], costs, color=colours)
    for number, cost in enumerate(costs):
        axis.text(cost * 1.08, number, f"{cost:.2g}", va="center", fontsize=9)
    axis.set(xscale="log", xlabel="CPU seconds per second of sound, one string at 48 kHz", xlim=(min(costs) / 2, max(costs) * 3))
    axis.legend(handles=[Patch(color=colour, label=label) for label, colour in COLOURS.items()], loc="lower right", fontsize=9)
    axis.grid(axis="y", visible=False)
    style.save(figure, "peers")


if __name__ == "__main__":
    main()
