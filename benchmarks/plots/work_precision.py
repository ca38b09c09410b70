#!/usr/bin/env python3
"""Plots docs/images/benchmarks/work_precision_SCENE.svg and spectrum_SCENE.svg from docs/benchmarks/*.csv.

    benchmarks/plots/work_precision.py [bass] [one-contact] [fretless] [smooth-bass] [guitar]
"""
import json
import sys

import style
from style import plt

import results

# Quoted, of other machines: CPU seconds per second of sound and error at one position (Issanchou et al., JASA 143, 2018).
PUBLISHED = {("bass", 0.9): [(8, 1.70), (1678, 0.034), (6778, 0.008)]}
# Quoted costs of Siconos 4.5 without its avoidable product, by contact rate; the error is that of uniform stepping.
STRONG_BASELINE = {("bass", 0.9): {15680.0: 2.05, 125440.0: 14}}


def draw_ours(axis, rows, measure):
    for law in results.LAWS:
        for start, line in (("exact", "-"), ("backward", ":")):
            runs = sorted((r for r in rows if r["law"] == law and r["start"] == start and not r["fewer_modes"]),
                          key=lambda r: r["rate_hz"])
            axis.plot([r["cost"] for r in runs], [r[measure] for r in runs], line, marker="o" if start == "exact" else None,
                      color=style.OURS[law], label=f"Jawari, {law}" if start == "exact" else None)
    fewer = results.frontier([r for r in rows if r["fewer_modes"]], measure)
    axis.plot([r["cost"] for r in fewer], [r[measure] for r in fewer], "-.", color="#08306b", label="Jawari, fewer modes (best runs)")


def draw_rivals(axis, rows, scene, restitution, measure):
    for rival, name in results.NAMES.items():
        runs = [r for r in results.select(rows, scene, restitution, rival) if r[measure] < 1e3]
        best = results.frontier(runs, measure)
        axis.plot([r["cost"] for r in best], [r[measure] for r in best], "--", marker="s", markersize=3,
                  color=style.RIVALS[rival], label=name)


def draw_siconos(axis, rows, scene, restitution):
    """Measured here: cost extrapolated, error that of uniform stepping with the backward start."""
    costs = [r for r in results.read("siconos") if r["scene"] == scene and float(r["restitution"]) == restitution]
    same = {r["rate_hz"]: r["error"] for r in results.select(rows, scene, restitution, "uniform") if r["law"] == "newton"}
    places = [(float(r["cost"]), same[float(r["rate_hz"])]) for r in costs if float(r["rate_hz"]) in same]
    if places:
        axis.plot(*zip(*places), "x-", color="#006d2c", label="Siconos 4.4 here (extrapolated)")
    published = PUBLISHED.get((scene, restitution))
    if published:
        axis.plot(*zip(*published), "D", mfc="none", color="#006d2c", label="Siconos, published (quoted)")
    baseline = STRONG_BASELINE.get((scene, restitution), {})
    places = [(cost, same[rate]) for rate, cost in baseline.items() if rate in same]
    if places:
        axis.plot(*zip(*places), "P", mfc="none", color="#006d2c", markersize=7, label="Siconos 4.5, strong baseline (quoted)")


def draw(rows, scene, measure, name, label, bars):
    figure, axes = plt.subplots(2, 2, figsize=(11, 8.2), sharex=True, sharey=True)
    for axis, restitution in zip(axes.flat, results.RESTITUTIONS):
        draw_rivals(axis, rows, scene, restitution, measure)
        draw_ours(axis, results.select(rows, scene, restitution, "exact"), measure)
        if measure == "error":
            draw_siconos(axis, rows, scene, restitution)
        bar = max(part[measure] for part in bars[f"e{restitution:g}"].values())
        axis.axhspan(1e-12, bar, color="0.9", zorder=0)
        axis.text(0.98, bar, "reference's error bar ", ha="right", va="top", fontsize=9, color="0.35",
                  transform=axis.get_yaxis_transform())
        axis.axvline(1, color="0.5", lw=0.8)
        axis.set(xscale="log", yscale="log", title=f"{scene}, e = {restitution:g}")
        axis.set_ylim((1e-6, 3) if measure == "error" else (1e-5, 30))
        axis.label_outer()
    for axis in axes[1]:
        axis.set_xlabel("CPU seconds per second of sound (line at 1: real time)")
    for axis in axes[:, 0]:
        axis.set_ylabel(label)
    entries = {}
    for axis in axes.flat:
        handles, labels = axis.get_legend_handles_labels()
        entries.update(zip(labels, handles))
    figure.legend(entries.values(), entries.keys(), loc="upper center", bbox_to_anchor=(0.5, 0.02), ncol=4, fontsize=10)
    style.save(figure, f"{name}_{scene}")


def main():
    rows = results.work_precision()
    bars = json.loads((style.ROOT / "benchmarks/reference/references.json").read_text())
    for scene in sys.argv[1:] or results.SCENES:
        draw(rows, scene, "error", "work_precision", "relative L2 error, first 0.1 s", bars[scene])
        draw(rows, scene, "spectrum_dB", "spectrum", "distance of the onset's spectrum (dB)", bars[scene])


if __name__ == "__main__":
    main()
