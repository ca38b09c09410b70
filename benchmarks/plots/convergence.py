#!/usr/bin/env python3
"""Plots docs/images/benchmarks/convergence.svg from docs/benchmarks/convergence.csv.

    benchmarks/plots/convergence.py
"""
import style
from style import plt

import results

COLOURS = {"exact": style.OURS["signorini"], "theta 0.5": style.RIVALS["theta=0.5"], "theta 1": style.RIVALS["theta=1.0"],
           **{f"exact, {law}": colour for law, colour in style.OURS.items()}}
# Laws that coincide stay visible: one inside the other.
MARKS = {"exact, newton": {"marker": "o", "markersize": 9, "mfc": "none"}, "exact, passive": {"marker": "x", "markersize": 6, "ls": "--"},
         "exact, signorini": {"marker": "."}, "exact, paoli-schatzman": {"marker": "+", "markersize": 9}}
SLOPES = {"free motion": 2, "persistent contact": 2, "single impact": 1, "point obstacle (Cabannes)": 1, "flat obstacle": 1}


def main():
    rows = results.read("convergence")
    panels = []
    for row in rows:
        panel = (row["case"], row["restitution"])
        if panel not in panels and row["case"] in SLOPES:
            panels.append(panel)
    figure, axes = plt.subplots(3, 3, figsize=(12, 10.5))
    for axis, (case, restitution) in zip(axes.flat, panels):
        mine = [r for r in rows if (r["case"], r["restitution"]) == (case, restitution)]
        for method in dict.fromkeys(r["method"] for r in mine):
            line = [r for r in mine if r["method"] == method]
            axis.plot([float(r["rate_hz"]) for r in line], [float(r["error"]) for r in line], color=COLOURS[method],
                      label=method, **MARKS.get(method, {"marker": "o"}))
        rates = sorted({float(r["rate_hz"]) for r in mine})
        top = max(float(r["error"]) for r in mine)
        slope = SLOPES[case]
        axis.plot(rates, [top * (rates[0] / r) ** slope for r in rates], ":", color="0.4", label=f"order {slope}")
        axis.set(xscale="log", yscale="log", xlabel="contact rate (steps per unit of time, Hz)", ylabel="relative L2 error",
                 title=case + (f", e = {float(restitution):g}" if restitution else ""))
        axis.legend(fontsize=8)
    for axis in axes.flat[len(panels):]:
        axis.axis("off")
    figure.tight_layout()
    style.save(figure, "convergence")


if __name__ == "__main__":
    main()
