"""Tables of docs/benchmarks.md, each a function that returns Markdown."""
import json
import math

import results

RIVAL_LIMIT = 1.0  # relative errors above 100 % are no solution: they are plotted but decide nothing
DECIBEL_LIMIT = 3.0


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def plain(name):
    rows = results.read(name)
    return markdown(list(rows[0]), [row.values() for row in rows])


def figure(value, digits=2):
    if value is None:
        return ""
    if value == 0 or not math.isfinite(value):
        return "0" if value == 0 else ""
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e+" in text else text


def rate_text(rate):
    return f"{rate / 1e6:.3g} MHz" if rate >= 1e6 else f"{rate / 1e3:.4g} kHz"


def percent(value):
    return f"{100 * value:.2g} %" if value < 0.995 else f"{100 * value:.0f} %"


def ours_text(run):
    """How one of our runs was made."""
    modes = f", {run['unknowns']} modes" if run["fewer_modes"] else ""
    return f"`{run['law']}`, {rate_text(run['rate_hz'])}{modes}"


def bars():
    return json.loads((results.ROOT / "benchmarks/reference/references.json").read_text())


def bar_of(scene, restitution):
    """The reference's error bar: difference to half the rate; for e = 0 also to the other law."""
    entry = bars()[scene][f"e{restitution:g}"]
    return max(part["error"] for part in entry.values())


def targets():
    rows = results.select(results.work_precision(), "bass", 0.0, "exact")
    table = []
    for error, limit in ((0.01, 0.03), (0.001, 0.15)):
        run = results.cheapest(rows, error)
        cost = run["cost"] if run else math.inf
        how = f"{ours_text(run)}, {run['start']} start, error {percent(run['error'])}" if run else "none"
        table.append([percent(error), how, figure(cost), limit, "met" if cost <= limit else f"missed by {cost / limit:.1f}x"])
    return markdown(["error", "cheapest run", "CPU s per s", "target (CPU s per s)", ""], table)


def references():
    table = []
    for scene, entries in bars().items():
        for key, entry in entries.items():
            other = entry.get("signorini")
            table.append([scene, key[1:], f"{entry['half_rate']['error']:.1e}", f"{entry['half_rate']['spectrum_dB']:.2g}",
                          f"{other['error']:.1e}" if other else "",
                          f"{entry['signorini_half_rate']['error']:.1e}" if other else ""])
    return markdown(["scene", "e", "`newton`: 32.1 to 64.2 MHz", "the same (dB)", "`signorini` to `newton`, both at 64.2 MHz",
                     "`signorini`: 32.1 to 64.2 MHz"], table)


def cost_at(level, measure="error"):
    rows = results.work_precision()
    table = []
    for scene in results.SCENES:
        for e in results.RESTITUTIONS:
            ours = results.cheapest(results.select(rows, scene, e, "exact"), level, measure)
            cells = [scene, f"{e:g}", f"**{figure(ours['cost'])}** ({ours_text(ours)})" if ours else "not reached"]
            for rival in results.RIVALS:
                best = results.cheapest(results.select(rows, scene, e, rival), level, measure)
                cells.append(figure(best["cost"]) if best else "")
            table.append(cells)
    return markdown(["scene", "e", "Jawari", *results.NAMES.values()], table)


def pareto(measure="error"):
    """Least ratio of each rival's cost to ours at equal error, for errors up to three levels, over all restitutions."""
    rows = results.work_precision()
    levels = (RIVAL_LIMIT, 0.1, 0.01) if measure == "error" else (DECIBEL_LIMIT, 1.0, 0.1)
    show = percent if measure == "error" else lambda value: f"{value:g} dB"
    table = []
    for scene in results.SCENES:
        for rival, name in results.NAMES.items():
            cells = [scene, name]
            for level in levels:
                found = results.least_ratio(rows, scene, rival, measure, level)
                cells.append("none" if found is None else f"**{found[0]:.2g}**" if found[0] < 1 else f"{found[0]:.3g}")
            table.append(cells)
    return markdown(["scene", "rival", *[f"errors up to {show(level)}" for level in levels]], table)


def lost_runs(measure="error"):
    """Rivals that beat us somewhere: at which restitutions and errors, by how much."""
    rows = results.work_precision()
    limit = RIVAL_LIMIT if measure == "error" else DECIBEL_LIMIT
    show = percent if measure == "error" else lambda value: f"{value:.2g} dB"
    table = []
    for scene in results.SCENES:
        for rival, name in results.NAMES.items():
            found = [(e, theirs, ours) for e in results.RESTITUTIONS
                     for theirs, ours in results.lost(rows, scene, e, rival, measure, limit)]
            if not found:
                continue
            below = sum(measure == "error" and theirs["error"] < bar_of(scene, e) for e, theirs, _ in found)
            # The clearest of them: the largest factor among the smaller half of the errors.
            errors = sorted(theirs[measure] for _, theirs, _ in found)
            e, theirs, ours = min((item for item in found if item[1][measure] <= errors[len(errors) // 2]),
                                  key=lambda item: item[1]["cost"] / item[2]["cost"] if item[2] else 0)
            mine = f"{figure(ours['cost'])} ({ours_text(ours)})" if ours else "not reached"
            table.append([scene, name, ", ".join(f"{value:g}" for value in sorted({item[0] for item in found})),
                          len(found), below, f"{show(errors[0])} to {show(errors[-1])}",
                          f"{show(theirs[measure])}: {figure(theirs['cost'])} ({theirs['parameter'] or theirs['law']}, {rate_text(theirs['rate_hz'])})",
                          mine])
    if not table:
        return "No run of any rival is cheaper than ours at its error."
    return markdown(["scene", "rival", "e", "runs", "of these below the reference's bar", "errors", "for example (CPU s per s)", "ours at that error"], table)


def verdict():
    """One paragraph, computed."""
    rows = results.work_precision()
    lost, points = [], 0
    for scene in results.SCENES:
        for e in results.RESTITUTIONS:
            for rival in results.RIVALS:
                runs = [r for r in results.frontier(results.select(rows, scene, e, rival)) if r["error"] <= RIVAL_LIMIT]
                points += len(runs)
                lost += [(theirs, bar_of(scene, e)) for theirs, _ in results.lost(rows, scene, e, rival, largest=RIVAL_LIMIT)]
    coarse = [theirs for theirs, _ in lost if theirs["error"] > 0.2]
    below = [theirs for theirs, bar in lost if theirs["error"] < bar]
    rest = len(lost) - len(coarse) - len([t for t in below if t["error"] <= 0.2])
    text = f"Of {points} runs on the rivals' frontiers with an error below 100 %, {points - len(lost)} cost more than ours at their error."
    if lost:
        text += (f" The other {len(lost)}: {len(coarse)} with an error above 20 %, "
                 f"{len(below)} with one below the reference's own error bar, {rest} between. They are listed below.")
    return text


def published():
    """Published errors of the same scheme beside ours: uniform stepping, Newton's law, backward start, one position."""
    rows = results.work_precision()
    quoted = {0.0: {15680: "58 %", 125440: "4.7 %", 1003520: "1.2 %", 4014080: "0.45 %"},
              0.9: {15680: "170 %", 125440: "160 %", 1003520: "3.4 %", 4014080: "0.8 %"}}
    table = []
    for e, figures in quoted.items():
        for rate, text in figures.items():
            runs = [r for r in results.select(rows, "bass", e, "exact")
                    if r["law"] == "newton" and r["start"] == "backward" and r["rate_hz"] == rate]
            if runs:
                table.append([f"{e:g}", rate_text(rate), percent(runs[0]["error"]), percent(runs[0]["error_first_position"]), text])
    return markdown(["e", "contact rate", "here, all positions", "here, x = 0.501 m", "published, one position [JASA 2018]"], table)


def all_frets():
    """Observed order on all 20 frets, from the work-precision runs."""
    rows = results.work_precision()
    table = []
    for law in results.LAWS:
        runs = sorted((r for r in results.select(rows, "bass", 0.0, "exact") if r["law"] == law and r["start"] == "exact"),
                      key=lambda r: r["rate_hz"])
        errors = [r["error"] for r in runs]
        x = [math.log2(r["rate_hz"]) for r in runs[3:]]
        y = [math.log2(error) for error in errors[3:]]
        mx, my = sum(x) / len(x), sum(y) / len(y)
        order = -sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)
        table.append([f"`{law}`", *[percent(errors[i]) for i in (0, 2, 4, 6, 8, 10, 11)], f"{order:.2f}"])
    rates = [rate_text(results_rate) for results_rate in [15680 * 2**i for i in (0, 2, 4, 6, 8, 10, 11)]]
    return markdown(["law", *rates, "order, fitted from 125 kHz on"], table)


def convergence():
    rows = results.read("convergence")
    table, lines = [], {}
    for row in rows:
        lines.setdefault((row["case"], row["restitution"], row["method"]), []).append(row)
    for (case, e, method), line in lines.items():
        orders = [float(r["order"]) for r in line if r["order"]]
        table.append([case, f"{float(e):g}" if e else "", method, line[0]["modes"] + (f" to {line[-1]['modes']}" if line[-1]["modes"] != line[0]["modes"] else ""),
                      line[0]["rate_hz"] + " to " + line[-1]["rate_hz"], f"{float(line[0]['error']):.1e}", f"{float(line[-1]['error']):.1e}",
                      f"{sum(orders) / len(orders):.2f}" if orders else "rounding"])
    return markdown(["case", "e", "method", "modes", "rates (Hz)", "first error", "last error", "order, mean"], table)


def siconos():
    rows = results.work_precision()
    table = []
    for row in results.read("siconos"):
        rate = float(row["rate_hz"])
        ours = [r for r in results.select(rows, "bass", 0.9, "exact") if r["rate_hz"] == rate and r["law"] == "newton" and r["start"] == "backward"]
        table.append([rate_text(rate), row["steps"] if rate == 15680 else "extrapolated", figure(float(row["cost"]), 3),
                      figure(ours[0]["cost"]) if ours else "", f"{float(row['cost']) / ours[0]['cost']:.3g}" if ours else "",
                      percent(ours[0]["error"]) if ours else ""])
    return markdown(["contact rate", "steps run", "Siconos 4.4 here (CPU s per s)", "ours, same scheme", "ratio", "error of both"], table)
